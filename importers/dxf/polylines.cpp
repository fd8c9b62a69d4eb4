#include "importers/dxf/geometry.h"
#include "importers/dxf/shapes.h"

#include <algorithm>
#include <optional>

namespace lightwell::dxf {
namespace {

/// Widths and bulges that differ by less than this share are meant to be equal.
constexpr double equal_within = 1e-9;
/// Such a bulge moves the middle of a segment by less than 1e-12 of its length.
constexpr double straight_below = 2e-12;
/// An arc that is flatter has its centre so far away (10,000 lengths) that its place loses digits: it becomes chords.
constexpr double round_from = 2.5e-5;

/// A corner and the segment that leaves it. Object coordinates.
struct Corner {
    Point at;
    double bulge = 0;
    double start_width = 0, end_width = 0;
};

struct FlatPolyline {
    std::vector<Corner> corners;
    bool is_closed = false;
    Affine axes;          ///< object to model
    double thickness = 0; ///< upwards; a downward one has been turned into a lower elevation
};

/// One segment with its width: two borders of equally many points, equal where the width is zero. An arc of one width
/// is kept as such; then the borders have their ends only.
struct Strip {
    std::vector<Point> left, right;
    bool is_straight = true;
    double start_width = 0, end_width = 0;
    std::optional<Arc> arc = {};

