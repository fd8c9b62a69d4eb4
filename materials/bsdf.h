#pragma once

#include "engine/base/frame.h"
#include "materials/ashikhmin.h"
#include "materials/bsdf_sample.h"
#include "materials/dielectric.h"
#include "materials/functional.h"
#include "materials/haze.h"
#include "materials/layered.h"
#include "materials/material.h"
#include "materials/measured_scattering.h"
#include "materials/thin_glass.h"

#include <optional>
#include <variant>

namespace lightwell {

/// How one point of a surface scatters light: made at every hit, without taking memory. The material must outlive it;
/// one with functions must have been put in place (materials/placed.h).
/// Frame  local: z = normal on the viewer's side, so to_viewer.z > 0; to_light.z < 0 is transmission
class Bsdf {
public:
    /// Emitters do not reflect.
    /// @param from_front  the viewer is on the side of the geometric normal
    /// @param frame       of the surface in the world, for functions that ask for directions there
    Bsdf(const Material& material, bool from_front, const Frame& frame = {}) noexcept;

    /// BSDF value without the cosine, 1/sr; delta lobes excluded; zero where to_viewer.z <= 0.
    Spectrum value_per_sr(Direction to_viewer, Direction to_light, LobeSet set = LobeSet::all) const noexcept;
    /// Density of sample() per solid angle, delta lobes excluded (their share of choice is missing from the integral,
    /// as is what a glossy lobe loses below the surface).
    double density_per_sr(Direction to_viewer, Direction to_light, LobeSet set = LobeSet::all) const noexcept;
    /// @param choice  [0, 1), picks the lobe
    /// @param set     lobes to choose from: the weight is that of these alone
    /// @return        nothing where all light is absorbed
    std::optional<BsdfSample> sample(Direction to_viewer, double choice, UnitSquare u,
                                     LobeSet set = LobeSet::all) const noexcept;
    /// Where light is either mirrored or passes, and nothing else: sample() mirrors for a `choice` below this. Else 0.
    double mirrored_choice(Direction to_viewer) const noexcept;
    /// Share of a straight ray that passes without bending or scattering (what a shadow ray keeps).
    Spectrum straight_transmittance(Direction to_viewer) const noexcept;
    const Lobes& lobes() const noexcept { return lobes_; }

private:
    struct Black {};
    struct OnlyMirror {
        Spectrum reflectance;
    };
    using Model = std::variant<Black, Layered, DielectricBoundary, ThinGlass, OnlyMirror, AshikhminScattering,
                               FunctionalScattering, MeasuredScattering, HazeScattering>;
    static Model model_of(const Material& material, bool from_front, const Frame& frame) noexcept;

    Model model_;
    Lobes lobes_;
};

} // namespace lightwell
