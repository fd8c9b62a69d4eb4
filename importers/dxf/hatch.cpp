#include "importers/dxf/geometry.h"
#include "importers/dxf/loops.h"
#include "importers/dxf/shapes.h"
#include "importers/dxf/spline.h"

#include <algorithm>

namespace lightwell::dxf {
namespace {

/// Group codes of a HATCH that divide its numbers.
enum HatchCode { solid_fill = 70, path_count = 91, path_flags = 92, style = 75, edge_kind = 72 };
constexpr int polyline_path = 2;
/// To nest loops takes a time that grows with the square of their number and with their corners; a hatch of a plan has
/// a dozen loops. These take a second.
constexpr std::size_t most_loops = 4000, most_loop_corners = 100'000'000;
/// Ends of edges that are this share of the larger extent apart are meant to meet.
constexpr double meets_within = 1e-6;

bool is(const Value& value, int code)
{
    return value.code == code;
}

/// The pieces of a list that each begin with a code.
std::vector<Values> pieces_at(Values values, int code)
{
    std::vector<Values> pieces;
    const auto begins = [code](const Value& value) { return is(value, code); };
    auto at = std::find_if(values.begin(), values.end(), begins);
    while (at != values.end()) {
        const auto next = std::find_if(at + 1, values.end(), begins);
        pieces.emplace_back(at, next);
        at = next;
    }
    return pieces;
}

/// Reads boundaries in the plane of the hatch.
class LoopReader {
public:
    LoopReader(double chord_tolerance, Deviations& deviations) : tolerance_(chord_tolerance), deviations_(deviations) {}
    Loop read(Values path);

private:
    Loop polyline_loop(Values path);
    Loop edge_loop(Values path);
    std::vector<Point> edge_points(Values edge, Loop& loop);
    std::vector<Point> arc_points(const Fields& edge, bool elliptic);
    std::vector<Point> points_of(const Arc& arc);

