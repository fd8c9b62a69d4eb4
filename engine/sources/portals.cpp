#include "engine/sources/portals.h"

#include "engine/sources/placed_surfaces.h"

#include <algorithm>

namespace lightwell {
namespace {

/// Panes smaller than this share of the largest are left to the other strategies.
constexpr double smallest_share = 1e-3;
constexpr std::size_t most_portals = 512;

std::vector<Point> outline_of(const Part& part, const Surface& surface, const Affine& to_world)
{
    std::vector<Point> points;
    if (surface.shape == Shape::polygon) {
        const Polygon& polygon = part.polygons[surface.index];
        for (std::uint32_t i = 0; i < polygon.count; ++i)
            points.push_back(to_world.point(part.points[polygon.first + i]));
    } else if (surface.shape == Shape::mesh) {
        const Mesh& mesh = *part.meshes[surface.index];
        for (const std::uint32_t corner : mesh.triangles)
            points.push_back(to_world.point(mesh.points[corner]));
    }
    return points;
}

/// The directions of a parallelogram that hold all points; false when they do not lie in one plane.
struct Rectangle {
    Point corner;
    Vec3 edge_x, edge_y;
};

bool flat_rectangle(const std::vector<Point>& points, Rectangle& rectangle)
{
    if (points.size() < 3)
        return false;
    const Vec3 first = polygon_area_vector(points.data(), 3);
    const Vec3 area = length(first) > 0 ? first : polygon_area_vector(points.data(), points.size());
    const Direction normal = normalized(area);
    Vec3 side = points[1] - points[0];
    for (std::size_t i = 1; i + 1 < points.size(); ++i)
        if (const Vec3 edge = points[i + 1] - points[i]; length(edge) > length(side))
            side = edge;
    const Direction x = normalized(side - normal * dot(side, normal)), y = cross(normal, x);
    double low_x = infinity, high_x = -infinity, low_y = infinity, high_y = -infinity, off = 0;
    for (const Point& p : points) {
        const Vec3 v = p - points[0];
        low_x = std::fmin(low_x, dot(v, x));
        high_x = std::fmax(high_x, dot(v, x));
        low_y = std::fmin(low_y, dot(v, y));
        high_y = std::fmax(high_y, dot(v, y));
        off = std::fmax(off, std::fabs(dot(v, normal)));
    }
    rectangle = {points[0] + x * low_x + y * low_y, x * (high_x - low_x), y * (high_y - low_y)};
    return off <= 0.01 * std::fmax(high_x - low_x, high_y - low_y) && high_y > low_y && high_x > low_x;
}

} // namespace

SampledDirection Portal::sample(const Point& from, UnitSquare u) const noexcept
{
    const Vec3 way = corner + edge_x * u.u + edge_y * u.v - from;
    const double distance = length(way);
    const Direction direction = normalized(way);
    const double cosine = std::fabs(dot(normal, direction));
    return {direction, cosine > 0 ? distance * distance / (area_m2 * cosine) : 0};
}

double Portal::density_per_sr(const Point& from, const Direction& direction) const noexcept
{
    const double cosine = dot(normal, direction);
    const double t = dot(normal, corner - from) / cosine;
    if (!(t > 0))
        return 0;
    const Vec3 v = from + direction * t - corner;
    const double x = dot(v, edge_x), y = dot(v, edge_y);
    const bool within = x >= 0 && x <= dot(edge_x, edge_x) && y >= 0 && y <= dot(edge_y, edge_y);
    return within ? t * t / (area_m2 * std::fabs(cosine)) : 0;
}

std::vector<Portal> find_portals(const Scene& scene, const std::vector<std::string>& modifiers)
{
    std::vector<ModifierId> wanted;
    for (const std::string& name : modifiers)
        wanted.push_back(scene.find_modifier(name));
    std::vector<Portal> portals;
    visit_placed(
        scene, [](const Material& material) { return std::holds_alternative<Glass>(material); },
        [&](const PlacedSurface& placed) {
            const bool named =
                wanted.empty() || std::find(wanted.begin(), wanted.end(), placed.modifier) != wanted.end();
            Rectangle r;
            if (named && flat_rectangle(outline_of(placed.part, placed.surface, placed.to_world), r)) {
                const Vec3 area = cross(r.edge_x, r.edge_y);
                portals.push_back({r.corner, r.edge_x, r.edge_y, r.corner + (r.edge_x + r.edge_y) * 0.5,
                                   normalized(area), length(area), 0.5 * length(r.edge_x + r.edge_y)});
            }
            return true;
        });
    std::stable_sort(portals.begin(), portals.end(),
                     [](const Portal& a, const Portal& b) { return a.area_m2 > b.area_m2; });
    std::size_t count = std::min(portals.size(), most_portals);
    while (count > 0 && portals[count - 1].area_m2 < smallest_share * portals[0].area_m2)
        --count;
    portals.resize(count);
    return portals;
}

} // namespace lightwell
