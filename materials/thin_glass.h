#pragma once

#include "engine/base/spectrum.h"

namespace lightwell {

/// A thin pane: both surfaces and all reflections between them; light leaves in its old direction, slightly displaced
/// in truth and not at all here.
/// Source  Radiance reference manual, `glass`; the geometric series of each polarization, then their mean
class ThinGlass {
public:
    /// @param transmissivity  fraction left after one passage at normal incidence, each channel in [0, 1]
    ThinGlass(Spectrum transmissivity, double index) noexcept : transmissivity_(transmissivity), index_(index) {}
    Spectrum transmittance(double cos_viewer) const noexcept;
    Spectrum reflectance(double cos_viewer) const noexcept;
    bool opaque() const noexcept { return transmissivity_.is_black(); }

private:
    Spectrum passage(double cos_refracted) const noexcept;
    Spectrum transmissivity_;
    double index_;
};

} // namespace lightwell
