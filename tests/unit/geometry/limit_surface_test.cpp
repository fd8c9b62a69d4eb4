#include "engine/geometry/limit_surface.h"

#include "engine/base/errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <tuple>

namespace lightwell {
namespace {

constexpr double relative_rounding = 1e-12;

SubdivisionCage cube()
{
    SubdivisionCage cage;
    for (const double z : {-1., 1.})
        for (const double y : {-1., 1.})
            for (const double x : {-1., 1.})
                cage.points.push_back({x, y, z});
    cage.face_sizes.assign(6, 4);
    cage.corners = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
    return cage;
}

/// A flat net of n x n squares of 1 m in which the middle corners lie at the height z(x, y).
template <class Height>
SubdivisionCage net(std::uint32_t n, const Height& z)
{
    SubdivisionCage cage;
    for (std::uint32_t j = 0; j <= n; ++j)
        for (std::uint32_t i = 0; i <= n; ++i)
            cage.points.push_back({double(i), double(j), z(double(i), double(j))});
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t at = j * (n + 1) + i;
            for (const std::uint32_t corner : {at, at + 1, at + n + 2, at + n + 1})
                cage.corners.push_back(corner);
        }
    cage.face_sizes.assign(n * n, 4);
    return cage;
}

double farthest_along(const Mesh& mesh, const Vec3& direction)
{
    double farthest = -infinity;
    for (const Point& point : mesh.points)
        farthest = std::fmax(farthest, dot(point, direction));
    return farthest;
}

double area_of(const Mesh& mesh)
{
    double sum = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        const Point& a = mesh.points[mesh.triangles[i]];
        sum += 0.5 * length(cross(mesh.points[mesh.triangles[i + 1]] - a, mesh.points[mesh.triangles[i + 2]] - a));
    }
    return sum;
}

double volume_of(const Mesh& mesh)
{
    double sum = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3)
        sum += dot(mesh.points[mesh.triangles[i]],
                   cross(mesh.points[mesh.triangles[i + 1]], mesh.points[mesh.triangles[i + 2]])) /
               6;
    return sum;
}

/// Edges (by the bits of their ends) that are not walked exactly once in each direction.
std::size_t open_edges(const Mesh& mesh)
{
    using Corner = std::tuple<double, double, double>;
    const auto corner = [&](std::size_t i) {
        const Point& p = mesh.points[mesh.triangles[i]];
        return Corner{p.x, p.y, p.z};
    };
    std::map<std::pair<Corner, Corner>, int> walked;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k)
            ++walked[{corner(i + k), corner(i + (k + 1) % 3)}];
    std::size_t open = 0;
    for (const auto& [edge, count] : walked) {
        const auto back = walked.find({edge.second, edge.first});
        open += count != 1 || back == walked.end() || back->second != 1;
    }
    return open;
}

/// The limit of a corner of valence n is (n^2 V + 4 sum E + sum F) / (n (n + 5)) of the once refined cage (Halstead,
/// Kass, DeRose 1993), and the middle of a cage face is such a corner of the once refined cage.
TEST(LimitSurface, TheSmoothCubeHasTheKnownMiddlesAndCorners)
{
    const LimitSurface smooth = limit_surface(cube(), 1e-4, "test");
    EXPECT_TRUE(smooth.reached_tolerance);
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}})
        EXPECT_NEAR(farthest_along(smooth.mesh, axis), 0.8395061728395061, 1e-4);
    const Direction diagonal = normalized(Vec3{1, 1, 1});
    // Once refined: V = 5/9, E = (0.75, 0.75, 0) and its turns, F = (1, 0, 0) and its turns: 1/24 (9 V + 4 * 1.5 + 1).
    EXPECT_NEAR(farthest_along(smooth.mesh, diagonal), std::sqrt(3.) * (9 * 5. / 9 + 4 * 1.5 + 1) / 24, 1e-4);
    EXPECT_EQ(open_edges(smooth.mesh), 0u);
}

