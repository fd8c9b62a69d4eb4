#include "engine/geometry/crease_normals.h"
#include "engine/geometry/merge_coplanar.h"

#include "engine/base/transform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <tuple>

namespace lightwell {
namespace {

/// Points shared by their coordinates, as a file that repeats corners is read.
class SoupMaker {
public:
    void triangle(const Point& a, const Point& b, const Point& c)
    {
        soup.triangles.push_back({number(a), number(b), number(c)});
        soup.groups.push_back(group);
        soup.kept_points.resize(soup.points.size(), false);
    }
    /// n x m cells of two triangles each on the parallelogram of two edges, without those that `open` says.
    void grid(
        const Point& from, const Vec3& along, const Vec3& up, int n, int m,
        const std::function<bool(int, int)>& open = [](int, int) { return false; })
    {
        const auto at = [&](int i, int j) { return from + along * (double(i) / n) + up * (double(j) / m); };
        for (int j = 0; j < m; ++j)
            for (int i = 0; i < n; ++i)
                if (!open(i, j)) {
                    triangle(at(i, j), at(i + 1, j), at(i + 1, j + 1));
                    triangle(at(i, j), at(i + 1, j + 1), at(i, j + 1));
                }
    }
    std::uint32_t number(const Point& p)
    {
        // The same corner of two faces is computed two ways: to 1e-9 m it is the same.
        const auto key = std::tuple{std::llround(p.x * 1e9), std::llround(p.y * 1e9), std::llround(p.z * 1e9)};
        const auto [entry, fresh] = known_.try_emplace(key, static_cast<std::uint32_t>(soup.points.size()));
        if (fresh)
            soup.points.push_back(p);
        return entry->second;
    }
    TriangleSoup soup;
    std::uint32_t group = 0;

private:
    std::map<std::tuple<long long, long long, long long>, std::uint32_t> known_;
};

/// A wall of 5.7 x 0.3 x 4.5 m with a window of 2.4 x 1.2 m, all in cells of 0.3 m: 1196 triangles.
TriangleSoup wall_with_window()
{
    SoupMaker wall;
    const auto window = [](int i, int j) { return i >= 5 && i < 13 && j >= 4 && j < 8; };
    const auto mirrored = [&](int i, int j) { return window(18 - i, j); };
    wall.grid({0, 0, 0}, {5.7, 0, 0}, {0, 0, 4.5}, 19, 15, window);
    wall.grid({5.7, 0.3, 0}, {-5.7, 0, 0}, {0, 0, 4.5}, 19, 15, mirrored);
    wall.grid({5.7, 0, 0}, {0, 0.3, 0}, {0, 0, 4.5}, 1, 15);
    wall.grid({0, 0.3, 0}, {0, -0.3, 0}, {0, 0, 4.5}, 1, 15);
    wall.grid({0, 0, 4.5}, {5.7, 0, 0}, {0, 0.3, 0}, 19, 1);
    wall.grid({0, 0.3, 0}, {5.7, 0, 0}, {0, -0.3, 0}, 19, 1);
    wall.grid({1.5, 0, 1.2}, {2.4, 0, 0}, {0, 0.3, 0}, 8, 1);
    wall.grid({1.5, 0.3, 2.4}, {2.4, 0, 0}, {0, -0.3, 0}, 8, 1);
    wall.grid({1.5, 0, 1.2}, {0, 0.3, 0}, {0, 0, 1.2}, 1, 4);
    wall.grid({3.9, 0.3, 1.2}, {0, -0.3, 0}, {0, 0, 1.2}, 1, 4);
    return wall.soup;
}

double area_of(const TriangleSoup& soup, const std::vector<std::uint32_t>& loop)
{
    Vec3 twice;
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
        twice += cross(soup.points[loop[i]] - soup.points[loop[0]], soup.points[loop[i + 1]] - soup.points[loop[0]]);
    return 0.5 * length(twice);
}

TEST(MergeCoplanar, AWallWithAWindowOf1196TrianglesBecomesTenPolygons)
{
    for (const Affine& map : {Affine{}, compose(Affine::translate({120, -40, 7}),
                                                compose(Affine::rotate(0, 0.7), Affine::rotate(2, 1.9)))}) {
        TriangleSoup soup = wall_with_window();
        ASSERT_EQ(soup.triangles.size(), 1196u);
        for (Point& point : soup.points)
            point = map.point(point);
        const std::vector<FlatFace> faces = merge_coplanar(soup);
        ASSERT_EQ(faces.size(), 10u);
        double area = 0;
        std::size_t holes = 0, triangles = 0;
        for (const FlatFace& face : faces) {
            EXPECT_EQ(face.outline.size(), 4u);
            area += area_of(soup, face.outline);
            for (const auto& hole : face.holes) {
                EXPECT_EQ(hole.size(), 4u);
                area -= area_of(soup, hole);
                ++holes;
            }
            triangles += face.triangles.size();
        }
        EXPECT_EQ(holes, 2u);
        EXPECT_EQ(triangles, 1196u);
        const double expected = 2 * (5.7 * 4.5 - 2.4 * 1.2) + 0.3 * 2 * (5.7 + 4.5) + 0.3 * 2 * (2.4 + 1.2);
        EXPECT_NEAR(area, expected, 1e-9 * expected);
    }
}

TEST(MergeCoplanar, InSinglePrecisionTheWallIsStillTenPolygons)
{
    TriangleSoup soup = wall_with_window();
    for (Point& point : soup.points)
        for (int axis = 0; axis < 3; ++axis)
            point[axis] = static_cast<float>(point[axis]);
    EXPECT_EQ(merge_coplanar(soup).size(), 10u);
}

TEST(MergeCoplanar, GroupsBendsAndOppositeSidesStayApart)
{
    SoupMaker two_groups;
    two_groups.grid({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, 1);
    two_groups.group = 1;
    two_groups.grid({1, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, 1);
    EXPECT_EQ(merge_coplanar(two_groups.soup).size(), 2u);

    for (const double rise : {0.0, 1e-7, 1e-3}) {
        SCOPED_TRACE(rise);
        SoupMaker roof;
        roof.grid({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, 1);
        roof.grid({1, 0, 0}, {1, 0, rise}, {0, 1, 0}, 1, 1);
        EXPECT_EQ(merge_coplanar(roof.soup).size(), rise < 1e-5 ? 1u : 2u);
    }

    SoupMaker inside_out;
    inside_out.triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    inside_out.triangle({1, 0, 0}, {0, 1, 0}, {1, 1, 0}); // its front looks down
    EXPECT_TRUE(merge_coplanar(inside_out.soup).empty());

    SoupMaker three_on_an_edge;
    three_on_an_edge.triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    three_on_an_edge.triangle({1, 0, 0}, {0, 0, 0}, {0, -1, 0});
    three_on_an_edge.triangle({1, 0, 0}, {0, 0, 0}, {0, 0, 1});
    EXPECT_TRUE(merge_coplanar(three_on_an_edge.soup).empty());
}

/// Else a ray could slip between the long edge and the two short ones.
TEST(MergeCoplanar, ACornerThatANeighbourNeedsStays)
{
    SoupMaker floor;
    floor.grid({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, 2, 1);
    ASSERT_EQ(merge_coplanar(floor.soup).size(), 1u);
    EXPECT_EQ(merge_coplanar(floor.soup)[0].outline.size(), 4u);
    floor.soup.kept_points[floor.number({1, 0, 0})] = true;
    EXPECT_EQ(merge_coplanar(floor.soup)[0].outline.size(), 5u);
    floor.triangle({1, 1, 0}, {2, 1, 0}, {1.5, 1, 1}); // a single triangle that stands on half of the far edge
    EXPECT_EQ(merge_coplanar(floor.soup)[0].outline.size(), 6u);
}

TEST(MergeCoplanar, ARingOfManySidesKeepsItsCorners)
{
    SoupMaker disc;
    constexpr int sides = 3000; // a corner is off the line of its neighbours by 1e-3 of their distance
    const auto at = [](int i) { return Point{std::cos(2 * pi * i / sides), std::sin(2 * pi * i / sides), 0}; };
    for (int i = 0; i < sides; ++i)
        disc.triangle({0, 0, 0}, at(i), at((i + 1) % sides));
    const auto faces = merge_coplanar(disc.soup);
    ASSERT_EQ(faces.size(), 1u);
    EXPECT_EQ(faces[0].outline.size(), std::size_t{sides});
    EXPECT_TRUE(faces[0].holes.empty());
}

TEST(MergeCoplanar, AHoleThatTouchesTheOutlineAtACornerKeepsTheArea)
{
    SoupMaker plate;
    plate.grid({0, 0, 0}, {3, 0, 0}, {0, 3, 0}, 3, 3, [](int i, int j) { return i == j && i < 2; });
    const auto faces = merge_coplanar(plate.soup);
    double area = 0;
    for (const FlatFace& face : faces) {
        area += area_of(plate.soup, face.outline);
        for (const auto& hole : face.holes)
            area -= area_of(plate.soup, hole);
    }
    EXPECT_NEAR(area, 7, 1e-12);
}

TEST(MergeCoplanar, OverlappingTrianglesAreLeftAsTheyAre)
{
    SoupMaker spiral; // a fan that winds twice around its middle
    for (int i = 0; i < 10; ++i) {
        const double a = 4 * pi * i / 10, b = 4 * pi * (i + 1) / 10, r = 1 + 0.1 * i, s = 1 + 0.1 * (i + 1);
        spiral.triangle({0, 0, 0}, {r * std::cos(a), r * std::sin(a), 0}, {s * std::cos(b), s * std::sin(b), 0});
    }
    double area = 0;
    std::size_t joined = 0;
    for (const FlatFace& face : merge_coplanar(spiral.soup)) {
        area += area_of(spiral.soup, face.outline);
        joined += face.triangles.size();
    }
    double triangles = 0;
    for (const FlatFace& face : merge_coplanar(spiral.soup))
        for (const std::uint32_t t : face.triangles)
            triangles += area_of(
                spiral.soup, {spiral.soup.triangles[t][0], spiral.soup.triangles[t][1], spiral.soup.triangles[t][2]});
    EXPECT_NEAR(area, triangles, 1e-6);
    EXPECT_LE(joined, 10u);
}

/// A prism of n sides: its mantle is round below the crease angle, its ends stay flat.
Mesh prism(int sides)
{
    Mesh mesh;
    const auto add = [&](const Point& p) {
        mesh.points.push_back(p);
        mesh.triangles.push_back(static_cast<std::uint32_t>(mesh.points.size() - 1));
    };
    const auto at = [&](int i, double z) {
        return Point{std::cos(2 * pi * (i % sides) / sides), std::sin(2 * pi * (i % sides) / sides), z};
    };
    for (int i = 0; i < sides; ++i) {
        for (const Point& p : {at(i, 0), at(i + 1, 0), at(i + 1, 1), at(i, 0), at(i + 1, 1), at(i, 1)})
            add(p);
        for (const Point& p : {Point{0, 0, 1}, at(i, 1), at(i + 1, 1)})
            add(p);
    }
    return mesh;
}

TEST(CreaseNormals, AMantleIsRoundBelowTheAngleAndFacettedAboveIt)
{
    const Mesh round = crease_normals(prism(24), 20); // 15 degrees from side to side
    for (std::size_t i = 0; i < round.triangles.size(); ++i) {
        const Point& p = round.points[round.triangles[i]];
        const Direction& n = round.normals[round.triangles[i]];
        const bool top = i % 9 >= 6;
        const Direction truth = top ? Direction{0, 0, 1} : Direction{p.x, p.y, 0};
        EXPECT_NEAR(dot(n, truth), 1, 1e-9);
    }
    const Mesh sharp = crease_normals(prism(24), 10);
    for (std::size_t i = 0; i < sharp.triangles.size(); ++i) {
        const std::size_t first = i / 3 * 3;
        const Point& a = sharp.points[sharp.triangles[first]];
        const Direction front = normalized(
            cross(sharp.points[sharp.triangles[first + 1]] - a, sharp.points[sharp.triangles[first + 2]] - a));
        EXPECT_NEAR(dot(sharp.normals[sharp.triangles[i]], front), 1, 1e-12);
    }
}

} // namespace
} // namespace lightwell
