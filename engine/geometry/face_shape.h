#pragma once

#include "engine/base/vector.h"

#include <array>
#include <cstdint>
#include <vector>

namespace lightwell {

/// What the corners of a face in a file say: it may be bent, or have no area at all.
struct FaceShape {
    Vec3 area; ///< area vector, m^2; to the front
    double diameter_m = 0;
    double deviation_m = 0; ///< largest distance of a corner from the mean plane

    bool has_area() const noexcept;
    /// Whether the corners lie in one plane as nearly as files with four decimals have them.
    bool planar() const noexcept;
    /// What is smaller is rounding, not a surface.
    double least_area_m2() const noexcept;
};
FaceShape face_shape(const std::vector<Point>& corners) noexcept;

/// Triangles (indices into the corners) of a face that need not be planar: a quadrangle along its shorter diagonal,
/// else ear by ear as seen along its area vector; an outline that crosses itself, has no area or has more than a
/// thousand corners becomes a fan from its first corner.
void cut_face(const std::vector<Point>& corners, const FaceShape& shape,
              std::vector<std::array<std::uint32_t, 3>>& triangles);

/// Area vector of a triangle of such a face.
inline Vec3 triangle_area(const std::vector<Point>& corners, const std::array<std::uint32_t, 3>& triangle) noexcept
{
    const Point& a = corners[triangle[0]];
    return 0.5 * cross(corners[triangle[1]] - a, corners[triangle[2]] - a);
}

} // namespace lightwell
