#pragma once

#include "engine/base/vector.h"

namespace lightwell {

/// Ideal diffuse scattering into the hemisphere around +z (or, mirrored by the caller, around -z).
/// Frame   local, z = normal; cosines are of to_viewer and to_light
/// Source  Nicodemus 1977, f_r = rho / pi; Ward 1994, Eq. (1)
class Diffuse {
public:
    /// For a reflectance of 1; zero below the surface. Error: 2 ulp.
    static constexpr double value_per_sr(double cos_viewer, double cos_light) noexcept
    {
        return cos_viewer > 0 && cos_light > 0 ? 1 / pi : 0;
    }
    static constexpr double density_per_sr(double cos_light) noexcept { return cos_light > 0 ? cos_light / pi : 0; }
    /// Cosine-weighted, so that value * cos / density is 1.
    static Direction sample(UnitSquare u) noexcept;
};

} // namespace lightwell
