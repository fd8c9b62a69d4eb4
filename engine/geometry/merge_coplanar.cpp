#include "engine/geometry/merge_coplanar.h"

#include "engine/geometry/half_edges.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lightwell {
namespace {

/// Corners may leave the plane by this share of the size of the triangle that defines it: single precision does so.
constexpr double plane_tolerance = 1e-5;
/// Triangles whose height is below this share of their longest side have no normal worth the name.
constexpr double sliver = 1e-5;
/// Normals of one flat face differ by rounding only; 1e-3 rad is far above that and far below a bend by design.
constexpr double same_normal_cosine = 1 - 0.5e-6;
/// A corner this near to the straight line, as a share of the line's length, stands on it.
constexpr double straight_tolerance = 1e-6;
/// The face must have the area of its triangles: else they overlap.
constexpr double area_tolerance = 1e-6;

using Index = std::uint32_t;
constexpr Index none = HalfEdges::none;
using Loop = std::vector<Index>;

struct Triangle {
    Vec3 twice_area;
    double size = 0; ///< longest side
    bool is_sliver() const { return !(length(twice_area) > sliver * size * size); }
};

class Merger {
public:
    explicit Merger(const TriangleSoup& soup);
    std::vector<FlatFace> run();

private:
    void grow_regions();
    bool fits(Index triangle, Index seed) const;
    bool trace(FlatFace& face, const Vec3& front);
    std::vector<Loop> loops_of(const FlatFace& face);
    bool is_inside(Index side, Index region) const;
    Index corner(Index side) const { return soup_.triangles[side / 3][side % 3]; }
    Index end_of(Index side) const { return soup_.triangles[side / 3][(side % 3 + 1) % 3]; }
    void find_straight_points();
    void keep_bent_chains(bool& changed);
    void drop_straight_points();

