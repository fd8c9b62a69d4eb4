#pragma once

#include "engine/scene/scene.h"

#include <unordered_map>

namespace lightwell {

/// How much of a scene shares a modifier.
struct Amount {
    double surfaces = 0; ///< a double: a forest may have more than fit into an integer's product
    double area_m2 = 0;
};
/// Surfaces and areas by modifier, instances expanded without visiting them; copies that only face the other way (an
/// emitter's back) do not count.
/// Error: areas as mapped_area_m2()
std::unordered_map<ModifierId, Amount> surface_amounts(const Scene& scene);

/// Bounds by modifier, instances expanded.
/// Error: exact up to rounding where instances are few; from a million surfaces on, boxes of turned instances are those
///        around the corners of their prototypes' boxes
std::unordered_map<ModifierId, Box> surface_boxes(const Scene& scene);

} // namespace lightwell
