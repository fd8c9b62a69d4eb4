#include "engine/geometry/triangulate.h"

#include "engine/base/transform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>

namespace lightwell {
namespace {

using Outline = std::vector<Point>;
constexpr double relative_rounding = 1e-12;

/// Sum of the triangles' areas, each counted positive: larger than the outline's when triangles overlap.
double covered_area(const Outline& outline)
{
    double sum = 0;
    for (const auto& [a, b, c] : triangulate(outline.data(), outline.size()))
        sum += 0.5 * length(cross(outline[b] - outline[a], outline[c] - outline[a]));
    return sum;
}

/// The least z of the triangles' area vectors: negative when one shows its back.
double least_front(const Outline& outline)
{
    double least = 1;
    for (const auto& [a, b, c] : triangulate(outline.data(), outline.size()))
        least = std::fmin(least, cross(outline[b] - outline[a], outline[c] - outline[a]).z);
    return least;
}

/// A comb of teeth 1 m wide and 9 m long on a bar 1 m high, with gaps of 1 m.
Outline comb(int teeth)
{
    Outline outline{{0, 0, 0}, {2. * teeth - 1, 0, 0}};
    for (int tooth = teeth - 1; tooth >= 0; --tooth) {
        outline.push_back({2. * tooth + 1, 10, 0});
        outline.push_back({2. * tooth, 10, 0});
        if (tooth > 0) {
            outline.push_back({2. * tooth, 1, 0});
            outline.push_back({2. * tooth - 1, 1, 0});
        }
    }
    return outline;
}

TEST(Triangulate, ConcaveOutlinesAreCoveredOnceWithTheFrontKept)
{
    const Outline arrow{{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {1, 1, 0}};
    EXPECT_NEAR(covered_area(arrow), 1, relative_rounding);
    EXPECT_GT(least_front(arrow), 0);
    for (int teeth : {2, 5, 60}) {
        SCOPED_TRACE(teeth);
        const double area = 9. * teeth + (2. * teeth - 1);
        EXPECT_NEAR(covered_area(comb(teeth)), area, relative_rounding * area);
        EXPECT_GT(least_front(comb(teeth)), 0);
    }
}

Outline regular(int corners)
{
    Outline outline;
    for (int i = 0; i < corners; ++i)
        outline.push_back({std::cos(2 * pi * i / corners), std::sin(2 * pi * i / corners), 0});
    return outline;
}

/// Asking every corner about every ear takes 20 s and more for each of the two.
TEST(Triangulate, AHundredThousandCornersTakeSeconds)
{
    constexpr int teeth = 25000, corners = 100000;
    constexpr double most_seconds = 10, rounding_of_the_sum = 1e-9;
    const std::clock_t begin = std::clock();
    EXPECT_NEAR(covered_area(comb(teeth)) / (11. * teeth - 1), 1, rounding_of_the_sum);
    EXPECT_NEAR(covered_area(regular(corners)) / (0.5 * corners * std::sin(2 * pi / corners)), 1, rounding_of_the_sum);
    const Outline round = regular(corners);
    Outline star; // of as many points, which crosses itself everywhere
    for (std::size_t i = 0; i < round.size(); ++i)
        star.push_back(round[i * 49999 % round.size()]);
    EXPECT_GT(covered_area(star), 0);
    EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, most_seconds);
}

TEST(Triangulate, AFrameWithASeamLeavesItsHoleOpen)
{
    const Outline frame{{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}, {0, 0, 0},
                        {1, 1, 0}, {1, 2, 0}, {3, 2, 0}, {3, 1, 0}, {1, 1, 0}};
    EXPECT_NEAR(covered_area(frame), 12 - 2, relative_rounding * 12);
    EXPECT_GT(least_front(frame), 0);
}

TEST(Triangulate, AreaIsKeptFarFromTheOriginAndInAnyPosition)
{
    const Affine tilt =
        compose(Affine::translate({1e6, -1e6, 300}), compose(Affine::rotate(0, 1.1), Affine::rotate(2, 0.4)));
    Outline outline = comb(5);
    for (Point& corner : outline)
        corner = tilt.point(corner);
    EXPECT_NEAR(covered_area(outline), 54, 54 * 1e-8); // corners at 1e6 m carry 1e-10 m of rounding each
}

TEST(Triangulate, CornersOnAStraightEdgeAddNoArea)
{
    const Outline outline{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {0, 2, 0}};
    EXPECT_NEAR(covered_area(outline), 4, relative_rounding * 4);
}

TEST(Triangulate, AnOutlineThatCrossesItselfEndsWithCornersOfItsOwn)
{
    const Outline star{{0, 3, 0}, {2, -3, 0}, {-3, 1, 0}, {3, 1, 0}, {-2, -3, 0}};
    const auto triangles = triangulate(star.data(), star.size());
    EXPECT_LE(triangles.size(), 3u);
    for (const auto& triangle : triangles)
        for (const std::uint32_t corner : triangle)
            EXPECT_LT(corner, star.size());
}

} // namespace
} // namespace lightwell
