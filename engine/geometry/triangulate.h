#pragma once

#include "engine/base/vector.h"

#include <array>
#include <cstdint>
#include <vector>

namespace lightwell {

/// Triangles (indices into the corners, front side kept) that cover a planar outline, concave or with seams to its
/// holes; ear clipping, in about n^1.5 steps where corners are spread evenly. Corners without area are left out.
/// Error: the areas sum to the outline's area within rounding (tests/unit/geometry)
std::vector<std::array<std::uint32_t, 3>> triangulate(const Point* corners, std::size_t count);

} // namespace lightwell