    bool has_width() const { return start_width > 0 || end_width > 0; }
};

/// Two half circles of equal width, as programs draw discs and rings.
struct FullCircle {
    Point centre;
    double radius, width;
};

std::optional<FullCircle> full_circle(const FlatPolyline& line)
{
    if (!line.is_closed || line.corners.size() != 2)
        return std::nullopt;
    const Corner &a = line.corners[0], &b = line.corners[1];
    const double width = a.start_width, radius = length(b.at - a.at) / 2;
    const bool half_circles =
        std::fabs(std::fabs(a.bulge) - 1) < equal_within && std::fabs(a.bulge - b.bulge) < equal_within;
    for (const double other : {a.end_width, b.start_width, b.end_width})
        if (std::fabs(other - width) > equal_within * radius)
            return std::nullopt;
    if (!half_circles || !(radius > 0))
        return std::nullopt;
    return FullCircle{(a.at + b.at) * 0.5, radius, width};
}

void add_full_circle(const FullCircle& circle, const FlatPolyline& line, Shapes& shapes)
{
    const Point centre = line.axes.point(circle.centre);
    const Vec3 height = line.axes.z * line.thickness;
    const double outer = circle.radius + circle.width / 2;
    const double rest = circle.radius - circle.width / 2, inner = rest > equal_within * circle.radius ? rest : 0;
    if (line.thickness > 0)
        shapes.add_cylinder(centre, centre + height, outer, Shape::cylinder);
    if (circle.width == 0)
        return;
    if (line.thickness == 0) {
        shapes.rings.push_back({centre, line.axes.z, inner, outer});
        return;
    }
    shapes.add_caps(centre, height, inner, outer);
    if (inner > 0)
        shapes.add_cylinder(centre, centre + height, inner, Shape::tube);
}

Strip straight_strip(const Corner& from, const Point& to)
{
    const Vec3 along = normalized(to - from.at), left{-along.y, along.x, 0};
    Strip strip{{}, {}, true, from.start_width, from.end_width};
    strip.left = {from.at + left * (from.start_width / 2), to + left * (from.end_width / 2)};
    strip.right = {from.at - left * (from.start_width / 2), to - left * (from.end_width / 2)};
    return strip;
}

Strip arc_strip(const Corner& from, const Point& to, double chord_tolerance, Deviations& deviations)
{
    const Arc arc = arc_of_bulge(from.at, to, from.bulge);
    const double outer_radius = arc.radius + std::fmax(from.start_width, from.end_width) / 2;
    const bool exact = std::fabs(from.bulge) >= round_from &&
                       std::fabs(from.end_width - from.start_width) <= equal_within * arc.radius;
    const int chords = exact ? 1 : chord_count(outer_radius, arc.sweep_rad, chord_tolerance);
    Strip strip{{}, {}, false, from.start_width, from.end_width};
    if (exact)
        strip.arc = arc;
    for (int i = 0; i <= chords; ++i) {
        const double fraction = static_cast<double>(i) / chords;
        // The drawn corners themselves, so that neighbours meet without a gap.
        const Point on_arc = i == 0 ? from.at : i == chords ? to : arc.at(fraction);
        const double half_width = (from.start_width + fraction * (from.end_width - from.start_width)) / 2;
        const Vec3 outward = arc.outward(fraction);
        const Point outer = on_arc + outward * half_width, inner = on_arc - outward * std::fmin(half_width, arc.radius);
        strip.left.push_back(arc.sweep_rad > 0 ? inner : outer);
        strip.right.push_back(arc.sweep_rad > 0 ? outer : inner);
    }
    if (exact)
        return strip;
    deviations.chords += static_cast<std::size_t>(chords);
    deviations.chord_error = std::fmax(deviations.chord_error, chord_error(outer_radius, arc.sweep_rad, chords));
    return strip;
}

std::vector<Strip> strips_of(const FlatPolyline& line, double chord_tolerance, Deviations& deviations)
{
    std::vector<Strip> strips;
    const std::size_t count = line.corners.size(), segments = line.is_closed ? count : count - 1;
    for (std::size_t i = 0; i < segments && deviations.chords <= most_facets; ++i) {
        const Corner& from = line.corners[i];
        const Point& to = line.corners[(i + 1) % count].at;
        if (!(length(to - from.at) > 0))
            continue;
        strips.push_back(std::fabs(from.bulge) < straight_below ? straight_strip(from, to)
                                                                : arc_strip(from, to, chord_tolerance, deviations));
    }
    return strips;
}

/// Where the border lines a and b of two straight strips meet; nothing when that lies too far from both ends or
/// turns a border round.
std::optional<Point> mitred_corner(const std::vector<Point>& a, const std::vector<Point>& b, double width)
{
    constexpr double parallel_within = 1e-12;
    constexpr double longest_mitre = 10; // widths; sharper corners stay square
    const Vec3 u = a[1] - a[0], v = b[1] - b[0];
    const double turn = cross(u, v).z;
    if (std::fabs(turn) <= parallel_within * length(u) * length(v))
        return dot(u, v) > 0 ? std::optional<Point>{a[1]} : std::nullopt;
    const Point meeting = a[0] + u * (cross(b[0] - a[0], v).z / turn);
    const bool runs_on = dot(meeting - a[0], u) > 0 && dot(b[1] - meeting, v) > 0;
    return runs_on && length(meeting - a[1]) <= longest_mitre * width ? std::optional<Point>{meeting} : std::nullopt;
}

/// Lets neighbouring straight strips of equal width meet in a mitre, so that their areas neither overlap nor gape.
void mitre(Strip& before, Strip& after)
{
    const double width = before.end_width;
    if (!before.is_straight || !after.is_straight || !(width > 0) ||
        std::fabs(after.start_width - width) > equal_within * width)
        return;
    const auto left = mitred_corner(before.left, after.left, width);
    const auto right = mitred_corner(before.right, after.right, width);
    if (!left || !right)
        return;
    before.left[1] = after.left[0] = *left;
    before.right[1] = after.right[0] = *right;
}

class StripWriter {
public:
    StripWriter(const FlatPolyline& line, Shapes& shapes)
        : axes_(line.axes), height_(line.axes.z * line.thickness), thick_(line.thickness > 0), shapes_(shapes)
    {
    }
    /// @param starts, ends  nothing joins there: a thick band is closed by a wall
    void add(const Strip& strip, bool starts, bool ends)
    {
        if (strip.arc)
            add_arc(strip);
        else
            add_borders(strip);
        if (!thick_ || !strip.has_width())
            return;
        if (starts)
            add_wall(strip.left.front(), strip.right.front());
        if (ends)
            add_wall(strip.right.back(), strip.left.back());
    }

private:
    void add_borders(const Strip& strip)
    {
        if (strip.has_width())
            add_band(strip);
        if (!thick_)
            return;
        for (std::size_t i = 0; i + 1 < strip.right.size(); ++i)
            add_wall(strip.right[i], strip.right[i + 1]);
        for (std::size_t i = strip.left.size() - 1; strip.has_width() && i > 0; --i)
            add_wall(strip.left[i], strip.left[i - 1]);
    }
    /// The same of an arc: parts of rings and of cylinders.
    void add_arc(const Strip& strip)
    {
        const Arc& arc = *strip.arc;
        const Sector sector = arc.sector(axes_);
        const Point foot = axes_.point(arc.centre);
        const double half = strip.start_width / 2, outer = arc.radius + half, inner = std::fmax(0, arc.radius - half);
        if (strip.has_width())
            shapes_.rings.push_back({foot + height_, axes_.z, inner, outer, sector});
        if (!thick_)
            return;
        if (strip.has_width()) {
            shapes_.rings.push_back({foot, -axes_.z, inner, outer, turned_over(sector, axes_.z)});
            shapes_.add_cylinder(foot, foot + height_, outer, Shape::cylinder, sector);
            if (inner > 0)
                shapes_.add_cylinder(foot, foot + height_, inner, Shape::tube, sector);
        } else {
            // As of a straight wall, the front looks to the right of the way it is drawn.
            shapes_.add_cylinder(foot, foot + height_, outer, arc.sweep_rad > 0 ? Shape::cylinder : Shape::tube,
                                 sector);
        }
    }
    void add_band(const Strip& strip)
    {
        std::vector<Point> outline;
        for (const Point& point : strip.right)
            outline.push_back(axes_.point(point) + height_);
        for (auto point = strip.left.rbegin(); point != strip.left.rend(); ++point)
            outline.push_back(axes_.point(*point) + height_);
        shapes_.add_polygon(outline);
        if (!thick_)
            return;
        std::reverse(outline.begin(), outline.end());
        for (Point& point : outline)
            point = point - height_;
        shapes_.add_polygon(outline);
    }
    void add_wall(const Point& from, const Point& to)
    {
        const Point a = axes_.point(from), b = axes_.point(to);
        shapes_.add_polygon({a, b, b + height_, a + height_});
    }

