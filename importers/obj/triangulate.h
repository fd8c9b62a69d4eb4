#pragma once

#include "engine/base/vector.h"

#include <cstdint>
#include <vector>

namespace lightwell {

/// Cuts an outline that is not planar, or crosses itself, into triangles.
/// @param corners  in order; concave outlines are cut ear by ear as seen along their area vector
/// @return         three indices into corners for each triangle, turning the same way as the outline
/// Error           an outline that crosses itself, or has more than 1024 corners, becomes a fan from its first corner
std::vector<std::uint32_t> triangulate(const std::vector<Point>& corners);

} // namespace lightwell
