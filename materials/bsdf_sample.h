#pragma once

#include "engine/base/spectrum.h"
#include "engine/base/vector.h"

namespace lightwell {

/// Which of a surface's lobes a question is about: gathering treats the diffuse ones apart from all the others.
enum class LobeSet : unsigned char { all, diffuse, specular };

/// One scattered direction.
struct BsdfSample {
    Direction to_light;    ///< local frame; where the scattered ray goes
    Spectrum weight;       ///< value * |cos| / density; for a delta lobe its reflectance or transmittance / choice
    double density_per_sr; ///< density() of this direction; 0 for a delta lobe
    bool delta = false;    ///< a single direction that no other technique can find
    bool straight = false; ///< delta transmission without bending: shadow rays see it too
};

/// What a surface can do, for choosing the means to gather light at it.
struct Lobes {
    Spectrum diffuse_reflectance;        ///< hemispherical
    Spectrum diffuse_transmittance;      ///< hemispherical
    bool glossy = false;                 ///< has a lobe of finite width
    double glossy_width_rad = 0;         ///< its angular width (roughness)
    bool delta = false;                  ///< has mirror-like or refracted rays
    bool transparent_to_shadows = false; ///< straight_transmittance() is not black
};

} // namespace lightwell
