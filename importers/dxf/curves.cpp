#include "importers/dxf/geometry.h"
#include "importers/dxf/shapes.h"
#include "importers/dxf/spline.h"

namespace lightwell::dxf {
namespace {

/// Walls over a curve that closes when its ends meet.
Reason add_curve(std::vector<Point> line, const Vec3& height, Shapes& shapes)
{
    const bool closed = line.size() > 2 && line.front() == line.back();
    if (closed)
        line.pop_back();
    shapes.add_walls(line, closed, height);
    return shapes.empty() ? &no_area : nullptr;
}

} // namespace

Reason add_line(const Fields& fields, const ShapeOptions& options, Shapes& shapes)
{
    const double thickness = thickness_of(fields, options);
    if (thickness == 0)
        return &thin;
    shapes.add_walls({fields.point(10), fields.point(11)}, false, object_axes(fields.extrusion()).z * thickness);
    return shapes.empty() ? &no_area : nullptr;
}

Reason add_circle(const Fields& fields, const ShapeOptions& options, Shapes& shapes)
{
    const double thickness = thickness_of(fields, options), radius = fields.get(40);
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

Reason add_arc(const Fields& fields, const ShapeOptions& options, Shapes& shapes)
{
    const double thickness = thickness_of(fields, options), radius = fields.get(40);
    if (thickness == 0)
        return &thin;
    if (!(radius > 0))
        return &no_area;
    double sweep_deg = std::fmod(fields.get(51) - fields.get(50), 360);
    if (sweep_deg <= 0)
        sweep_deg += 360;
    const Arc arc{fields.point(10), radius, fields.get(50) * radians_per_degree, sweep_deg * radians_per_degree};
    const Affine axes = object_axes(fields.extrusion());
    const Point foot = axes.point(arc.centre) + axes.z * std::fmin(thickness, 0);
    shapes.add_cylinder(foot, foot + axes.z * std::fabs(thickness), radius, Shape::cylinder, arc.sector(axes));
    return nullptr;
}

Reason add_ellipse(const Fields& fields, const ShapeOptions& options, Shapes& shapes)
{
    const double thickness = thickness_of(fields, options);
    if (thickness == 0)
        return &thin_curve;
    const Vec3 normal = object_axes(fields.extrusion()).z, major = fields.point(11);
    const Vec3 minor = cross(normal, major) * fields.get(40, 1);
    const double start_rad = fields.get(41), sweep_rad = sweep_between(start_rad, fields.get(42, 2 * pi));
    std::vector<Point> line = points_on_ellipse(fields.point(10), major, minor, start_rad, sweep_rad,
                                                options.chord_tolerance, shapes.deviations);
    return add_curve(std::move(line), normal * thickness, shapes);
}

Reason add_spline(Values values, const ShapeOptions& options, Shapes& shapes)
{
    static constexpr SkipReason unsound{"a spline whose knots and control points do not fit each other", true};
    const Fields fields{values};
    const double thickness = thickness_of(fields, options);
    if (thickness == 0)
        return &thin_curve;
    const Spline spline{fields.flags(71), numbers_with(40, values), points_with(10, values), numbers_with(41, values)};
    if (!is_sound(spline))
        return &unsound;
    return add_curve(points_on(spline, options.chord_tolerance, shapes.deviations),
                     object_axes(fields.extrusion()).z * thickness, shapes);
}

Reason add_multiline(Values values, const ShapeOptions& options, Shapes& shapes)
{
    constexpr int closed = 2;
    if (options.raised_by == 0)
        return &thin_curve;
    const std::vector<Point> corners = points_with(11, values), mitres = points_with(13, values);
    std::vector<std::vector<Point>> lines;
    std::size_t corner = 0, line = 0;
    bool offset_follows = false; // of the numbers 41 of a line at a corner, the first is its offset along the mitre
    for (const Value& value : values) {
        if (value.code == 11) {
            ++corner;
            line = 0;
        } else if (value.code == 74) {
            offset_follows = true;
        } else if (value.code == 41 && offset_follows && corner > 0 && corner <= mitres.size()) {
            offset_follows = false;
            lines.resize(std::max(lines.size(), line + 1));
            lines[line++].push_back(corners[corner - 1] + mitres[corner - 1] * value.number);
        }
    }
    for (const std::vector<Point>& points : lines)
        shapes.add_walls(points, Fields{values}.flags(71) & closed, {0, 0, options.raised_by});
    return shapes.empty() ? &no_area : nullptr;
}

} // namespace lightwell::dxf
