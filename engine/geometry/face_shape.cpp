#include "engine/geometry/face_shape.h"

#include "engine/base/box.h"
#include "engine/geometry/triangulate.h"
#include "engine/scene/surface.h"

#include <cmath>

namespace lightwell {
namespace {

/// Corners may leave the plane of their face by this share of the face's diameter: files with four decimals do so.
constexpr double planar_tolerance = 1e-4;
/// Area below this share of the squared diameter is rounding error of double, not a surface.
constexpr double zero_area_tolerance = 1e-14;
/// Cutting ears takes time that grows with the cube of the corners at worst: 1024 corners take about a second.
constexpr std::size_t most_corners_for_ears = 1024;
/// Ears of an outline that does not cross itself cover its area within rounding; a crossing one misses far more.
constexpr double covered_area_tolerance = 1e-9;

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

void fan(std::size_t count, Triangles& triangles)
{
    triangles.clear();
    for (std::uint32_t i = 1; i + 1 < count; ++i)
        triangles.push_back({0, i, i + 1});
}

/// @return false when a corner points inwards
bool cut_quad(const std::vector<Point>& p, const Vec3& area, Triangles& triangles)
{
    if (length(p[2] - p[0]) <= length(p[3] - p[1]))
        triangles.assign({{0, 1, 2}, {0, 2, 3}});
    else
        triangles.assign({{0, 1, 3}, {1, 2, 3}});
    constexpr std::uint32_t corners[4][3] = {{0, 1, 2}, {1, 2, 3}, {2, 3, 0}, {3, 0, 1}};
    for (const auto& [a, b, c] : corners)
        if (!(dot(triangle_area(p, {a, b, c}), area) > 0))
            return false;
    return true;
}

} // namespace

bool FaceShape::has_area() const noexcept
{
    return length(area) > least_area_m2();
}

bool FaceShape::planar() const noexcept
{
    return deviation_m <= planar_tolerance * diameter_m;
}

double FaceShape::least_area_m2() const noexcept
{
    return zero_area_tolerance * diameter_m * diameter_m;
}

FaceShape face_shape(const std::vector<Point>& corners) noexcept
{
    FaceShape shape;
    shape.area = polygon_area_vector(corners.data(), corners.size());
    Box box;
    Vec3 sum;
    for (const Point& point : corners) {
        box.extend(point);
        sum += point - corners[0];
    }
    shape.diameter_m = box.diagonal();
    if (corners.size() <= 3)
        return shape;
    const Direction front = normalized(shape.area);
    const Point middle = corners[0] + sum / static_cast<double>(corners.size());
    for (const Point& point : corners)
        shape.deviation_m = std::fmax(shape.deviation_m, std::fabs(dot(point - middle, front)));
    return shape;
}

void cut_face(const std::vector<Point>& corners, const FaceShape& shape, Triangles& triangles)
{
    const std::size_t count = corners.size();
    if (count == 3 || count > most_corners_for_ears || !shape.has_area())
        return fan(count, triangles);
    if (count == 4 && cut_quad(corners, shape.area, triangles))
        return;
    triangles = triangulate(corners.data(), count);
    Vec3 covered;
    for (const auto& triangle : triangles)
        covered += triangle_area(corners, triangle);
    const double missed = 1 - dot(covered, shape.area) / dot(shape.area, shape.area);
    if (!(std::fabs(missed) <= covered_area_tolerance))
        fan(count, triangles);
}

} // namespace lightwell
