#include "engine/geometry/half_edges.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;
constexpr auto none = HalfEdges::none;

/// What lies beyond each side of a small surface, counted by hand.
std::vector<std::uint32_t> all_beyond(std::size_t points, const Triangles& triangles)
{
    const HalfEdges edges(points, triangles);
    std::vector<std::uint32_t> beyond;
    for (std::uint32_t side = 0; side < 3 * triangles.size(); ++side)
        beyond.push_back(edges.beyond(side));
    return beyond;
}

TEST(HalfEdges, TwoTrianglesOfOneQuadMeetAlongTheDiagonal)
{
    EXPECT_EQ(all_beyond(4, {{0, 1, 2}, {0, 2, 3}}), (std::vector<std::uint32_t>{none, none, 3, 2, none, none}));
}

TEST(HalfEdges, ThreeTrianglesOnOneEdgeAreNoNeighboursThere)
{
    // The edge 0-1 has three triangles; the first has one neighbour more, across 1-2.
    const auto beyond = all_beyond(6, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {2, 1, 5}});
    EXPECT_EQ(beyond[0], none);
    EXPECT_EQ(beyond[3], none);
    EXPECT_EQ(beyond[6], none);
    EXPECT_EQ(beyond[1], 9U);
    EXPECT_EQ(beyond[9], 1U);
}

TEST(HalfEdges, SidesThatRunTheSameWayDoNotMeet)
{
    for (const std::uint32_t side : all_beyond(4, {{0, 1, 2}, {0, 1, 3}}))
        EXPECT_EQ(side, none);
}

TEST(HalfEdges, ClosedBodiesThatTouchWithTheirTipsStayWhole)
{
    // Two tetrahedra that share point 0: six edges each, every side has a neighbour of its own body.
    const Triangles both{{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}, {0, 5, 4}, {0, 6, 5}, {0, 4, 6}, {4, 5, 6}};
    const auto beyond = all_beyond(7, both);
    for (std::uint32_t side = 0; side < beyond.size(); ++side) {
        ASSERT_NE(beyond[side], none) << side;
        EXPECT_EQ(beyond[beyond[side]], side);
        EXPECT_EQ(side < 12, beyond[side] < 12);
    }
}

TEST(HalfEdges, DegenerateAndRepeatedTrianglesDoNoHarm)
{
    const auto beyond = all_beyond(4, {{0, 0, 1}, {2, 2, 2}, {0, 1, 2}, {0, 1, 2}, {2, 1, 3}});
    for (std::uint32_t side = 0; side < 6; ++side)
        EXPECT_EQ(beyond[side], none);
    EXPECT_TRUE(all_beyond(0, {}).empty());
}

TEST(HalfEdges, AFanOfHundredThousandTrianglesTakesNoSquareOfTheirNumber)
{
    Triangles fan;
    constexpr std::uint32_t count = 100'000;
    for (std::uint32_t i = 0; i < count; ++i)
        fan.push_back({0, 1 + i, 2 + i});
    const HalfEdges edges(count + 2, fan);
    std::size_t joined = 0;
    for (std::uint32_t i = 0; i < count; ++i)
        joined += edges.beyond(3 * i + 2) != none ? 1 : 0;
    EXPECT_GT(joined, count - 10);
}

} // namespace
} // namespace lightwell
