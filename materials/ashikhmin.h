#pragma once

#include "materials/bsdf_sample.h"
#include "materials/material.h"

#include <optional>

namespace lightwell {

/// The surface of `ashik2`: diffuse under a varnish whose highlight has two widths and follows Fresnel's law.
/// Frame   local, z = normal on the viewer's side, x along the grain
/// Source  Ashikhmin, Shirley 2000, "An Anisotropic Phong BRDF Model", Eqs. (4) to (10), with Schlick's form of
/// Fresnel's
///         formulas. The diffuse part is reciprocal and gets what the highlight leaves.
class AshikhminScattering {
public:
    explicit AshikhminScattering(const Ashikhmin& surface) noexcept
        : s_{surface.diffuse, surface.specular, surface.power_u, surface.power_v}
    {
    }

    Spectrum value_per_sr(Direction to_viewer, Direction to_light, LobeSet set) const noexcept;
    double density_per_sr(Direction to_viewer, Direction to_light, LobeSet set) const noexcept;
    std::optional<BsdfSample> sample(Direction to_viewer, double choice, UnitSquare u, LobeSet set) const noexcept;
    Lobes lobes() const noexcept;

private:
    struct Surface {
        Spectrum diffuse, specular;
        double power_u, power_v;
    };
    double highlight_share(double cos_viewer, LobeSet set) const noexcept;
    double facet_density(const Direction& half) const noexcept;
    Surface s_;
};

} // namespace lightwell
