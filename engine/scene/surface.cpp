#include "engine/scene/surface.h"

#include <algorithm>

namespace lightwell {
namespace {

template <class Array, class Item>
std::uint32_t append(Array& array, Item&& item)
{
    array.push_back(std::forward<Item>(item));
    return static_cast<std::uint32_t>(array.size() - 1);
}

/// Position of the outline corner nearest to the hole and of the hole corner nearest to that one.
std::pair<std::size_t, std::size_t> nearest_corners(const std::vector<Point>& outline, const std::vector<Point>& hole)
{
    std::pair<std::size_t, std::size_t> best{0, 0};
    double best_distance = infinity;
    for (std::size_t i = 0; i < outline.size(); ++i)
        for (std::size_t j = 0; j < hole.size(); ++j) {
            const Vec3 d = outline[i] - hole[j];
            if (dot(d, d) < best_distance) {
                best_distance = dot(d, d);
                best = {i, j};
            }
        }
    return best;
}

double triangle_area_m2(const Point& a, const Point& b, const Point& c)
{
    return 0.5 * length(cross(b - a, c - a));
}

} // namespace

void Part::add_polygon(const std::vector<Point>& corners, ModifierId modifier, std::string surface_name)
{
    const Polygon polygon{static_cast<std::uint32_t>(points.size()), static_cast<std::uint32_t>(corners.size())};
    points.insert(points.end(), corners.begin(), corners.end());
    surfaces.push_back({Shape::polygon, append(polygons, polygon), modifier, std::move(surface_name)});
}

void Part::add_polygon_with_holes(const std::vector<Point>& outline, const std::vector<std::vector<Point>>& holes,
                                  ModifierId modifier, std::string surface_name)
{
    std::vector<Point> merged = outline;
    const Vec3 front = polygon_area_vector(outline.data(), outline.size());
    for (std::vector<Point> hole : holes) {
        if (hole.empty())
            continue;
        if (dot(front, polygon_area_vector(hole.data(), hole.size())) > 0)
            std::reverse(hole.begin(), hole.end());
        const auto [at, from] = nearest_corners(merged, hole);
        std::rotate(hole.begin(), hole.begin() + static_cast<std::ptrdiff_t>(from), hole.end());
        hole.push_back(hole.front());
        hole.push_back(merged[at]);
        merged.insert(merged.begin() + static_cast<std::ptrdiff_t>(at) + 1, hole.begin(), hole.end());
    }
    add_polygon(merged, modifier, std::move(surface_name));
}

void Part::add_sphere(const Sphere& sphere, Shape sphere_or_bubble, ModifierId modifier, std::string surface_name)
{
    surfaces.push_back({sphere_or_bubble, append(spheres, sphere), modifier, std::move(surface_name)});
}

void Part::add_cone(const Cone& cone, Shape kind, ModifierId modifier, std::string surface_name)
{
    surfaces.push_back({kind, append(cones, cone), modifier, std::move(surface_name)});
}

void Part::add_ring(const Ring& ring, ModifierId modifier, std::string surface_name)
{
    surfaces.push_back({Shape::ring, append(rings, ring), modifier, std::move(surface_name)});
}

void Part::add_source(const DistantSource& source, ModifierId modifier, std::string surface_name)
{
    surfaces.push_back({Shape::source, append(sources, source), modifier, std::move(surface_name)});
}

void Part::add_mesh(std::shared_ptr<const Mesh> mesh, ModifierId modifier, std::string surface_name)
{
    surfaces.push_back({Shape::mesh, append(meshes, std::move(mesh)), modifier, std::move(surface_name)});
}

void Part::add_instance(Instance instance, std::string surface_name)
{
    surfaces.push_back(
        {Shape::instance, append(instances, std::move(instance)), void_modifier, std::move(surface_name)});
}

Vec3 polygon_area_vector(const Point* corners, std::size_t count) noexcept
{
    Vec3 sum;
    for (std::size_t i = 1; i + 1 < count; ++i)
        sum += cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    return sum * 0.5;
}

double surface_area_m2(const Part& part, const Surface& surface)
{
    switch (surface.shape) {
    case Shape::polygon: {
        const Polygon& polygon = part.polygons[surface.index];
        return length(polygon_area_vector(&part.points[polygon.first], polygon.count));
    }
    case Shape::sphere:
    case Shape::bubble: {
        const double r = part.spheres[surface.index].radius;
        return 4 * pi * r * r;
    }
    case Shape::cone:
    case Shape::cup:
    case Shape::cylinder:
    case Shape::tube: {
        const Cone& cone = part.cones[surface.index];
        const double slant = std::hypot(length(cone.ends[1] - cone.ends[0]), cone.radii[1] - cone.radii[0]);
        return pi * (cone.radii[0] + cone.radii[1]) * slant * cone.sector.share();
    }
    case Shape::ring: {
        const Ring& ring = part.rings[surface.index];
        return pi * (ring.outer_radius - ring.inner_radius) * (ring.outer_radius + ring.inner_radius) *
               ring.sector.share();
    }
    case Shape::mesh: {
        const Mesh& mesh = *part.meshes[surface.index];
        double area = 0;
        for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3)
            area += triangle_area_m2(mesh.points[mesh.triangles[i]], mesh.points[mesh.triangles[i + 1]],
                                     mesh.points[mesh.triangles[i + 2]]);
        return area;
    }
    case Shape::source:
    case Shape::instance:
        return 0;
    }
    return 0;
}

const Sector& sector_of(const Part& part, const Surface& surface) noexcept
{
    static const Sector whole;
    switch (surface.shape) {
    case Shape::cone:
    case Shape::cup:
    case Shape::cylinder:
    case Shape::tube:
        return part.cones[surface.index].sector;
    case Shape::ring:
        return part.rings[surface.index].sector;
    default:
        return whole;
    }
}

Box surface_bounds(const Part& part, const Surface& surface, const Affine& map)
{
    Box box;
    switch (surface.shape) {
    case Shape::polygon: {
        const Polygon& polygon = part.polygons[surface.index];
        for (std::uint32_t i = 0; i < polygon.count; ++i)
            box.extend(map.point(part.points[polygon.first + i]));
        break;
    }
    case Shape::sphere:
    case Shape::bubble: {
        const Sphere& sphere = part.spheres[surface.index];
        const Vec3 reach{length(Vec3{map.x.x, map.y.x, map.z.x}), length(Vec3{map.x.y, map.y.y, map.z.y}),
                         length(Vec3{map.x.z, map.y.z, map.z.z})};
        box.extend(map.point(sphere.centre) - reach * sphere.radius);
        box.extend(map.point(sphere.centre) + reach * sphere.radius);
        break;
    }
    case Shape::cone:
    case Shape::cup:
    case Shape::cylinder:
    case Shape::tube: {
        const Cone& cone = part.cones[surface.index];
        const Direction axis = normalized(cone.ends[1] - cone.ends[0]);
        for (int end = 0; end < 2; ++end)
            extend_by_arc(box, cone.ends[end], axis, cone.radii[end], cone.sector, map);
        break;
    }
    case Shape::ring: {
        const Ring& ring = part.rings[surface.index];
        extend_by_arc(box, ring.centre, ring.normal, ring.outer_radius, ring.sector, map);
        if (!ring.sector.is_whole())
            extend_by_arc(box, ring.centre, ring.normal, ring.inner_radius, ring.sector, map);
        break;
    }
    case Shape::mesh:
        for (const Point& p : part.meshes[surface.index]->points)
            box.extend(map.point(p));
        break;
    case Shape::source:
    case Shape::instance:
        break;
    }
    return box;
}

} // namespace lightwell
