#pragma once

#include "engine/base/frame.h"
#include "materials/bsdf_sample.h"
#include "materials/material.h"

#include <optional>

namespace lightwell {

/// Scattering by functions of the scene language: a diffuse part of either side, a lobe that a function gives, and for
/// BRTDfunc one mirrored ray and one straight on.
///
/// Functions are not known beforehand, so directions of their lobe are drawn from a mixture: the whole hemisphere, and
/// a rough highlight about the mirrored or the straight direction.
/// Frame   local, z = normal on the viewer's side
/// Source  Radiance reference manual, `plasfunc` to `BRTDfunc`. Functions and data over the direction of the light are
///         used for all light, there for direct light alone.
class FunctionalScattering {
public:
    /// @param material  in place (materials/placed.h); it must outlive this
    /// @param frame     of the surface, in the world
    FunctionalScattering(const Functional& material, bool from_front, const Frame& frame) noexcept;

    Spectrum value_per_sr(Direction to_viewer, Direction to_light, LobeSet set) const noexcept;
    double density_per_sr(Direction to_viewer, Direction to_light, LobeSet set) const noexcept;
    std::optional<BsdfSample> sample(Direction to_viewer, double choice, UnitSquare u, LobeSet set) const noexcept;
    Spectrum straight_transmittance(Direction to_viewer) const noexcept;
    Lobes lobes() const noexcept;

private:
    /// Probabilities of the ways to draw a direction; they sum to 1 or to 0.
    struct Shares {
        double mirrored = 0, straight = 0, reflected = 0, transmitted = 0, diffuse_reflection = 0,
               diffuse_transmission = 0;
    };
    Shares shares(LobeSet set) const noexcept;
    static double lobe_density(Direction to_viewer, Direction to_light) noexcept;

    const Functional* material_;
    Frame frame_;
    Spectrum diffuse_reflectance_, diffuse_transmittance_; ///< of this side
    Spectrum reflected_, transmitted_;                     ///< factors of the function
    Spectrum mirrored_, passed_;
};

/// What to scale the function of a material with so that it sends back no more than it gets, at an untransformed place
/// on a level surface: 1, or less.
/// Error: from some thousand directions, a few percent for wide lobes; only an excess of a quarter counts, since narrow
///        lobes are found with less certainty
double bounded_scale(const Functional& material);

} // namespace lightwell
