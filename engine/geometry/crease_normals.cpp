#include "engine/geometry/crease_normals.h"

#include "engine/geometry/half_edges.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace lightwell {
namespace {

using Index = std::uint32_t;

/// Sets of corners that share a normal.
class Sets {
public:
    explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), Index{0}); }
    Index root(Index i)
    {
        while (parent_[i] != i)
            i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(Index a, Index b) { parent_[std::max(root(a), root(b))] = std::min(root(a), root(b)); }

private:
    std::vector<Index> parent_;
};

/// Number of the first point at the same place, for each point.
std::vector<Index> places_of(const std::vector<Point>& points)
{
    std::vector<Index> order(points.size()), place(points.size());
    std::iota(order.begin(), order.end(), Index{0});
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
        const Point &p = points[a], &q = points[b];
        return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z != q.z ? p.z < q.z : a < b;
    });
    for (std::size_t i = 0; i < order.size(); ++i)
        place[order[i]] = i > 0 && points[order[i]] == points[order[i - 1]] ? place[order[i - 1]] : order[i];
    return place;
}

double angle_at(const Point& at, const Point& a, const Point& b)
{
    const Vec3 p = a - at, q = b - at;
    return std::atan2(length(cross(p, q)), dot(p, q));
}

} // namespace

Mesh crease_normals(const Mesh& mesh, double crease_angle_deg)
{
    const auto corners = static_cast<Index>(mesh.triangles.size());
    const double sharp_cosine = std::cos(crease_angle_deg * radians_per_degree);
    const std::vector<Index> place = places_of(mesh.points);
    std::vector<Direction> fronts;
    for (Index i = 0; i < corners; i += 3) {
        const Point& a = mesh.points[mesh.triangles[i]];
        fronts.push_back(
            normalized(cross(mesh.points[mesh.triangles[i + 1]] - a, mesh.points[mesh.triangles[i + 2]] - a)));
    }
    std::vector<std::array<Index, 3>> triangles(corners / 3);
    for (Index i = 0; i < corners; ++i)
        triangles[i / 3][i % 3] = place[mesh.triangles[i]];
    const HalfEdges edges(mesh.points.size(), triangles);
    Sets sets(corners);
    for (Index corner = 0; corner < corners; ++corner) {
        const Index other = edges.beyond(corner);
        if (other == HalfEdges::none) // an edge of more than two triangles stays sharp
            continue;
        if (dot(fronts[corner / 3], fronts[other / 3]) < sharp_cosine)
            continue;
        sets.join(corner, HalfEdges::next(other));
        sets.join(HalfEdges::next(corner), other);
    }
    std::vector<Vec3> sums(corners);
    for (Index corner = 0; corner < corners; ++corner) {
        const Index after = HalfEdges::next(corner), before = HalfEdges::next(after);
        sums[sets.root(corner)] +=
            fronts[corner / 3] * angle_at(mesh.points[mesh.triangles[corner]], mesh.points[mesh.triangles[after]],
                                          mesh.points[mesh.triangles[before]]);
    }
    Mesh result;
    std::unordered_map<std::uint64_t, Index> made; // by set and point: texture places may differ within a set
    for (Index corner = 0; corner < corners; ++corner) {
        const Index set = sets.root(corner), point = mesh.triangles[corner];
        const auto [entry, fresh] =
            made.try_emplace(static_cast<std::uint64_t>(set) << 32 | point, static_cast<Index>(result.points.size()));
        if (fresh) {
            const Direction mean = normalized(sums[set]);
            result.points.push_back(mesh.points[point]);
            result.normals.push_back(mean == Vec3{} ? fronts[corner / 3] : mean);
            for (std::size_t i = 0; i < 2 && !mesh.texture.empty(); ++i)
                result.texture.push_back(mesh.texture[2 * point + i]);
        }
        result.triangles.push_back(entry->second);
    }
    return result;
}

} // namespace lightwell
