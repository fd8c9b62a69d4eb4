#include "engine/sources/portals.h"

#include "engine/base/frame.h"

#include <algorithm>

namespace lightwell {
namespace {

/// Panes smaller than this share of the largest are left to the other strategies.
constexpr double smallest_share = 1e-3;

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

Portals::Portals(const Scene& scene)
{
    visit_expanded(scene, [&](const Part& part, const Surface& surface, const Affine& to_world, ModifierId modifier) {
        const Material* material = resolve(scene, modifier).material;
        Rectangle r;
        if (material == nullptr || !std::holds_alternative<Glass>(*material) ||
            !flat_rectangle(outline_of(part, surface, to_world), r))
            return;
        const Vec3 area = cross(r.edge_x, r.edge_y);
        portals_.push_back({r.corner, r.edge_x, r.edge_y, r.corner + (r.edge_x + r.edge_y) * 0.5, normalized(area),
                            length(area), 0.5 * length(r.edge_x + r.edge_y)});
    });
    std::stable_sort(portals_.begin(), portals_.end(),
                     [](const Portal& a, const Portal& b) { return a.area_m2 > b.area_m2; });
    std::size_t count = std::min(portals_.size(), Shares::most);
    while (count > 0 && portals_[count - 1].area_m2 < smallest_share * portals_[0].area_m2)
        --count;
    portals_.resize(count);
}

Portals::Shares Portals::shares(const Point& at, const Direction& normal, bool transmits) const noexcept
{
    Shares shares;
    double sum = 0;
    for (const Portal& p : portals_) {
        const Vec3 way = p.centre - at;
        const double squared = dot(way, way), distance = std::sqrt(squared);
        const double above = dot(normal, way);
        double share = 0;
        if (transmits || above + p.radius_m > 0) {
            const double near = std::fmax(distance, p.radius_m);
            const double arriving =
                std::fmin(1, (std::fmax(0, transmits ? std::fabs(above) : above) + 0.2 * p.radius_m) / near);
            const double leaving = 0.05 + std::fabs(dot(p.normal, way)) / near;
            share = std::fmin(2 * pi, arriving * leaving * p.area_m2 / std::fmax(squared, 1e-300));
        }
        shares.summed[shares.count++] = sum += share;
    }
    return shares;
}

SampledDirection Portals::sample(const Shares& shares, const Point& from, UnitSquare u) const noexcept
{
    const double total = shares.total();
    if (!(total > 0))
        return {};
    const double wanted = u.u * total;
    const auto at = static_cast<std::size_t>(std::upper_bound(shares.summed, shares.summed + shares.count - 1, wanted) -
                                             shares.summed);
    const double before = at == 0 ? 0 : shares.summed[at - 1], part = shares.summed[at] - before;
    if (!(part > 0))
        return {};
    const Portal& p = portals_[at];
    const double left = std::clamp((wanted - before) / part, 0.0, 0x1.fffffffffffffp-1);
    const SampledDirection d = SphericalRectangle(from, p.corner, p.edge_x, p.edge_y).sample({left, u.v});
    if (!(d.density_per_sr > 0))
        return {};
    return {d.direction, density_per_sr(shares, from, d.direction)};
}

double Portals::density_per_sr(const Shares& shares, const Point& from, const Direction& direction) const noexcept
{
    const double total = shares.total();
    if (!(total > 0))
        return 0;
    double density = 0;
    for (std::size_t i = 0; i < shares.count; ++i) {
        const double share = shares.summed[i] - (i == 0 ? 0 : shares.summed[i - 1]);
        const Portal& p = portals_[i];
        const double t = dot(p.normal, p.corner - from) / dot(p.normal, direction);
        if (!(share > 0) || !(t > 0))
            continue;
        const Vec3 v = from + direction * t - p.corner;
        const double x = dot(v, p.edge_x), y = dot(v, p.edge_y);
        if (x >= 0 && x <= dot(p.edge_x, p.edge_x) && y >= 0 && y <= dot(p.edge_y, p.edge_y))
            density += share * SphericalRectangle(from, p.corner, p.edge_x, p.edge_y).density_per_sr(direction);
    }
    return density / total;
}

} // namespace lightwell
