#include "importers/dxf/shapes.h"

#include "engine/geometry/triangulate.h"
#include "importers/dxf/geometry.h"

#include <algorithm>
#include <optional>

namespace lightwell::dxf {
namespace {

/// Smaller than this share of the squared extent, an area is rounding: the corners lie on one line.
constexpr double smallest_area_share = 1e-12;
/// Corners of a drawing written with six decimals are this far from their plane, as a share of the extent.
constexpr double planar_within = 1e-6;

/// Ears are cut in a time that grows with the square of the corners; beyond this a fan must do.
constexpr std::size_t most_corners_cut = 100;

double extent(std::span<const Point> corners)
{
    Box box;
    for (const Point& corner : corners)
        box.extend(corner);
    return box.diagonal();
}

bool has_area(std::span<const Point> corners)
{
    const double size = extent(corners);
    return length(polygon_area_vector(corners.data(), corners.size())) > smallest_area_share * size * size;
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

Reason add_polyline(const Drawing& drawing, const Entity& entity, const ShapeOptions& options, Shapes& shapes)
{
    constexpr int in_space = 8, polygon_mesh = 16, polyface = 64;
    const int flags = VertexList{entity.values}.header.flags(70);
    if (flags & polyface)
        return add_polyface(drawing, entity, shapes);
    if (flags & polygon_mesh)
        return add_polygon_mesh(drawing, entity, shapes);
    if (flags & in_space)
        return add_space_polyline(entity.values, options, shapes);
    return add_flat_polyline(entity.values, options, shapes);
}

} // namespace

void Shapes::clear()
{
    points_.clear();
    sizes_.clear();
    cones.clear();
    rings.clear();
    meshes.clear();
    deviations = {};
}

void Shapes::add_polygon(std::span<const Point> corners)
{
    const auto first = static_cast<std::ptrdiff_t>(points_.size());
    std::unique_copy(corners.begin(), corners.end(), std::back_inserter(points_));
    while (points_.size() > static_cast<std::size_t>(first) + 1 &&
           points_[static_cast<std::size_t>(first)] == points_.back())
        points_.pop_back();
    const std::span<const Point> kept{points_.begin() + first, points_.end()};
    if (kept.size() < 3 || !has_area(kept))
        points_.erase(points_.begin() + first, points_.end());
    else
        sizes_.push_back(static_cast<std::uint32_t>(kept.size()));
}

void Shapes::add_quad(const Point& a, const Point& b, const Point& c, const Point& d)
{
    const Point corners[] = {a, b, c, d};
    if (a == b || b == c || c == d || d == a) {
        add_polygon(corners);
        return;
    }
    const double distance = distance_from_plane(corners);
    if (distance > planar_within * extent(corners)) {
        const bool along_ac = length(c - a) <= length(d - b);
        add_polygon({a, b, along_ac ? c : d});
        add_polygon({along_ac ? a : b, c, d});
        ++deviations.split_faces;
        deviations.out_of_plane = std::fmax(deviations.out_of_plane, distance);
    } else if (const auto at = crossing(a, b, c, d)) {
        add_polygon({d, a, *at});
        add_polygon({b, c, *at});
    } else if (const auto other = crossing(b, c, d, a)) {
        add_polygon({a, b, *other});
        add_polygon({c, d, *other});
    } else {
        add_polygon(corners);
    }
}

void Shapes::add_face(const std::vector<Point>& corners)
{
    if (corners.size() == 4) {
        add_quad(corners[0], corners[1], corners[2], corners[3]);
        return;
    }
    const double distance = distance_from_plane(corners);
    if (distance > planar_within * extent(corners))
        cut_into_triangles(corners, distance);
    else
        add_polygon(corners);
}

void Shapes::cut_into_triangles(const std::vector<Point>& corners, double distance)
{
    // Seen along the mean normal: ears can be cut only from what is flat.
    const Direction normal = normalized(polygon_area_vector(corners.data(), corners.size()));
    std::vector<Point> flat;
    for (const Point& corner : corners)
        flat.push_back(corner - normal * dot(normal, corner - corners[0]));
    if (corners.size() <= most_corners_cut && normal != Vec3{})
        for (const auto& [a, b, c] : triangulate(flat.data(), flat.size()))
            add_polygon({corners[a], corners[b], corners[c]});
    else
        for (std::size_t i = 1; i + 1 < corners.size(); ++i)
            add_polygon({corners[0], corners[i], corners[i + 1]});
    ++deviations.split_faces;
    deviations.out_of_plane = std::fmax(deviations.out_of_plane, distance);
}

void Shapes::add_walls(const std::vector<Point>& line, bool closed, const Vec3& height)
{
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
        add_polygon({line[i], line[i + 1], line[i + 1] + height, line[i] + height});
    if (closed && line.size() > 2)
        add_polygon({line.back(), line.front(), line.front() + height, line.back() + height});
}

void Shapes::add_cylinder(const Point& from, const Point& to, double radius, Shape cylinder_or_tube,
                          const Sector& sector)
{
    cones.push_back({Cone{{from, to}, {radius, radius}, sector}, cylinder_or_tube});
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

std::vector<Point> points_with(int code, Values values)
{
    std::vector<Point> points;
    for (const Value& value : values)
        if (value.code == code)
            points.push_back({value.number, 0, 0});
        else if (!points.empty() && (value.code == code + 10 || value.code == code + 20))
            points.back()[(value.code - code) / 10] = value.number;
    return points;
}

std::vector<double> numbers_with(int code, Values values)
{
    std::vector<double> numbers;
    for (const Value& value : values)
        if (value.code == code)
            numbers.push_back(value.number);
    return numbers;
}

double thickness_of(const Fields& fields, const ShapeOptions& options)
{
    constexpr double level_above = 0.999; // cosine: 2.6 degrees
    const double drawn = fields.get(39);
    if (drawn != 0 || options.raised_by == 0)
        return drawn;
    const double up = object_axes(fields.extrusion()).z.z;
    return std::fabs(up) < level_above ? 0 : std::copysign(options.raised_by, up);
}

Reason add_shapes(const Drawing& drawing, const Entity& entity, const ShapeOptions& options, Shapes& shapes)
{
    const Fields fields{entity.values};
    switch (entity.kind) {
    case Kind::line:
        return add_line(fields, options, shapes);
    case Kind::lwpolyline:
        return add_lwpolyline(entity.values, options, shapes);
    case Kind::polyline:
        return add_polyline(drawing, entity, options, shapes);
    case Kind::multiline:
        return add_multiline(entity.values, options, shapes);
    case Kind::face:
        return add_face(fields, shapes);
    case Kind::solid:
        return add_solid(fields, options, shapes);
    case Kind::circle:
        return add_circle(fields, options, shapes);
    case Kind::arc:
        return add_arc(fields, options, shapes);
    case Kind::ellipse:
        return add_ellipse(fields, options, shapes);
    case Kind::spline:
        return add_spline(entity.values, options, shapes);
    case Kind::hatch:
        return add_hatch(entity.values, options, shapes);
    case Kind::mesh:
        return add_mesh(drawing, entity, options, shapes);
    case Kind::light:
    case Kind::insert:
    case Kind::other:
        break;
    }
    return reason_of_type(drawing.types[entity.type]);
}

} // namespace lightwell::dxf
