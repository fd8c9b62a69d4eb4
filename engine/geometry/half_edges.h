#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace lightwell {

/// Which triangles meet along which edges, held by OpenMesh. Sides are numbered 3 * triangle + the corner at which they
/// begin.
///
/// Two triangles are neighbours across an edge when they are the only ones that have it and run along it in opposite
/// directions. Anything may be handed over: triangles that name a corner twice have no neighbours, and where OpenMesh
/// could not hold the surface it is cut into fans of neighbours first.
class HalfEdges {
public:
    using Index = std::uint32_t;
    static constexpr Index none = std::numeric_limits<Index>::max();

    /// @param points  how many there are; all corners are below
    HalfEdges(std::size_t points, const std::vector<std::array<Index, 3>>& triangles);
    ~HalfEdges();
    HalfEdges(HalfEdges&&) noexcept;
    HalfEdges& operator=(HalfEdges&&) noexcept;

    /// The neighbour's side of the same edge; none at a border.
    Index beyond(Index side) const noexcept;
    /// The side that follows in the same triangle.
    static Index next(Index side) noexcept { return side % 3 == 2 ? side - 2 : side + 1; }

private:
    struct Topology;
    std::unique_ptr<Topology> topology_;
};

} // namespace lightwell