    const TriangleSoup& soup_;
    std::vector<Triangle> shapes_;
    HalfEdges edges_;
    std::vector<bool> walked_;  ///< by side: it is part of a loop
    std::vector<Index> region_; ///< by triangle
    std::vector<FlatFace> faces_;
    std::vector<bool> straight_; ///< by point
};

Merger::Merger(const TriangleSoup& soup)
    : soup_(soup), edges_(soup.points.size(), soup.triangles), walked_(3 * soup.triangles.size(), false),
      region_(soup.triangles.size(), none), straight_(soup.points.size(), false)
{
    shapes_.reserve(soup.triangles.size());
    for (const auto& [a, b, c] : soup.triangles) {
        const Point &p = soup.points[a], &q = soup.points[b], &r = soup.points[c];
        shapes_.push_back(
            {cross(q - p, r - p), std::sqrt(std::max({dot(q - p, q - p), dot(r - q, r - q), dot(p - r, p - r)}))});
    }
}

bool Merger::fits(Index triangle, Index seed) const
{
    if (soup_.groups[triangle] != soup_.groups[seed])
        return false;
    const Direction front = normalized(shapes_[seed].twice_area);
    const Point& origin = soup_.points[soup_.triangles[seed][0]];
    for (const Index point : soup_.triangles[triangle])
        if (!(std::fabs(dot(soup_.points[point] - origin, front)) <= plane_tolerance * shapes_[seed].size))
            return false;
    const Triangle& shape = shapes_[triangle];
    return shape.is_sliver() || dot(normalized(shape.twice_area), front) >= same_normal_cosine;
}

/// From the largest triangles on, since their planes are known best.
void Merger::grow_regions()
{
    std::vector<Index> by_area(soup_.triangles.size());
    std::iota(by_area.begin(), by_area.end(), Index{0});
    std::vector<double> areas;
    for (const Triangle& shape : shapes_)
        areas.push_back(dot(shape.twice_area, shape.twice_area));
    std::stable_sort(by_area.begin(), by_area.end(), [&](Index a, Index b) { return areas[a] > areas[b]; });
    for (const Index seed : by_area) {
        if (region_[seed] != none || shapes_[seed].is_sliver())
            continue;
        const auto number = static_cast<Index>(faces_.size());
        region_[seed] = number;
        FlatFace face{{seed}, {}, {}};
        for (std::size_t next = 0; next < face.triangles.size(); ++next)
            for (Index side = 3 * face.triangles[next]; side < 3 * face.triangles[next] + 3; ++side) {
                const Index across = edges_.beyond(side);
                if (across == none)
                    continue;
                const Index beyond = across / 3;
                if (region_[beyond] != none || !fits(beyond, seed))
                    continue;
                region_[beyond] = number;
                face.triangles.push_back(beyond);
            }
        faces_.push_back(std::move(face));
        if (faces_.back().triangles.size() < 2 || !trace(faces_.back(), normalized(shapes_[seed].twice_area)))
            faces_.back() = {};
    }
}

/// Whether the triangle beyond a side belongs to the region too.
bool Merger::is_inside(Index side, Index region) const
{
    const Index across = edges_.beyond(side);
    return across != none && region_[across / 3] == region;
}

/// Walks the sides without a neighbour in the region: at the end of each, round its point through the region's own
/// triangles to the next, so that loops touch but never cross.
std::vector<Loop> Merger::loops_of(const FlatFace& face)
{
    const Index region = region_[face.triangles[0]];
    const auto next_of = [&](Index side) {
        Index turned = HalfEdges::next(side);
        while (is_inside(turned, region))
            turned = HalfEdges::next(edges_.beyond(turned));
        return turned;
    };
    std::vector<Loop> loops;
    for (const Index triangle : face.triangles)
        for (Index start = 3 * triangle; start < 3 * triangle + 3; ++start) {
            if (walked_[start] || is_inside(start, region))
                continue;
            Loop loop;
            for (Index side = start; !walked_[side]; side = next_of(side)) {
                walked_[side] = true;
                loop.push_back(corner(side));
            }
            loops.push_back(std::move(loop));
        }
    return loops;
}

/// @return false when the region is no flat face with holes: more than one outline, or overlaps
bool Merger::trace(FlatFace& face, const Vec3& front)
{
    std::sort(face.triangles.begin(), face.triangles.end());
    double triangles = 0, loops = 0;
    for (const Index triangle : face.triangles)
        triangles += dot(shapes_[triangle].twice_area, front);
    for (Loop& loop : loops_of(face)) {
        Vec3 twice_area;
        for (std::size_t i = 1; i + 1 < loop.size(); ++i)
            twice_area +=
                cross(soup_.points[loop[i]] - soup_.points[loop[0]], soup_.points[loop[i + 1]] - soup_.points[loop[0]]);
        const double signed_area = dot(twice_area, front);
        loops += signed_area;
        if (signed_area > 0 && !face.outline.empty())
            return false;
        if (signed_area > 0)
            face.outline = std::move(loop);
        else
            face.holes.push_back(std::move(loop));
    }
    return !face.outline.empty() && std::fabs(loops - triangles) <= area_tolerance * triangles;
}

double off_line(const Point& p, const Point& a, const Point& b)
{
    const Vec3 along = b - a;
    const double size = length(along);
    return size > 0 ? length(cross(p - a, along)) / (size * size) : infinity;
}

template <class Visit>
void visit_loops(const std::vector<FlatFace>& faces, const Visit& visit)
{
    for (const FlatFace& face : faces) {
        if (!face.outline.empty())
            visit(face.outline);
        for (const Loop& hole : face.holes)
            visit(hole);
    }
}

/// A point may go when just two edges meet at it, seen from all faces and single triangles, and they are one line.
void Merger::find_straight_points()
{
    std::vector<std::array<Index, 2>> ends(soup_.points.size(), {none, none});
    std::vector<bool> branches(soup_.points.size(), false);
    const auto add = [&](Index from, Index to) {
        for (const auto& [at, other] : {std::pair{from, to}, std::pair{to, from}}) {
            std::array<Index, 2>& known = ends[at];
            if (known[0] == other || known[1] == other)
                continue;
            if (known[0] == none)
                known[0] = other;
            else if (known[1] == none)
                known[1] = other;
            else
                branches[at] = true;
        }
    };
    visit_loops(faces_, [&](const Loop& loop) {
        for (std::size_t i = 0; i < loop.size(); ++i)
            add(loop[i], loop[(i + 1) % loop.size()]);
    });
    for (Index triangle = 0; triangle < soup_.triangles.size(); ++triangle)
        if (region_[triangle] == none || faces_[region_[triangle]].triangles.empty())
            for (Index side = 3 * triangle; side < 3 * triangle + 3; ++side)
                add(corner(side), end_of(side));
    for (Index point = 0; point < soup_.points.size(); ++point) {
        const auto& [a, b] = ends[point];
        if (b == none || branches[point] || soup_.kept_points[point])
            continue;
        const Point &p = soup_.points[point], &q = soup_.points[a], &r = soup_.points[b];
        straight_[point] = dot(q - p, r - p) < 0 && off_line(p, q, r) <= straight_tolerance;
    }
}

/// Many nearly straight corners in a row may make a curve: then all of them stay.
void Merger::keep_bent_chains(bool& changed)
{
    visit_loops(faces_, [&](const Loop& loop) {
        const std::size_t count = loop.size();
        Loop kept; // positions in the loop
        for (Index i = 0; i < count; ++i)
            if (!straight_[loop[i]])
                kept.push_back(i);
        for (std::size_t k = 0; k < kept.size(); ++k) {
            const std::size_t from = kept[k], to = kept[(k + 1) % kept.size()] + (k + 1 == kept.size() ? count : 0);
            bool bent = kept.size() < 3;
            for (std::size_t i = from + 1; i < to; ++i)
                bent = bent || off_line(soup_.points[loop[i % count]], soup_.points[loop[from]],
                                        soup_.points[loop[to % count]]) > straight_tolerance;
            for (std::size_t i = from + 1; i < to && bent; ++i) {
                straight_[loop[i % count]] = false;
                changed = true;
            }
        }
        for (std::size_t i = 0; i < count && kept.empty(); ++i) {
            straight_[loop[i]] = false;
            changed = true;
        }
    });
}

void Merger::drop_straight_points()
{
    find_straight_points();
    for (bool changed = true; changed;) {
        changed = false;
        keep_bent_chains(changed);
    }
    for (FlatFace& face : faces_) {
        const auto straight = [&](Index point) { return static_cast<bool>(straight_[point]); };
        std::erase_if(face.outline, straight);
        for (Loop& hole : face.holes)
            std::erase_if(hole, straight);
    }
}

std::vector<FlatFace> Merger::run()
{
    grow_regions();
    drop_straight_points();
    std::erase_if(faces_, [](const FlatFace& face) { return face.triangles.empty(); });
    return std::move(faces_);
}

} // namespace

std::vector<FlatFace> merge_coplanar(const TriangleSoup& soup)
{
    return Merger(soup).run();
}

} // namespace lightwell
