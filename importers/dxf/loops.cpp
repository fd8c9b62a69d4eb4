#include "importers/dxf/loops.h"

#include <algorithm>
#include <numeric>

namespace lightwell::dxf {
namespace {

double area_of(const Loop& loop)
{
    return std::fabs(polygon_area_vector(loop.points.data(), loop.points.size()).z);
}

/// Crossing number of the ray to +x.
bool is_inside(const Point& p, const std::vector<Point>& loop)
{
    bool inside = false;
    for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
        const Point &a = loop[i], &b = loop[j];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y))
            inside = !inside;
    }
    return inside;
}

/// True when the smaller loop lies in the larger one: most of some of its corners and middles of sides do, since
/// neighbouring loops may share corners and sides.
bool lies_in(const Loop& small, const Loop& large)
{
    constexpr std::size_t samples = 9;
    const std::vector<Point>& points = small.points;
    std::size_t inside = 0;
    for (std::size_t i = 0; i < samples; ++i) {
        const std::size_t at = i * points.size() / samples;
        const Point& next = points[(at + 1) % points.size()];
        inside += is_inside(i % 2 == 0 ? (points[at] + next) * 0.5 : points[at], large.points);
    }
    return 2 * inside > samples;
}

} // namespace

std::vector<FilledLoop> nested(const std::vector<Loop>& loops, Islands islands)
{
    std::vector<std::size_t> by_area(loops.size());
    std::iota(by_area.begin(), by_area.end(), std::size_t{0});
    std::vector<double> areas;
    std::vector<Box> boxes(loops.size());
    for (std::size_t i = 0; i < loops.size(); ++i) {
        areas.push_back(area_of(loops[i]));
        for (const Point& point : loops[i].points)
            boxes[i].extend(point);
    }
    std::stable_sort(by_area.begin(), by_area.end(), [&](auto a, auto b) { return areas[a] > areas[b]; });
    const auto in_box = [&](std::size_t small, std::size_t large) {
        const Box &s = boxes[small], &l = boxes[large];
        return s.low.x >= l.low.x && s.low.y >= l.low.y && s.high.x <= l.high.x && s.high.y <= l.high.y;
    };
    std::vector<std::size_t> depth(loops.size(), 0);
    std::vector<FilledLoop> filled;
    std::vector<std::size_t> filled_of(loops.size());
    const std::size_t deepest_filled = islands == Islands::alternate ? loops.size() : 0;
    for (std::size_t rank = 0; rank < loops.size(); ++rank) {
        const std::size_t loop = by_area[rank];
        std::size_t parent = loops.size();
        for (std::size_t above = rank; above-- > 0 && parent == loops.size();) // the smallest one around it
            if (in_box(loop, by_area[above]) && lies_in(loops[loop], loops[by_area[above]]))
                parent = by_area[above];
        depth[loop] = parent == loops.size() ? 0 : depth[parent] + 1;
        if (depth[loop] % 2 == 0 && depth[loop] <= deepest_filled) {
            filled_of[loop] = filled.size();
            filled.push_back({loop, {}});
        } else if (depth[loop] % 2 == 1 && depth[loop] <= deepest_filled + 1 && islands != Islands::ignored) {
            filled[filled_of[parent]].holes.push_back(loop);
        }
    }
    return filled;
}

std::vector<Point> turned(const Loop& loop, bool counter_clockwise)
{
    std::vector<Point> points = loop.points;
    if ((polygon_area_vector(points.data(), points.size()).z > 0) != counter_clockwise)
        std::reverse(points.begin(), points.end());
    return points;
}

std::vector<Point> joined(const std::vector<Loop>& loops, const FilledLoop& filled)
{
    const auto by_x = [](const Point& a, const Point& b) { return a.x < b.x; };
    std::vector<std::vector<Point>> holes;
    for (const std::size_t hole : filled.holes) {
        std::vector<Point> points = turned(loops[hole], false);
        std::rotate(points.begin(), std::max_element(points.begin(), points.end(), by_x), points.end());
        holes.push_back(std::move(points));
    }
    // From the right to the left: a seam goes to the right, where all holes are joined already.
    std::stable_sort(holes.begin(), holes.end(), [](const auto& a, const auto& b) { return a[0].x > b[0].x; });
    std::vector<Point> outline = turned(loops[filled.outline], true);
    for (std::vector<Point>& hole : holes) {
        const Point from = hole.front();
        const auto cost = [&](const Point& to) { return to.x >= from.x ? length(to - from) : infinity; };
        const auto to = std::min_element(outline.begin(), outline.end(),
                                         [&](const Point& a, const Point& b) { return cost(a) < cost(b); });
        const Point corner = *to;
        hole.insert(hole.end(), {from, corner});
        outline.insert(to + 1, hole.begin(), hole.end());
    }
    return outline;
}

} // namespace lightwell::dxf
