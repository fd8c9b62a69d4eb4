#pragma once

#include "engine/scene/scene.h"

#include <map>

namespace lightwell {

/// How much of a scene has one modifier, instances expanded.
struct Usage {
    double surfaces = 0; ///< a forest has 1e8 and more
    double area_m2 = 0;
    double curved_surfaces = 0; ///< of these: spheres, cones, meshes that are not flat
    double curved_m2 = 0;

    Usage& operator+=(const Usage& other) noexcept;
};

/// By modifier as bound by the instances, without visiting each copy: the time grows with what the scene stores.
/// Error: areas under a map that is no similarity count as if it scaled all directions alike
std::map<ModifierId, Usage> usage_by_modifier(const Scene& scene);

} // namespace lightwell