    double tolerance_;
    Deviations& deviations_;
};

Loop LoopReader::read(Values path)
{
    Loop loop = static_cast<int>(path.front().number) & polyline_path ? polyline_loop(path) : edge_loop(path);
    std::vector<Point>& points = loop.points;
    points.erase(std::unique(points.begin(), points.end()), points.end());
    while (points.size() > 1 && points.front() == points.back())
        points.pop_back();
    return loop;
}

std::vector<Point> LoopReader::points_of(const Arc& arc)
{
    const int chords = chord_count(arc.radius, arc.sweep_rad, tolerance_);
    std::vector<Point> points;
    for (int i = 0; i <= chords; ++i)
        points.push_back(arc.at(static_cast<double>(i) / chords));
    deviations_.chords += static_cast<std::size_t>(chords);
    deviations_.chord_error = std::fmax(deviations_.chord_error, chord_error(arc.radius, arc.sweep_rad, chords));
    return points;
}

Loop LoopReader::polyline_loop(Values path)
{
    struct Corner {
        Point at;
        double bulge = 0;
    };
    constexpr double straight_below = 2e-12, equal_within = 1e-9; // as in polylines.cpp
    std::vector<Corner> corners;
    for (const Value& value : path)
        if (is(value, 10))
            corners.push_back({{value.number, 0, 0}});
        else if (is(value, 20) && !corners.empty())
            corners.back().at.y = value.number;
        else if (is(value, 42) && !corners.empty())
            corners.back().bulge = value.number;
    Loop loop;
    if (corners.size() == 2 && std::fabs(std::fabs(corners[0].bulge) - 1) < equal_within &&
        std::fabs(corners[0].bulge - corners[1].bulge) < equal_within)
        loop.circle = {(corners[0].at + corners[1].at) * 0.5, 0.5 * length(corners[1].at - corners[0].at)};
    for (std::size_t i = 0; i < corners.size() && deviations_.chords <= most_facets; ++i) {
        const Corner& from = corners[i];
        const Point& to = corners[(i + 1) % corners.size()].at;
        loop.points.push_back(from.at);
        if (std::fabs(from.bulge) < straight_below || from.at == to)
            continue;
        const std::vector<Point> arc = points_of(arc_of_bulge(from.at, to, from.bulge));
        loop.points.insert(loop.points.end(), arc.begin() + 1, arc.end() - 1);
    }
    return loop;
}

std::vector<Point> LoopReader::arc_points(const Fields& edge, bool elliptic)
{
    // A clockwise edge counts its angles clockwise.
    const double sign = edge.get(73, 1) != 0 ? 1 : -1;
    const double start_rad = edge.get(50) * radians_per_degree;
    const double sweep_rad = sweep_between(start_rad, edge.get(51) * radians_per_degree);
    const Point centre{edge.get(10), edge.get(20), 0};
    if (elliptic) {
        const Vec3 major{edge.get(11), edge.get(21), 0};
        const Vec3 minor = Vec3{-major.y, major.x, 0} * edge.get(40, 1);
        return points_on_ellipse(centre, major, minor, sign * start_rad, sign * sweep_rad, tolerance_, deviations_);
    }
    const double radius = edge.get(40);
    if (!(radius > 0))
        return {};
    return points_of({centre, radius, sign * start_rad, sign * sweep_rad});
}

std::vector<Point> LoopReader::edge_points(Values edge, Loop& loop)
{
    enum EdgeKind { line = 1, arc = 2, ellipse = 3, spline = 4 };
    const Fields fields{edge};
    switch (fields.flags(edge_kind)) {
    case line:
        return {{fields.get(10), fields.get(20), 0}, {fields.get(11), fields.get(21), 0}};
    case arc: {
        constexpr double whole_turn = 2 * pi * (1 - 1e-9);
        if (sweep_between(fields.get(50) * radians_per_degree, fields.get(51) * radians_per_degree) > whole_turn)
            loop.circle = {{fields.get(10), fields.get(20), 0}, fields.get(40)};
        return arc_points(fields, false);
    }
    case ellipse:
        return arc_points(fields, true);
    case spline: {
        const Spline curve{static_cast<int>(fields.get(94)), numbers_with(40, edge), points_with(10, edge),
                           numbers_with(42, edge)};
        return is_sound(curve) ? points_on(curve, tolerance_, deviations_) : std::vector<Point>{};
    }
    default:
        return {};
    }
}

Loop LoopReader::edge_loop(Values path)
{
    Loop loop;
    const std::vector<Values> edges = pieces_at(path, edge_kind);
    Box box;
    std::vector<std::vector<Point>> pieces;
    for (const Values edge : edges) {
        if (deviations_.chords > most_facets)
            break;
        pieces.push_back(edge_points(edge, loop));
        for (const Point& point : pieces.back())
            box.extend(point);
    }
    if (pieces.size() > 1)
        loop.circle.reset();
    const double close = box.empty() ? 0 : meets_within * box.diagonal();
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        std::vector<Point>& piece = pieces[i];
        if (piece.empty())
            continue;
        // Edges may be written against the direction of the boundary.
        const bool first = loop.points.empty();
        const std::vector<Point>* next =
            first && i + 1 < pieces.size() && !pieces[i + 1].empty() ? &pieces[i + 1] : nullptr;
        const auto meets = [close](const Point& a, const Point& b) { return length(a - b) <= close; };
        const bool turn =
            next ? !meets(piece.back(), next->front()) && !meets(piece.back(), next->back()) &&
                       (meets(piece.front(), next->front()) || meets(piece.front(), next->back()))
                 : !first && !meets(loop.points.back(), piece.front()) && meets(loop.points.back(), piece.back());
        if (turn)
            std::reverse(piece.begin(), piece.end());
        const bool joins = !first && meets(loop.points.back(), piece.front());
        loop.points.insert(loop.points.end(), piece.begin() + (joins ? 1 : 0), piece.end());
    }
    if (loop.points.size() > 1 && length(loop.points.front() - loop.points.back()) <= close)
        loop.points.pop_back();
    return loop;
}

/// Writes filled loops as surfaces at the height of the hatch, or as bodies where it has a thickness.
class AreaWriter {
public:
    AreaWriter(const Affine& axes, double elevation, double thickness, Shapes& shapes)
        : axes_(axes), base_(elevation + std::fmin(thickness, 0.0)), height_(axes.z * std::fabs(thickness)),
          shapes_(shapes)
    {
    }
    void add(const std::vector<Loop>& loops, const FilledLoop& filled)
    {
        const Loop& outline = loops[filled.outline];
        const bool one_hole = filled.holes.size() == 1;
        const Loop* hole = one_hole ? &loops[filled.holes.front()] : nullptr;
        if (outline.circle && (!hole || is_concentric(outline, *hole)) && filled.holes.size() < 2)
            add_disc(*outline.circle, hole ? hole->circle->radius : 0);
        else
            add_area(loops, filled);
    }

private:
    static bool is_concentric(const Loop& outline, const Loop& hole)
    {
        constexpr double within = 1e-12;
        return hole.circle && hole.circle->radius < outline.circle->radius &&
               length(hole.circle->centre - outline.circle->centre) <= within * outline.circle->radius;
    }
    void add_disc(const Loop::Circle& circle, double inner_radius);
    void add_area(const std::vector<Loop>& loops, const FilledLoop& filled);
    std::vector<Point> placed(std::vector<Point> points, double height) const;
    bool thick() const { return height_ != Vec3{}; }

