#pragma once

#include "engine/geometry/merge_coplanar.h"
#include "engine/scene/surface.h"

#include <unordered_map>

namespace lightwell {

struct PointHash {
    std::size_t operator()(const Point& point) const noexcept;
};

/// The triangles of one part that may be joined, and where each came from.
class TrianglePool {
public:
    /// @param joined  by surface: its triangles take part; the corners of all others stay corners
    /// @param groups  by surface: what may be joined with each other
    TrianglePool(const Part& part, const std::vector<bool>& joined, const std::vector<std::uint32_t>& groups);
    const TriangleSoup& soup() const { return soup_; }
    /// The surface of a triangle of the soup.
    std::uint32_t surface_of(std::uint32_t triangle) const { return surfaces_[triangle]; }
    std::vector<Point> points_of(const std::vector<std::uint32_t>& loop) const;

private:
    void add_triangle(const Point& a, const Point& b, const Point& c, std::uint32_t surface, std::uint32_t group);
    TriangleSoup soup_;
    std::vector<std::uint32_t> surfaces_;
    std::unordered_map<Point, std::uint32_t, PointHash> known_;
};

/// A mesh without normals and texture places, or a polygon of three corners.
bool is_plain_triangles(const Part& part, const Surface& surface);
/// Number of triangles of such a surface.
std::size_t triangle_count(const Part& part, const Surface& surface);

} // namespace lightwell
