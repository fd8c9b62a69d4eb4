#include "importers/double_panes.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace lightwell {
namespace {

/// Triple units with two cavities of 20 mm measure about as much.
constexpr double thickest_unit_m = 0.06;
constexpr double same_area = 0.02;
/// Sine of the angle between panes: drawing noise, no tilt.
constexpr double parallel = 1e-3;

struct Pane {
    std::size_t surface;
    Point middle; ///< of the box
    Direction normal;
    double area_m2;
};

bool is_pair(const Pane& a, const Pane& b)
{
    if (length(cross(a.normal, b.normal)) > parallel ||
        std::fabs(a.area_m2 - b.area_m2) > same_area * std::fmax(a.area_m2, b.area_m2))
        return false;
    const Vec3 way = b.middle - a.middle;
    const double distance = std::fabs(dot(way, a.normal));
    const double aside = length(way - a.normal * dot(way, a.normal));
    // Closer than a tenth of a millimetre is the same sheet drawn twice.
    constexpr double nearest_m = 1e-4, most_aside = 0.05;
    return distance >= nearest_m && distance <= thickest_unit_m && aside <= most_aside * std::sqrt(a.area_m2) &&
           a.area_m2 > distance * distance;
}

std::vector<Pane> panes_of(const Part& part, const std::vector<std::size_t>& candidates)
{
    std::vector<Pane> panes;
    for (const std::size_t index : candidates) {
        const Surface& surface = part.surfaces[index];
        if (surface.shape != Shape::polygon)
            continue;
        const Polygon& polygon = part.polygons[surface.index];
        const Vec3 area = polygon_area_vector(&part.points[polygon.first], polygon.count);
        if (length(area) > 0)
            panes.push_back({index, surface_bounds(part, surface).centre(), normalized(area), length(area)});
    }
    return panes;
}

using Cell = std::tuple<long long, long long, long long>;

Cell cell_of(const Point& p, int dx = 0, int dy = 0, int dz = 0)
{
    static constexpr double most_m = 1e12; // what is farther away shares a cell
    const auto at = [](double x, int step) {
        return static_cast<long long>(std::floor(std::clamp(x, -most_m, most_m) / thickest_unit_m)) + step;
    };
    return {at(p.x, dx), at(p.y, dy), at(p.z, dz)};
}

} // namespace

std::vector<std::pair<std::size_t, std::size_t>> double_panes(const Part& part,
                                                              const std::vector<std::size_t>& candidates)
{
    const std::vector<Pane> panes = panes_of(part, candidates);
    std::multimap<Cell, std::size_t> waiting; // by the cell of the middle: partners are in this cell or the next
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    constexpr int most_tried = 64; // more sheets than this in one place are no glazing
    const auto partner_of = [&](const Pane& pane) {
        for (int dx = -1; dx <= 1; ++dx)
            for (int dy = -1; dy <= 1; ++dy)
                for (int dz = -1; dz <= 1; ++dz) {
                    const auto [first, last] = waiting.equal_range(cell_of(pane.middle, dx, dy, dz));
                    int tried = 0;
                    for (auto entry = first; entry != last && tried < most_tried; ++entry, ++tried)
                        if (is_pair(panes[entry->second], pane))
                            return entry;
                }
        return waiting.end();
    };
    for (std::size_t i = 0; i < panes.size(); ++i) {
        const auto partner = partner_of(panes[i]);
        if (partner == waiting.end()) {
            waiting.emplace(cell_of(panes[i].middle), i);
            continue;
        }
        pairs.emplace_back(panes[partner->second].surface, panes[i].surface);
        waiting.erase(partner);
    }
    return pairs;
}

} // namespace lightwell
