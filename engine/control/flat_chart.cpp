#include "engine/control/flat_chart.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "engine/geometry/triangulate.h"

#include <algorithm>
#include <bit>

namespace lightwell {
namespace {

/// Places a side by which a texel's covered part is found.
constexpr int parts = 4;
constexpr std::uint16_t all_parts = 0xFFFF;

struct Corner {
    double x, y; ///< in texels
};

/// The covered places of every texel, one bit each.
class Coverage {
public:
    Coverage(int columns, int rows)
        : columns_(columns), rows_(rows), bits_(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows))
    {
    }
    /// Even-odd rule, line by line: a seam is walked twice and so counts for nothing.
    void add(const std::vector<Corner>& loop)
    {
        double low = infinity, high = -infinity;
        for (const Corner& c : loop) {
            low = std::fmin(low, c.y);
            high = std::fmax(high, c.y);
        }
        const int first = std::max(0, static_cast<int>(std::floor(low * parts)));
        const int last = std::min(rows_ * parts - 1, static_cast<int>(std::ceil(high * parts)));
        for (int line = first; line <= last; ++line)
            add_line(loop, line);
    }
    std::uint16_t bits(std::size_t texel) const { return bits_[texel]; }

private:
    void add_line(const std::vector<Corner>& loop, int line)
    {
        const double y = (line + 0.5) / parts;
        crossings_.clear();
        for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++)
            if ((loop[i].y > y) != (loop[j].y > y))
                crossings_.push_back((loop[j].x - loop[i].x) * (y - loop[i].y) / (loop[j].y - loop[i].y) + loop[i].x);
        std::sort(crossings_.begin(), crossings_.end());
        for (std::size_t k = 0; k + 1 < crossings_.size(); k += 2) {
            const int from = std::max(0, static_cast<int>(std::ceil(crossings_[k] * parts - 0.5)));
            const int to =
                std::min(columns_ * parts - 1, static_cast<int>(std::ceil(crossings_[k + 1] * parts - 0.5)) - 1);
            for (int x = from; x <= to; ++x)
                bits_[static_cast<std::size_t>(line / parts) * static_cast<std::size_t>(columns_) +
                      static_cast<std::size_t>(x / parts)] |=
                    static_cast<std::uint16_t>(1u << (line % parts * parts + x % parts));
        }
    }

    int columns_, rows_;
    std::vector<std::uint16_t> bits_;
    std::vector<double> crossings_;
};

/// The covered place nearest the middle of a texel, in texels from its lower left; the middle itself when all is.
Corner place_in(std::uint16_t bits)
{
    if (bits == all_parts)
        return {0.5, 0.5};
    Corner best{};
    double nearest = infinity;
    for (int i = 0; i < parts * parts; ++i) {
        const Corner c{(i % parts + 0.5) / parts, (i / parts + 0.5) / parts};
        const double distance = std::hypot(c.x - 0.5, c.y - 0.5);
        if ((bits >> i & 1) != 0 && distance < nearest) {
            nearest = distance;
            best = c;
        }
    }
    return best;
}

/// A rectangle in the plane that holds all corners.
struct Enclosing {
    Point corner;
    Direction x, y;
    double width = 0, height = 0;
};

Enclosing enclosing(const std::vector<std::vector<Point>>& outlines, const Direction& normal, const Direction& along)
{
    Enclosing r{{}, along, cross(normal, along), 0, 0};
    const Point origin = outlines.front().front();
    double low_x = infinity, high_x = -infinity, low_y = infinity, high_y = -infinity;
    for (const std::vector<Point>& loop : outlines)
        for (const Point& p : loop) {
            low_x = std::fmin(low_x, dot(p - origin, r.x));
            high_x = std::fmax(high_x, dot(p - origin, r.x));
            low_y = std::fmin(low_y, dot(p - origin, r.y));
            high_y = std::fmax(high_y, dot(p - origin, r.y));
        }
    r.corner = origin + r.x * low_x + r.y * low_y;
    r.width = high_x - low_x;
    r.height = high_y - low_y;
    return r;
}