TEST(LimitSurface, EveryTriangleOfAFlatCageLiesInItsPlaneAndKeepsItsArea)
{
    SubdivisionCage flat = net(4, [](double, double) { return 2.5; });
    flat.keep_boundary_corners = true;
    const LimitSurface surface = limit_surface(flat, 1e-3, "test");
    EXPECT_NEAR(area_of(surface.mesh), 16, relative_rounding * 16);
    for (const Point& point : surface.mesh.points)
        EXPECT_NEAR(point.z, 2.5, relative_rounding);
    for (const Direction& normal : surface.mesh.normals)
        EXPECT_NEAR(normal.z, 1, relative_rounding);
    EXPECT_EQ(surface.mesh.triangles.size(), 3u * 4 * 16); // nothing bends: no edge is halved
}

/// A uniform cubic B-spline with control heights k^2 is the parabola x^2 + 1/3.
TEST(LimitSurface, ANetOnAParabolaTendsToTheParabolaOfTheSpline)
{
    const SubdivisionCage trough = net(8, [](double x, double) { return x * x; });
    for (const double tolerance_m : {1e-1, 1e-2, 1e-3}) {
        SCOPED_TRACE(tolerance_m);
        const LimitSurface surface = limit_surface(trough, tolerance_m, "test");
        EXPECT_LE(surface.largest_deviation_m, tolerance_m);
        for (std::size_t i = 0; i < surface.mesh.points.size(); ++i) {
            const Point& p = surface.mesh.points[i];
            if (p.x < 1 || p.x > 7 || p.y < 1 || p.y > 7)
                continue; // the rim follows other rules
            EXPECT_NEAR(p.z, p.x * p.x + 1. / 3, 1e-12);
            const Direction truth = normalized(Vec3{-2 * p.x, 0, 1});
            EXPECT_NEAR(dot(surface.mesh.normals[i], truth), 1, 1e-12);
        }
    }
}

TEST(LimitSurface, ATighterToleranceIsKeptAndCostsTrianglesOnlyWhereTheSurfaceBends)
{
    const SubdivisionCage trough = net(8, [](double x, double) { return x < 4 ? 0. : (x - 4) * (x - 4); });
    std::size_t flat = 0, bent = 0;
    const LimitSurface surface = limit_surface(trough, 1e-3, "test");
    for (std::size_t i = 0; i < surface.mesh.triangles.size(); i += 3) {
        const double x = surface.mesh.points[surface.mesh.triangles[i]].x;
        flat += x < 2.5;
        bent += x > 5.5;
    }
    EXPECT_GT(bent, 8 * flat);
}

TEST(LimitSurface, FullCreasesKeepTheCubeWithSixNormalsAtSharpCorners)
{
    SubdivisionCage sharp = cube();
    for (std::size_t face = 0; face < 6; ++face)
        for (std::size_t i = 0; i < 4; ++i)
            sharp.creases.push_back({sharp.corners[4 * face + i], sharp.corners[4 * face + (i + 1) % 4], fully_sharp});
    const LimitSurface surface = limit_surface(sharp, 1e-3, "test");
    EXPECT_NEAR(area_of(surface.mesh), 24, 24 * relative_rounding);
    EXPECT_NEAR(volume_of(surface.mesh), 8, 8 * relative_rounding);
    EXPECT_EQ(surface.mesh.points.size(), 6u * 5); // four corners and the middle of each face, not shared
    EXPECT_EQ(open_edges(surface.mesh), 0u);
}

/// A creased rim is the closed cubic B-spline of its cage: for a square of half side 1 its corners come to 2/3 of the
/// cage's and the middles of its edges to (23 + 23 - 1 - 1)/48 = 11/12.
TEST(LimitSurface, ACreasedRimOfTheCubeFollowsItsSpline)
{
    SubdivisionCage cup = cube();
    for (const auto& [from, to] : {std::pair{4u, 5u}, {5u, 7u}, {7u, 6u}, {6u, 4u}})
        cup.creases.push_back({from, to, fully_sharp});
    const LimitSurface surface = limit_surface(cup, 1e-4, "test");
    double rim = 0;
    for (const Point& point : surface.mesh.points)
        if (point.z > 1 - 1e-9)
            rim = std::fmax(rim, point.x);
    EXPECT_NEAR(rim, 11. / 12, 1e-6);
    EXPECT_NEAR(farthest_along(surface.mesh, {0, 0, 1}), 1, relative_rounding);
    EXPECT_EQ(open_edges(surface.mesh), 0u);
}

