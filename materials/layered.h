#pragma once

#include "engine/base/spectrum.h"
#include "materials/bsdf_sample.h"
#include "materials/material.h"
#include "materials/ward.h"

#include <optional>

namespace lightwell {

/// Plastic, Metal and Trans: a diffuse part under a specular one, and for Trans the same two on the far side; the
/// same with two roughnesses (Brushed), and Wgmd, which names the four parts itself.
///
/// Diffuse reflection and transmission and the transmitted highlight are tinted by the colour; the reflected highlight
/// is white, for Metal tinted. Roughness up to smooth_roughness is a mirror. A smooth surface of at least
/// smallest_fresnel specularity reflects more at grazing angles, and its other parts get the rest.
/// Frame   local, z = normal on the viewer's side
/// Source  Radiance reference manual, `plastic`, `metal`, `trans`. We differ in two places: the diffuse part of a
///         smooth surface has the Fresnel loss on the way in for all light (Radiance: for direct light only, which
///         leaves its interreflection 5 % brighter and not reciprocal), and a rough transmitted highlight is bounded
///         at grazing angles (RoughTransmission).
class Layered {
public:
    explicit Layered(const Plastic& plastic) noexcept;
    explicit Layered(const Metal& metal) noexcept;
    explicit Layered(const Trans& trans) noexcept;
    explicit Layered(const Brushed& brushed) noexcept;
    /// @param from_front  the viewer is on the side of the normal
    Layered(const Wgmd& wgmd, bool from_front) noexcept;

    Spectrum value_per_sr(Direction to_viewer, Direction to_light, LobeSet set = LobeSet::all) const noexcept;
    double density_per_sr(Direction to_viewer, Direction to_light, LobeSet set = LobeSet::all) const noexcept;
    std::optional<BsdfSample> sample(Direction to_viewer, double choice, UnitSquare u,
                                     LobeSet set = LobeSet::all) const noexcept;
    Spectrum straight_transmittance(Direction to_viewer) const noexcept;
    Lobes lobes() const noexcept;

private:
    /// The four parts as this viewer sees them.
    struct Parts {
        Spectrum diffuse_reflectance, diffuse_transmittance;
        Spectrum specular_reflectance, specular_transmittance;
    };
    /// Probabilities of the parts; they sum to 1 or, where nothing is reflected, to 0.
    struct Shares {
        double diffuse_reflection = 0, diffuse_transmission = 0, specular_reflection = 0, specular_transmission = 0;
    };
    /// Widths of a specular lobe along x and y.
    struct Widths {
        double u = 0, v = 0;
        bool smooth = true;
    };
    static Widths widths(double roughness_u, double roughness_v) noexcept;
    Layered(Spectrum colour, double specularity, double roughness, double transmission, double transmitted_specular,
            bool tinted_highlight) noexcept;
    ScatteredLobe passed_lobe(Direction to_viewer, Direction to_light) const noexcept;
    Vec3 passed_direction(Direction to_viewer, UnitSquare u) const noexcept;
    double fresnel_increase(double cosine) const noexcept;
    /// Lobes outside the set are black.
    Parts parts(double cos_viewer, LobeSet set) const noexcept;
    Shares shares(const Parts& parts) const noexcept;
    struct Scattered {
        Spectrum value_per_sr;
        double density_per_sr = 0;
    };
    /// Value and density together, since they share the exponential of the highlight.
    Scattered scattered(const Parts& parts, const Shares& shares, Direction to_viewer,
                        Direction to_light) const noexcept;

    Spectrum colour_;
    double specularity_ = 0, transmission_ = 0, transmitted_specular_ = 0;
    Widths reflected_, passed_;
    bool tinted_highlight_ = false, has_fresnel_ = false;
    bool brushed_ = false; ///< the transmitted lobe is BrushedTransmission
    bool fixed_ = false;   ///< the parts are `fixed_parts_`, whatever the angle
    Parts fixed_parts_;
};

/// Roughness whose square is below 1e-6, as in Radiance: the highlight is then narrower than any pixel.
inline constexpr double smooth_roughness = 1e-3;
/// Specularity below that of a coating of index 1.31 is not a coating, as in Radiance.
inline constexpr double smallest_fresnel = 0.017999;

} // namespace lightwell