/// The smallest along one of the longest edges; without an edge, of no size.
Enclosing smallest_enclosing(const std::vector<std::vector<Point>>& outlines, const Direction& normal)
{
    constexpr std::size_t edges_tried = 16;
    std::vector<Vec3> edges;
    for (const std::vector<Point>& loop : outlines)
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vec3 edge = loop[(i + 1) % loop.size()] - loop[i], flat = edge - normal * dot(edge, normal);
            if (length(flat) > 0)
                edges.push_back(flat);
        }
    std::stable_sort(edges.begin(), edges.end(), [](const Vec3& a, const Vec3& b) { return length(a) > length(b); });
    edges.resize(std::min(edges.size(), edges_tried));
    Enclosing best;
    for (const Vec3& edge : edges) {
        const Enclosing r = enclosing(outlines, normal, normalized(edge));
        constexpr double clearly_smaller = 1 - 1e-6; // else the longer edge decides
        if (best.width == 0 || r.width * r.height < clearly_smaller * best.width * best.height)
            best = r;
    }
    return best;
}

/// A point well inside the first outline with area.
Point some_point_inside(const std::vector<std::vector<Point>>& outlines)
{
    Point best{};
    double largest = 0;
    for (const std::vector<Point>& loop : outlines)
        for (const auto& t : triangulate(loop.data(), loop.size())) {
            const Point a = loop[t[0]], b = loop[t[1]], c = loop[t[2]];
            if (const double area = length(cross(b - a, c - a)); area > largest) {
                largest = area;
                best = a + (b - a) / 3 + (c - a) / 3;
            }
        }
    return best;
}

/// Makes the texels' areas sum to the surface's own.
void scale_areas(SurfaceChart& chart, double area_m2)
{
    double sum = 0;
    for (const double a : chart.areas_m2)
        sum += a;
    for (double& a : chart.areas_m2)
        a *= area_m2 / sum;
}

} // namespace

int texels_along(double length_m, double spacing_m)
{
    const double count = std::fmax(1, std::ceil(length_m / spacing_m - 1e-9));
    if (!(count <= most_texels))
        throw InputError("spacing " + shortest(spacing_m) + " m",
                         "a surface of " + shortest(length_m) + " m would have too many texels", "use a wider spacing");
    return static_cast<int>(count);
}

SurfaceChart flat_chart(const std::vector<std::vector<Point>>& outlines, const Direction& normal, double spacing_m)
{
    SurfaceChart chart;
    double area = 0;
    for (const std::vector<Point>& loop : outlines)
        area += length(polygon_area_vector(loop.data(), loop.size()));
    const Enclosing box = smallest_enclosing(outlines, normal);
    if (!(area > 0) || !(box.width > 0 && box.height > 0))
        return chart;
    chart.columns = texels_along(box.width, spacing_m);
    chart.rows = texels_along(box.height, spacing_m);
    if (static_cast<double>(chart.columns) * chart.rows > most_texels)
        texels_along(box.width * box.height, spacing_m * spacing_m);
    chart.corner = box.corner;
    chart.across = box.x * box.width;
    chart.up = box.y * box.height;
    Coverage coverage(chart.columns, chart.rows);
    for (const std::vector<Point>& loop : outlines) {
        std::vector<Corner> flat_loop;
        for (const Point& p : loop)
            flat_loop.push_back({dot(p - box.corner, box.x) / box.width * chart.columns,
                                 dot(p - box.corner, box.y) / box.height * chart.rows});
        coverage.add(flat_loop);
    }
    chart.cells.assign(static_cast<std::size_t>(chart.columns) * static_cast<std::size_t>(chart.rows), -1);
    for (std::size_t texel = 0; texel < chart.cells.size(); ++texel) {
        const std::uint16_t bits = coverage.bits(texel);
        if (bits == 0)
            continue;
        const Corner place = place_in(bits);
        const double u =
            (static_cast<double>(texel % static_cast<std::size_t>(chart.columns)) + place.x) / chart.columns;
        const double v = (static_cast<double>(texel / static_cast<std::size_t>(chart.columns)) + place.y) / chart.rows;
        chart.cells[texel] = static_cast<int>(chart.sensors.size());
        chart.sensors.push_back({chart.corner + chart.across * u + chart.up * v, normal});
        chart.areas_m2.push_back(std::popcount(bits));
    }
    if (chart.sensors.empty()) { // a sliver between all places
        chart.cells.front() = 0;
        chart.sensors.push_back({some_point_inside(outlines), normal});
        chart.areas_m2.push_back(1);
    }
    scale_areas(chart, area);
    return chart;
}

} // namespace lightwell