    Affine axes_;
    double base_;
    Vec3 height_;
    Shapes& shapes_;
};

void AreaWriter::add_disc(const Loop::Circle& circle, double inner_radius)
{
    const Point centre = axes_.point(circle.centre + Vec3{0, 0, base_});
    if (!thick()) {
        shapes_.rings.push_back({centre, axes_.z, inner_radius, circle.radius});
        return;
    }
    shapes_.add_cylinder(centre, centre + height_, circle.radius, Shape::cylinder);
    if (inner_radius > 0)
        shapes_.add_cylinder(centre, centre + height_, inner_radius, Shape::tube);
    shapes_.add_caps(centre, height_, inner_radius, circle.radius);
}

std::vector<Point> AreaWriter::placed(std::vector<Point> points, double height) const
{
    for (Point& point : points)
        point = axes_.point(point + Vec3{0, 0, height});
    return points;
}

void AreaWriter::add_area(const std::vector<Loop>& loops, const FilledLoop& filled)
{
    std::vector<Point> outline = joined(loops, filled);
    shapes_.add_polygon(placed(outline, base_ + length(height_)));
    if (!thick())
        return;
    std::reverse(outline.begin(), outline.end());
    shapes_.add_polygon(placed(std::move(outline), base_));
    shapes_.add_walls(placed(turned(loops[filled.outline], true), base_), true, height_);
    for (const std::size_t hole : filled.holes)
        shapes_.add_walls(placed(turned(loops[hole], false), base_), true, height_);
}

/// True when loops can be nested in a reasonable time.
bool is_manageable(const std::vector<Loop>& loops)
{
    std::size_t corners = 0;
    for (const Loop& loop : loops)
        corners += loop.points.size();
    return loops.size() < 2 || corners <= most_loop_corners / loops.size();
}

bool has_area(const Loop& loop)
{
    constexpr double smallest_share = 1e-12; // of the squared extent; less is rounding
    Box box;
    for (const Point& point : loop.points)
        box.extend(point);
    return loop.points.size() > 2 && length(polygon_area_vector(loop.points.data(), loop.points.size())) >
                                         smallest_share * box.diagonal() * box.diagonal();
}

} // namespace

Reason add_hatch(Values values, const ShapeOptions& options, Shapes& shapes)
{
    static constexpr SkipReason too_many{"a hatch with thousands of boundaries", true};
    const auto first_path =
        std::find_if(values.begin(), values.end(), [](const Value& v) { return is(v, path_count); });
    const auto end = std::find_if(first_path, values.end(), [](const Value& v) { return is(v, style); });
    const Fields header{{values.begin(), first_path}}, rest{{end, values.end()}};
    LoopReader reader{options.chord_tolerance, shapes.deviations};
    std::vector<Loop> loops;
    for (const Values path : pieces_at({first_path, end}, path_flags)) {
        if (loops.size() == most_loops)
            return &too_many;
        Loop loop = reader.read(path);
        if (has_area(loop))
            loops.push_back(std::move(loop));
    }
    if (!is_manageable(loops))
        return &too_many;
    AreaWriter writer{object_axes(header.extrusion()), header.get(30), thickness_of(header, options), shapes};
    const int islands = rest.flags(style);
    for (const FilledLoop& filled : nested(loops, islands == 1   ? Islands::outermost
                                                  : islands == 2 ? Islands::ignored
                                                                 : Islands::alternate))
        writer.add(loops, filled);
    if (header.has(solid_fill) && header.get(solid_fill) == 0 && !shapes.empty())
        ++shapes.deviations.patterns;
    return shapes.empty() ? &no_area : nullptr;
}

} // namespace lightwell::dxf