    Affine axes_;
    Vec3 height_;
    bool thick_;
    Shapes& shapes_;
};

Reason add_polyline_shapes(const FlatPolyline& line, double chord_tolerance, Shapes& shapes)
{
    const bool wide = std::any_of(line.corners.begin(), line.corners.end(),
                                  [](const Corner& c) { return c.start_width > 0 || c.end_width > 0; });
    if (!wide && line.thickness == 0)
        return &thin;
    if (line.corners.size() < 2)
        return &no_area;
    if (const auto circle = full_circle(line)) {
        add_full_circle(*circle, line, shapes);
        return nullptr;
    }
    std::vector<Strip> strips = strips_of(line, chord_tolerance, shapes.deviations);
    for (std::size_t i = 0; i + 1 < strips.size(); ++i)
        mitre(strips[i], strips[i + 1]);
    if (line.is_closed && strips.size() > 2)
        mitre(strips.back(), strips.front());
    StripWriter writer{line, shapes};
    for (std::size_t i = 0; i < strips.size(); ++i)
        writer.add(strips[i], !line.is_closed && i == 0, !line.is_closed && i + 1 == strips.size());
    return shapes.empty() ? &no_area : nullptr;
}

/// What LWPOLYLINE and POLYLINE have in common.
FlatPolyline polyline_with(const Fields& header, const ShapeOptions& options)
{
    constexpr int closed = 1;
    FlatPolyline line;
    line.axes = object_axes(header.extrusion());
    line.thickness = std::fabs(thickness_of(header, options));
    line.is_closed = header.flags(70) & closed;
    return line;
}

/// Elevation of the lower edge.
double lower_edge(const Fields& header, const ShapeOptions& options, double elevation)
{
    return elevation + std::fmin(thickness_of(header, options), 0.0);
}

} // namespace

Reason add_lwpolyline(Values values, const ShapeOptions& options, Shapes& shapes)
{
    const Fields header{values};
    FlatPolyline line = polyline_with(header, options);
    const double z = lower_edge(header, options, header.get(38)), width = std::fmax(0.0, header.get(43));
    for (const Value& value : values) {
        if (value.code == 10)
            line.corners.push_back({{value.number, 0, z}, 0, width, width});
        else if (line.corners.empty())
            continue;
        else if (value.code == 20)
            line.corners.back().at.y = value.number;
        else if (value.code == 40)
            line.corners.back().start_width = std::fmax(0.0, value.number);
        else if (value.code == 41)
            line.corners.back().end_width = std::fmax(0.0, value.number);
        else if (value.code == 42)
            line.corners.back().bulge = value.number;
    }
    return add_polyline_shapes(line, options.chord_tolerance, shapes);
}

Reason add_flat_polyline(Values values, const ShapeOptions& options, Shapes& shapes)
{
    constexpr int spline_frame = 16; // control points of a fitted curve, whose own points follow
    const VertexList list{values};
    FlatPolyline line = polyline_with(list.header, options);
    const double z = lower_edge(list.header, options, list.header.get(30));
    for (const auto& vertex : list.vertices) {
        const Fields fields{vertex};
        if (fields.flags(70) & spline_frame)
            continue;
        line.corners.push_back({{fields.get(10), fields.get(20), z},
                                fields.get(42),
                                std::fmax(0.0, fields.get(40, list.header.get(40))),
                                std::fmax(0.0, fields.get(41, list.header.get(41)))});
    }
    return add_polyline_shapes(line, options.chord_tolerance, shapes);
}

Reason add_space_polyline(Values values, const ShapeOptions& options, Shapes& shapes)
{
    constexpr int closed = 1, spline_frame = 16;
    if (options.raised_by == 0)
        return &thin;
    const VertexList list{values};
    std::vector<Point> line;
    for (const Values& vertex : list.vertices)
        if (!(Fields{vertex}.flags(70) & spline_frame))
            line.push_back(Fields{vertex}.point(10));
    shapes.add_walls(line, list.header.flags(70) & closed, {0, 0, options.raised_by});
    return shapes.empty() ? &no_area : nullptr;
}

} // namespace lightwell::dxf
