#pragma once

#include "materials/bsdf_sample.h"

#include <optional>

namespace lightwell {

/// Scattering at a point of haze, told like that of a surface that faces the viewer: its value is the phase function
/// over the cosine of the light, so that gathering, which multiplies with that cosine, gives the phase function.
/// Scattered rays do not find sources again: the density is 0, and all their light comes by shadow rays.
/// Frame   local, z = towards the viewer
/// Source  Henyey, Greenstein 1941
class HazeScattering {
public:
    explicit HazeScattering(double eccentricity) noexcept : eccentricity_(eccentricity) {}
    /// Share of the scattered light per solid angle.
    /// @param cosine  of the angle by which light is turned
    double phase_per_sr(double cosine) const noexcept;
    /// Cosine of an angle drawn with that density.
    double sample_cosine(double u) const noexcept;

    Spectrum value_per_sr(Direction to_viewer, Direction to_light, LobeSet set) const noexcept;
    double density_per_sr(Direction, Direction, LobeSet) const noexcept { return 0; }
    std::optional<BsdfSample> sample(Direction, double, UnitSquare, LobeSet) const noexcept { return {}; }
    Lobes lobes() const noexcept;

private:
    double eccentricity_;
};

} // namespace lightwell
