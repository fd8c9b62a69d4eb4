#pragma once

#include "engine/base/vector.h"

#include <array>
#include <cstdint>
#include <vector>

namespace lightwell {

/// Triangles of which some may be parts of one flat face.
struct TriangleSoup {
    std::vector<Point> points;                           ///< places equal to the bit are one point
    std::vector<std::array<std::uint32_t, 3>> triangles; ///< into points
    std::vector<std::uint32_t> groups;                   ///< of each triangle: only those of one group are joined
    std::vector<bool> kept_points;                       ///< corners of other surfaces: they stay corners
};

/// Triangles that together are one flat face without overlap.
struct FlatFace {
    std::vector<std::uint32_t> triangles;          ///< into the soup, ascending
    std::vector<std::uint32_t> outline;            ///< points, counter-clockwise seen from the front
    std::vector<std::vector<std::uint32_t>> holes; ///< points, clockwise
};

/// Joins neighbours across whole edges as long as all corners lie in one plane, and leaves out the corners that then
/// stand on a straight edge for all faces that meet there.
/// @return faces of two triangles and more; triangles in none of them stay what they are
/// Error   corners lie within 1e-5 of the size of the face's largest triangle of its plane, corners left out within
///         1e-6 of the length of their edge of that edge; areas are conserved within 1e-6
///         (tests/unit/geometry/merge_coplanar_test.cpp)
std::vector<FlatFace> merge_coplanar(const TriangleSoup& soup);

} // namespace lightwell
