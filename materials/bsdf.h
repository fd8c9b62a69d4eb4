#pragma once

#include "engine/base/quantities.h"
#include "engine/base/spectrum.h"
#include "engine/base/vector.h"
#include "materials/material.h"

#include <optional>

namespace lightwell {

/// One scattered direction.
struct BsdfSample {
    Direction to_light;     ///< local frame; where the scattered ray goes
    Spectrum weight;        ///< value * |cos| / density; for a delta lobe its reflectance or transmittance / choice
    double density_per_sr;  ///< density() of this direction; 0 for a delta lobe
    bool delta = false;     ///< a single direction that no other technique can find
    bool straight = false;  ///< delta transmission without bending: shadow rays see it too
};

/// What a surface can do, for choosing the means to gather light at it.
struct Lobes {
    Spectrum diffuse_reflectance;   ///< hemispherical
    Spectrum diffuse_transmittance; ///< hemispherical
    bool glossy = false;            ///< has a lobe of finite width
    double glossy_width_rad = 0;    ///< its angular width (roughness)
    bool delta = false;             ///< has mirror-like or refracted rays
    bool transparent_to_shadows = false; ///< straight_transmittance() is not black
};

/// How one point of a surface scatters light.
/// Frame  local: z = normal on the viewer's side, so to_viewer.z > 0; to_light.z < 0 is transmission
class Bsdf {
public:
    /// @param from_front  the viewer is on the side of the geometric normal (matters for Dielectric only)
    Bsdf(const Material& material, bool from_front) noexcept;

    /// BSDF value without the cosine, 1/sr; delta lobes excluded; zero where to_viewer.z <= 0.
    Spectrum value_per_sr(Direction to_viewer, Direction to_light) const noexcept;
    /// Density of sample() per solid angle, delta lobes excluded (their share of choice is missing from the integral).
    double density_per_sr(Direction to_viewer, Direction to_light) const noexcept;
    /// @param choice  [0, 1), picks the lobe
    /// @return        nothing where all light is absorbed
    std::optional<BsdfSample> sample(Direction to_viewer, double choice, UnitSquare u) const noexcept;
    /// Share of a straight ray that passes without bending or scattering (what a shadow ray keeps).
    Spectrum straight_transmittance(Direction to_viewer) const noexcept;
    const Lobes& lobes() const noexcept { return lobes_; }

private:
    Lobes lobes_;
    Material material_;
    bool from_front_;
};

} // namespace lightwell
