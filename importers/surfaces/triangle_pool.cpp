#include "importers/surfaces/triangle_pool.h"

#include "engine/base/random.h"

#include <cstring>

namespace lightwell {

std::size_t PointHash::operator()(const Point& point) const noexcept
{
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double value = point[axis] + 0.0; // -0 becomes 0, as == sees them
        std::uint64_t bits = 0;
        std::memcpy(&bits, &value, sizeof bits);
        hash = mix_bits(bits, hash);
    }
    return hash;
}

bool is_plain_triangles(const Part& part, const Surface& surface)
{
    if (surface.shape == Shape::polygon)
        return part.polygons[surface.index].count == 3;
    if (surface.shape != Shape::mesh)
        return false;
    const Mesh& mesh = *part.meshes[surface.index];
    return mesh.normals.empty() && mesh.texture.empty();
}

std::size_t triangle_count(const Part& part, const Surface& surface)
{
    return surface.shape == Shape::polygon ? 1 : part.meshes[surface.index]->triangles.size() / 3;
}

void TrianglePool::add_triangle(const Point& a, const Point& b, const Point& c, std::uint32_t surface,
                                std::uint32_t group)
{
    if (a == b || b == c || c == a) // nothing to see, and no edge that could join
        return;
    std::array<std::uint32_t, 3> corners{};
    std::size_t i = 0;
    for (const Point* point : {&a, &b, &c}) {
        const auto [entry, fresh] = known_.try_emplace(*point, static_cast<std::uint32_t>(soup_.points.size()));
        if (fresh)
            soup_.points.push_back(*point);
        corners[i++] = entry->second;
    }
    soup_.triangles.push_back(corners);
    soup_.groups.push_back(group);
    surfaces_.push_back(surface);
}

TrianglePool::TrianglePool(const Part& part, const std::vector<bool>& joined, const std::vector<std::uint32_t>& groups)
{
    const auto visit_points = [&](const Surface& surface, const auto& visit) {
        if (surface.shape == Shape::polygon)
            for (std::uint32_t i = 0; i < part.polygons[surface.index].count; ++i)
                visit(part.points[part.polygons[surface.index].first + i]);
        else if (surface.shape == Shape::mesh)
            for (const Point& point : part.meshes[surface.index]->points)
                visit(point);
    };
    for (std::uint32_t i = 0; i < part.surfaces.size(); ++i) {
        const Surface& surface = part.surfaces[i];
        if (!joined[i])
            continue;
        if (surface.shape == Shape::polygon) {
            const Point* corner = &part.points[part.polygons[surface.index].first];
            add_triangle(corner[0], corner[1], corner[2], i, groups[i]);
            continue;
        }
        const Mesh& mesh = *part.meshes[surface.index];
        for (std::size_t at = 0; at + 2 < mesh.triangles.size(); at += 3)
            add_triangle(mesh.points[mesh.triangles[at]], mesh.points[mesh.triangles[at + 1]],
                         mesh.points[mesh.triangles[at + 2]], i, groups[i]);
    }
    soup_.kept_points.assign(soup_.points.size(), false);
    for (std::uint32_t i = 0; i < part.surfaces.size(); ++i)
        if (!joined[i])
            visit_points(part.surfaces[i], [&](const Point& point) {
                if (const auto found = known_.find(point); found != known_.end())
                    soup_.kept_points[found->second] = true;
            });
}

std::vector<Point> TrianglePool::points_of(const std::vector<std::uint32_t>& loop) const
{
    std::vector<Point> points;
    for (const std::uint32_t point : loop)
        points.push_back(soup_.points[point]);
    return points;
}

} // namespace lightwell
