#include "engine/geometry/half_edges.h"

#include <OpenMesh/Core/Mesh/TriConnectivity.hh>

#include <algorithm>
#include <numeric>

namespace lightwell {
namespace {

using Index = HalfEdges::Index;
using Triangles = std::vector<std::array<Index, 3>>;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

/// A triangle is added by walking the edges of its points: more triangles at one point are cut apart, so that a mesh
/// whose triangles all meet at one point takes time in proportion to its size.
constexpr Index most_at_a_point = 20'000;

/// OpenMesh turns such a triangle away, with a message on the standard error, or aborts.
bool can_add(const OpenMesh::TriConnectivity& mesh, const std::array<VertexHandle, 3>& corners)
{
    for (std::size_t i = 0; i < 3; ++i) {
        const VertexHandle from = corners[i], to = corners[(i + 1) % 3];
        if (from == to || !mesh.is_boundary(from))
            return false;
        const HalfedgeHandle known = mesh.find_halfedge(from, to);
        if (known.is_valid() && !mesh.is_boundary(known))
            return false;
    }
    return true;
}

/// For each side the one side that shares its edge and runs the other way.
std::vector<Index> partners_of(const Triangles& triangles)
{
    struct Side {
        Index low, high, number;
        bool forward; ///< from low to high
    };
    std::vector<Side> sides;
    sides.reserve(3 * triangles.size());
    for (Index t = 0; t < triangles.size(); ++t)
        for (Index i = 0; i < 3; ++i) {
            const Index from = triangles[t][i], to = triangles[t][(i + 1) % 3];
            sides.push_back({std::min(from, to), std::max(from, to), 3 * t + i, from < to});
        }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return a.low != b.low ? a.low < b.low : a.high != b.high ? a.high < b.high : a.number < b.number;
    });
    std::vector<Index> partners(sides.size(), HalfEdges::none);
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t end = i + 1;
        while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high)
            ++end;
        if (end - i == 2 && sides[i].forward != sides[i + 1].forward) {
            partners[sides[i].number] = sides[i + 1].number;
            partners[sides[i + 1].number] = sides[i].number;
        }
        i = end;
    }
    return partners;
}

/// Points as OpenMesh can hold them: the triangles at each hang together by edges that just two of them have.
/// @return  corners in the new numbering, and how many points there are
std::pair<Triangles, Index> cut_into_fans(const Triangles& triangles, const std::vector<Index>& partners)
{
    std::vector<Index> parents(3 * triangles.size());
    std::iota(parents.begin(), parents.end(), Index{0});
    const auto root = [&](Index i) {
        while (parents[i] != i)
            i = parents[i] = parents[parents[i]];
        return i;
    };
    const auto join = [&](Index a, Index b) { parents[std::max(root(a), root(b))] = std::min(root(a), root(b)); };
    for (Index side = 0; side < partners.size(); ++side)
        if (partners[side] != HalfEdges::none) {
            join(side, HalfEdges::next(partners[side]));
            join(HalfEdges::next(side), partners[side]);
        }
    std::vector<Index> number(parents.size(), HalfEdges::none), used(parents.size(), 0);
    Triangles cut(triangles.size());
    Index count = 0;
    for (Index corner = 0; corner < parents.size(); ++corner) {
        const Index fan = root(corner);
        if (used[fan]++ % most_at_a_point == 0)
            number[fan] = count++;
        cut[corner / 3][corner % 3] = number[fan];
    }
    return {std::move(cut), count};
}

bool has_crowded_point(std::size_t points, const Triangles& triangles)
{
    std::vector<Index> counts(points, 0);
    for (const auto& triangle : triangles)
        for (const Index corner : triangle)
            if (++counts[corner] > most_at_a_point)
                return true;
    return false;
}

} // namespace

struct HalfEdges::Topology {
    OpenMesh::TriConnectivity mesh;
    std::vector<int> halfedge_of_side; ///< negative: its triangle could not be added
    std::vector<Index> side_of_halfedge;
    std::vector<Index> partners; ///< of a surface that was cut; empty: OpenMesh's neighbours are all there are

    /// @return false when a triangle was turned away, and `all` are needed
    bool add(std::size_t points, const Triangles& triangles, bool all);
    void note_sides(OpenMesh::FaceHandle face, Index triangle, VertexHandle first);
};

bool HalfEdges::Topology::add(std::size_t points, const Triangles& triangles, bool all)
{
    mesh.clear();
    mesh.reserve(points, triangles.size() * 3 / 2 + points / 2, triangles.size());
    for (std::size_t i = 0; i < points; ++i)
        mesh.new_vertex();
    halfedge_of_side.assign(3 * triangles.size(), -1);
    side_of_halfedge.clear();
    side_of_halfedge.reserve(3 * triangles.size() + points);
    for (Index t = 0; t < triangles.size(); ++t) {
        std::array<VertexHandle, 3> corners;
        for (std::size_t i = 0; i < 3; ++i)
            corners[i] = VertexHandle(static_cast<int>(triangles[t][i]));
        const auto face =
            can_add(mesh, corners) ? mesh.add_face(corners[0], corners[1], corners[2]) : OpenMesh::SmartFaceHandle{};
        if (face.is_valid())
            note_sides(face, t, corners[0]);
        else if (all)
            return false;
    }
    return true;
}

void HalfEdges::Topology::note_sides(OpenMesh::FaceHandle face, Index triangle, VertexHandle first)
{
    HalfedgeHandle halfedge = mesh.halfedge_handle(face);
    while (mesh.from_vertex_handle(halfedge) != first)
        halfedge = mesh.next_halfedge_handle(halfedge);
    side_of_halfedge.resize(mesh.n_halfedges(), none);
    for (Index i = 0; i < 3; ++i) {
        halfedge_of_side[3 * triangle + i] = halfedge.idx();
        side_of_halfedge[static_cast<std::size_t>(halfedge.idx())] = 3 * triangle + i;
        halfedge = mesh.next_halfedge_handle(halfedge);
    }
}

HalfEdges::HalfEdges(std::size_t points, const Triangles& triangles) : topology_(std::make_unique<Topology>())
{
    if (!has_crowded_point(points, triangles) && topology_->add(points, triangles, true))
        return;
    topology_->partners = partners_of(triangles);
    const auto [cut, count] = cut_into_fans(triangles, topology_->partners);
    topology_->add(count, cut, false);
}

HalfEdges::~HalfEdges() = default;
HalfEdges::HalfEdges(HalfEdges&&) noexcept = default;
HalfEdges& HalfEdges::operator=(HalfEdges&&) noexcept = default;

Index HalfEdges::beyond(Index side) const noexcept
{
    const int halfedge = topology_->halfedge_of_side[side];
    if (halfedge < 0)
        return none;
    const HalfedgeHandle other = topology_->mesh.opposite_halfedge_handle(HalfedgeHandle(halfedge));
    const Index found = topology_->side_of_halfedge[static_cast<std::size_t>(other.idx())];
    // Where more than two triangles share an edge, cut fans may still meet along it.
    return topology_->partners.empty() || topology_->partners[side] == found ? found : none;
}

} // namespace lightwell
