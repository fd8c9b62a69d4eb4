#include "importers/dxf/shapes.h"

#include "importers/dxf/geometry.h"

#include <algorithm>
#include <optional>

namespace lightwell::dxf {
namespace {

/// Smaller than this share of the squared extent, an area is rounding: the corners lie on one line.
constexpr double smallest_area_share = 1e-12;
/// Corners of a drawing written with six decimals are this far from their plane, as a share of the extent.
constexpr double planar_within = 1e-6;

double extent(const std::vector<Point>& corners)
{
    Box box;
    for (const Point& corner : corners)
        box.extend(corner);
    return box.diagonal();
}

bool has_area(const std::vector<Point>& corners)
{
    const double size = extent(corners);
    return length(polygon_area_vector(corners.data(), corners.size())) > smallest_area_share * size * size;
}

void merge_equal_neighbours(std::vector<Point>& corners)
{
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    while (corners.size() > 1 && corners.front() == corners.back())
        corners.pop_back();
}

/// Where the segments a-b and c-d of one plane cross; nothing when they do not.
std::optional<Point> crossing(const Point& a, const Point& b, const Point& c, const Point& d)
{
    const Vec3 u = b - a, v = d - c, normal = cross(u, v);
    const double size = dot(normal, normal);
    if (!(size > smallest_area_share * dot(u, u) * dot(v, v)))
        return std::nullopt;
    const double along = dot(cross(c - a, v), normal) / size, across = dot(cross(c - a, u), normal) / size;
    if (!(along > 0 && along < 1 && across > 0 && across < 1))
        return std::nullopt;
    return a + u * along;
}

Reason add_line(const Fields& fields, Shapes& shapes)
{
    const double thickness = fields.get(39);
    if (thickness == 0)
        return &thin;
    const Vec3 height = object_axes(fields.extrusion()).z * thickness;
    const Point from = fields.point(10), to = fields.point(11);
    shapes.add_polygon({from, to, to + height, from + height});
    return shapes.empty() ? &no_area : nullptr;
}

Reason add_circle(const Fields& fields, Shapes& shapes)
{
    const double thickness = fields.get(39), radius = fields.get(40);
    if (thickness == 0)
        return &thin;
    if (!(radius > 0))
        return &no_area;
    const Affine axes = object_axes(fields.extrusion());
    const Point centre = axes.point(fields.point(10));
    shapes.add_cylinder(centre, centre + axes.z * thickness, radius, Shape::cylinder);
    shapes.add_caps(centre, axes.z * thickness, 0, radius);
    return nullptr;
}

Reason add_arc(const Fields& fields, double chord_tolerance, Shapes& shapes)
{
    const double thickness = fields.get(39), radius = fields.get(40);
    if (thickness == 0)
        return &thin;
    if (!(radius > 0))
        return &no_area;
    double sweep_deg = std::fmod(fields.get(51) - fields.get(50), 360);
    if (sweep_deg <= 0)
        sweep_deg += 360;
    const Arc arc{fields.point(10), radius, fields.get(50) * radians_per_degree, sweep_deg * radians_per_degree};
    const Affine axes = object_axes(fields.extrusion());
    const Vec3 height = axes.z * thickness;
    const int chords = chord_count(radius, arc.sweep_rad, chord_tolerance);
    for (int i = 0; i < chords; ++i) {
        const Point from = axes.point(arc.at(static_cast<double>(i) / chords));
        const Point to = axes.point(arc.at((i + 1.0) / chords));
        shapes.add_polygon({from, to, to + height, from + height});
    }
    shapes.deviations.chords += static_cast<std::size_t>(chords);
    shapes.deviations.chord_error = chord_error(radius, arc.sweep_rad, chords);
    return nullptr;
}

Reason add_polyline(const Drawing& drawing, const Entity& entity, double chord_tolerance, Shapes& shapes)
{
    constexpr int in_space = 8, polygon_mesh = 16, polyface = 64;
    const int flags = VertexList{drawing.values_of(entity)}.header.flags(70);
    if (flags & polyface)
        return add_polyface(drawing, entity, shapes);
    if (flags & polygon_mesh)
        return add_polygon_mesh(drawing, entity, shapes);
    if (flags & in_space)
        return &thin;
    return add_flat_polyline(drawing.values_of(entity), chord_tolerance, shapes);
}

} // namespace

void Shapes::clear()
{
    points_.clear();
    sizes_.clear();
    cones.clear();
    rings.clear();
    deviations = {};
}

void Shapes::add_polygon(std::vector<Point> corners)
{
    merge_equal_neighbours(corners);
    if (corners.size() < 3 || !has_area(corners))
        return;
    points_.insert(points_.end(), corners.begin(), corners.end());
    sizes_.push_back(static_cast<std::uint32_t>(corners.size()));
}

void Shapes::add_quad(const Point& a, const Point& b, const Point& c, const Point& d)
{
    std::vector<Point> corners{a, b, c, d};
    merge_equal_neighbours(corners);
    if (corners.size() < 4) {
        add_polygon(std::move(corners));
        return;
    }
    const double distance = distance_from_plane(corners);
    if (distance > planar_within * extent(corners)) {
        const bool along_ac = length(c - a) <= length(d - b);
        add_polygon(along_ac ? std::vector<Point>{a, b, c} : std::vector<Point>{a, b, d});
        add_polygon(along_ac ? std::vector<Point>{a, c, d} : std::vector<Point>{b, c, d});
        ++deviations.split_quads;
        deviations.out_of_plane = std::fmax(deviations.out_of_plane, distance);
    } else if (const auto at = crossing(a, b, c, d)) {
        add_polygon({d, a, *at});
        add_polygon({b, c, *at});
    } else if (const auto other = crossing(b, c, d, a)) {
        add_polygon({a, b, *other});
        add_polygon({c, d, *other});
    } else {
        add_polygon(std::move(corners));
    }
}

void Shapes::add_cylinder(const Point& from, const Point& to, double radius, Shape cylinder_or_tube)
{
    cones.push_back({Cone{{from, to}, {radius, radius}}, cylinder_or_tube});
}

void Shapes::add_caps(const Point& centre, const Vec3& height, double inner_radius, double outer_radius)
{
    const Direction up = normalized(height);
    rings.push_back({centre, -up, inner_radius, outer_radius});
    rings.push_back({centre + height, up, inner_radius, outer_radius});
}

double Fields::get(int code, double otherwise) const
{
    for (const Value& value : values_)
        if (value.code == code)
            return value.number;
    return otherwise;
}

bool Fields::has(int code) const
{
    for (const Value& value : values_)
        if (value.code == code)
            return true;
    return false;
}

Vec3 Fields::point(int code, const Vec3& otherwise) const
{
    return {get(code, otherwise.x), get(code + 10, otherwise.y), get(code + 20, otherwise.z)};
}

Reason add_shapes(const Drawing& drawing, const Entity& entity, double chord_tolerance, Shapes& shapes)
{
    const Fields fields{drawing.values_of(entity)};
    switch (entity.kind) {
    case Kind::line:
        return add_line(fields, shapes);
    case Kind::lwpolyline:
        return add_lwpolyline(drawing.values_of(entity), chord_tolerance, shapes);
    case Kind::polyline:
        return add_polyline(drawing, entity, chord_tolerance, shapes);
    case Kind::face:
        return add_face(fields, shapes);
    case Kind::solid:
        return add_solid(fields, shapes);
    case Kind::circle:
        return add_circle(fields, shapes);
    case Kind::arc:
        return add_arc(fields, chord_tolerance, shapes);
    case Kind::insert:
    case Kind::other:
        break;
    }
    return reason_of_type(drawing.types[entity.type]);
}

} // namespace lightwell::dxf