TEST(LimitSurface, SemiSharpCreasesLieBetweenSmoothAndSharpWithoutCracks)
{
    double volume = 0;
    for (const double sharpness : {0., 0.5, 1., 2.5, 4., 10.}) {
        SCOPED_TRACE(sharpness);
        SubdivisionCage cage = cube();
        for (std::size_t face = 0; face < 6; ++face)
            for (std::size_t i = 0; i < 4; ++i)
                cage.creases.push_back({cage.corners[4 * face + i], cage.corners[4 * face + (i + 1) % 4], sharpness});
        const LimitSurface surface = limit_surface(cage, 1e-3, "test");
        EXPECT_EQ(open_edges(surface.mesh), 0u);
        EXPECT_GT(volume_of(surface.mesh), volume);
        volume = volume_of(surface.mesh);
        EXPECT_LT(surface.mesh.triangles.size(), 3u * 60000);
    }
}

TEST(LimitSurface, FacesOfThreeAndFiveCornersMeetQuadsWithoutCracks)
{
    SubdivisionCage house; // a prism with a ridge: two pentagons, the floor, two walls, a roof of four triangles
    house.points = {{0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {2, 0, 5}, {0, 0, 3},
                    {0, 6, 0}, {4, 6, 0}, {4, 6, 3}, {2, 6, 5}, {0, 6, 3}};
    house.face_sizes = {5, 5, 4, 4, 4, 3, 3, 3, 3};
    house.corners = {0, 1, 2, 3, 4, 9, 8, 7, 6, 5, 0, 5, 6, 1, 1, 6, 7,
                     2, 5, 0, 4, 9, 2, 7, 8, 2, 8, 3, 3, 8, 9, 3, 9, 4};
    for (const double tolerance_m : {0.3, 0.01, 0.001}) {
        SCOPED_TRACE(tolerance_m);
        const LimitSurface surface = limit_surface(house, tolerance_m, "test");
        EXPECT_EQ(open_edges(surface.mesh), 0u);
        EXPECT_GT(volume_of(surface.mesh), 30);
        EXPECT_LT(volume_of(surface.mesh), 4 * 6 * 4);
    }
}

TEST(LimitSurface, APillowOfTwoFacesOnTheSameCornersHasTwoSides)
{
    SubdivisionCage pillow;
    pillow.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    pillow.face_sizes = {4, 4};
    pillow.corners = {0, 1, 2, 3, 3, 2, 1, 0};
    const LimitSurface surface = limit_surface(pillow, 1e-3, "test");
    double up = 0, down = 0;
    for (std::size_t i = 0; i < surface.mesh.triangles.size(); i += 3) {
        const Point& a = surface.mesh.points[surface.mesh.triangles[i]];
        const double z = cross(surface.mesh.points[surface.mesh.triangles[i + 1]] - a,
                               surface.mesh.points[surface.mesh.triangles[i + 2]] - a)
                             .z;
        (z > 0 ? up : down) += z;
    }
    EXPECT_GT(up, 0.01);
    EXPECT_NEAR(up, -down, relative_rounding);
}

TEST(LimitSurface, HolesAreLeftOutAndCollapsedFacesAreCounted)
{
    SubdivisionCage cage = net(3, [](double, double) { return 0.; });
    cage.keep_boundary_corners = true;
    cage.holes = {4};
    EXPECT_NEAR(area_of(limit_surface(cage, 1e-3, "test").mesh), 8, 8 * relative_rounding);
    cage.face_sizes.push_back(3);
    cage.corners.insert(cage.corners.end(), {0, 0, 1});
    cage.creases.push_back({0, 15, 2});
    const LimitSurface surface = limit_surface(cage, 1e-3, "test");
    EXPECT_EQ(surface.faces_left_out, 1u);
    EXPECT_EQ(surface.creases_left_out, 1u);
    EXPECT_NEAR(area_of(surface.mesh), 8, 8 * relative_rounding);
}

TEST(LimitSurface, FarFromTheOriginTheSurfaceKeepsItsShape)
{
    SubdivisionCage far = cube();
    for (Point& point : far.points)
        point += Vec3{1e7, -1e7, 0};
    const LimitSurface here = limit_surface(cube(), 1e-3, "test"), there = limit_surface(far, 1e-3, "test");
    EXPECT_EQ(here.mesh.triangles.size(), there.mesh.triangles.size());
    EXPECT_NEAR(area_of(there.mesh), area_of(here.mesh), 1e-6);
    EXPECT_EQ(open_edges(there.mesh), 0u);
}

std::string refusal(const SubdivisionCage& cage, double tolerance_m = 1e-3)
{
    try {
        limit_surface(cage, tolerance_m, "house.dxf:12: MESH 2F");
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

TEST(LimitSurface, DamagedCagesAreRefusedWithTheirPlaceAndValue)
{
    SubdivisionCage cage = cube();
    cage.corners[3] = 8;
    EXPECT_EQ(refusal(cage),
              "house.dxf:12: MESH 2F: a face names point 8 of 8; the subdivision cage is damaged; export it again");
    cage = cube();
    cage.face_sizes[0] = 2;
    EXPECT_NE(refusal(cage).find("a face of the cage has 2 corners, expected 3 to"), std::string::npos);
    cage = cube();
    cage.face_sizes.push_back(4000);
    EXPECT_NE(refusal(cage).find("4024 corners together, but 24 are listed"), std::string::npos);
    cage = cube();
    cage.points[5].y = std::nan("");
    EXPECT_NE(refusal(cage).find("point 6 of the cage is not finite"), std::string::npos);
    cage = cube();
    cage.creases.push_back({0, 1, -1});
    EXPECT_NE(refusal(cage).find("sharpness is -1, expected >= 0"), std::string::npos);
    EXPECT_NE(refusal(cube(), 0).find("chord tolerance is 0 m, expected > 0"), std::string::npos);
    EXPECT_NE(refusal(cube(), std::nan("")).find("chord tolerance"), std::string::npos);
}

/// Random faces on a few points are full of edges with many faces, faces on top of each other and bow ties.
TEST(LimitSurface, RandomTangledCagesEndWithFiniteTrianglesOrARefusal)
{
    std::mt19937 random(7);
    const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
    for (int round = 0; round < 300; ++round) {
        SCOPED_TRACE(round);
        SubdivisionCage cage;
        const std::uint32_t points = 3 + below(8);
        for (std::uint32_t i = 0; i < points; ++i)
            cage.points.push_back({double(below(4)), double(below(4)), double(below(4))});
        for (std::uint32_t face = 0; face < 1 + below(9); ++face) {
            cage.face_sizes.push_back(3 + below(4));
            for (std::uint32_t i = 0; i < cage.face_sizes.back(); ++i)
                cage.corners.push_back(below(points));
        }
        for (std::uint32_t i = below(4); i > 0; --i)
            cage.creases.push_back({below(points), below(points), double(below(12))});
        for (std::uint32_t i = below(3); i > 0; --i)
            cage.tips.push_back({below(points), double(below(12))});
        if (refusal(cage) != "accepted")
            continue;
        const LimitSurface surface = limit_surface(cage, 0.05, "test");
        for (const Point& point : surface.mesh.points)
            EXPECT_LT(max_abs(point), 4.01);
        for (const Direction& normal : surface.mesh.normals)
            EXPECT_NEAR(length(normal), 1, 1e-9);
    }
}

} // namespace
} // namespace lightwell
