#include "engine/sampling/warps.h"

#include "engine/base/random.h"
#include "engine/sampling/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

using namespace lightwell;

namespace {

constexpr int many = 40000;

/// Mean of f(direction) / density over samples, which estimates the integral of f over the sampled solid angle.
template <class Draw, class Function>
Estimate integral(Draw draw, Function f, std::uint64_t seed = 7)
{
    RunningStatistics statistics;
    RandomStream random(seed);
    for (int i = 0; i < many; ++i) {
        const SampledDirection s = draw(random.square());
        statistics.add(s.density_per_sr > 0 ? f(s.direction) / s.density_per_sr : 0);
    }
    return estimate_of(statistics);
}

double one(const Direction&)
{
    return 1;
}

double cosine(const Direction& d)
{
    return std::max(0.0, d.z);
}

/// Irradiance factor of a polygon above the plane z = 0.  Source  Lambert 1760
double lambert(const std::vector<Point>& polygon)
{
    double sum = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()], c = cross(a, b);
        sum += std::atan2(length(c), dot(a, b)) * c.z / length(c);
    }
    return std::fabs(sum) / 2;
}

} // namespace

TEST(Warps, TheDiscIsFilledEvenly)
{
    // 8 rings of equal area, 8 sectors.
    std::vector<double> found(64), expected(64, many / 64.0);
    RandomStream random(1);
    for (int i = 0; i < many; ++i) {
        const DiscPoint p = uniform_disc(random.square());
        const double r2 = p.x * p.x + p.y * p.y;
        ASSERT_LE(r2, 1 + 1e-15);
        const int sector = static_cast<int>((std::atan2(p.y, p.x) / (2 * pi) + 0.5) * 8) % 8;
        ++found[std::min(7, static_cast<int>(r2 * 8)) * 8 + sector];
    }
    EXPECT_GT(chi_square_probability(found, expected), 1e-6);
}

TEST(Warps, TheHemisphereHasDensityCosOverPiAndADensityTwoPercentOffIsRejected)
{
    // The cumulative share within polar angle t is sin^2 t: 16 cells of equal share.
    constexpr int draws = 400000;
    std::vector<double> found(16), right(16, draws / 16.0), wrong(right);
    for (int i = 0; i < 16; ++i)
        wrong[i] *= i % 2 ? 1.02 : 0.98;
    RandomStream random(2);
    for (int i = 0; i < draws; ++i) {
        const Direction d = cosine_hemisphere(random.square());
        ++found[std::min(15, static_cast<int>((1 - d.z * d.z) * 16))];
        ASSERT_NEAR(length(d), 1, 1e-14);
    }
    EXPECT_GT(chi_square_probability(found, right), 1e-6);
    EXPECT_LT(chi_square_probability(found, wrong), 1e-6);
}

TEST(Warps, TheSolidAngleOfAConeKeepsItsDigitsFromTheWholeSphereToAPoint)
{
    EXPECT_DOUBLE_EQ(cone_solid_angle_sr(pi), 4 * pi);
    EXPECT_DOUBLE_EQ(cone_solid_angle_sr(pi / 2), 2 * pi);
    // pi a^2 (1 - a^2/12 + ...) for small angles.
    EXPECT_NEAR(cone_solid_angle_sr(1e-9) / (pi * 1e-18), 1, 1e-15);
    EXPECT_NEAR(cone_solid_angle_sr(1e-150) / (pi * 1e-300), 1, 1e-12);
}

TEST(Warps, AConeStaysInsideItsAngleAndGivesItsSolidAngle)
{
    const Direction axis = normalized({1, -2, 0.5});
    for (double half : {1e-7, 1e-3, 0.5, 2.0, pi}) {
        SCOPED_TRACE(half);
        RandomStream random(3);
        double widest = 0;
        for (int i = 0; i < 1000; ++i) {
            const SampledDirection s = uniform_cone(axis, half, random.square());
            EXPECT_NEAR(s.density_per_sr * cone_solid_angle_sr(half), 1, 1e-14);
            widest = std::max(widest, std::atan2(length(cross(axis, s.direction)), dot(axis, s.direction)));
        }
        EXPECT_LE(widest, half * (1 + 1e-6));
        EXPECT_GE(widest, half * 0.9); // of 1000 samples the outermost lies within 10 % but for chance 1e-10
    }
    EXPECT_EQ(uniform_cone(axis, 0, {0.5, 0.5}).density_per_sr, 0);
}

TEST(Warps, ASphereGivesItsIrradianceFromAnyDistance)
{
    // E = pi (R/D)^2 cos for a sphere of radiance 1 above the horizon, exactly.
    for (double distance : {1.0001, 1.5, 10.0, 1e4, 1e8}) {
        SCOPED_TRACE(distance);
        const Point centre{0, 0, distance};
        const auto draw = [&](UnitSquare u) { return sphere_seen_from({}, centre, 1, u); };
        const Estimate found = integral(draw, cosine);
        EXPECT_TRUE(agrees(found, pi / (distance * distance))) << found.value;
        EXPECT_LT(found.standard_error * distance * distance / pi, 0.005);
    }
    EXPECT_EQ(sphere_solid_angle_sr({}, {0, 0, 0.5}, 1), 4 * pi);
    EXPECT_EQ(sphere_seen_from({}, {0, 0, 0.5}, 1, {0.2, 0.7}).density_per_sr, 1 / (4 * pi));
    EXPECT_EQ(sphere_seen_from({}, {0, 0, 2}, 0, {0.2, 0.7}).density_per_sr, 0);
}

TEST(Warps, AnOctantHasHalfPiAndATinyFarTriangleItsAreaOverDistanceSquared)
{
    EXPECT_NEAR(triangle_solid_angle_sr({1, 0, 0}, {-1, 1, 0}, {-1, 0, 1}), pi / 2, 1e-14);
    // Area 5e-13, distance 1e4.
    EXPECT_NEAR(triangle_solid_angle_sr({0, 0, 1e4}, {1e-6, 0, 0}, {0, 1e-6, 0}) / 5e-21, 1, 1e-9);
    EXPECT_EQ(triangle_solid_angle_sr({0, 0, 1}, {1, 0, 0}, {2, 0, 0}), 0);
}

TEST(Warps, ATriangleBySolidAngleAgreesWithLambertFromNearToFar)
{
    for (double height : {1e-9, 1e-3, 0.1, 1.0, 30.0, 1e4}) {
        SCOPED_TRACE(height);
        const std::vector<Point> t{{-0.4, -0.7, height}, {1.3, -0.2, height}, {0.1, 0.9, height * 1.5}};
        const SphericalTriangle triangle({}, t[0], t[1], t[2]);
        const auto draw = [&](UnitSquare u) { return triangle.sample(u); };
        // In the plane of the triangle every sample hits and the estimate is 2 pi without scatter.
        const Estimate whole = integral(draw, one);
        EXPECT_TRUE(agrees(whole, triangle.solid_angle_sr()) ||
                    std::fabs(whole.value / triangle.solid_angle_sr() - 1) < 1e-7);
        const Estimate found = integral(draw, cosine);
        EXPECT_TRUE(agrees(found, lambert(t))) << found.value << " against " << lambert(t);
        EXPECT_LT(found.standard_error / found.value, 0.02 / 3);
    }
}

TEST(Warps, EverySampleOfATriangleLiesInItAndHasTheDensityThatIsAnswered)
{
    const Point from{0.3, 0.2, -1};
    for (double size : {1e-6, 1e-2, 1.0, 100.0}) {
        const Point a{0, 0, 0}, b{size, 0, 0}, c{0, size, 0};
        const SphericalTriangle triangle(from, a, b, c);
        RandomStream random(5);
        for (int i = 0; i < 1000; ++i) {
            const SampledDirection s = triangle.sample(random.square());
            ASSERT_GT(s.direction.z, 0);
            const Point hit = from + s.direction * (-from.z / s.direction.z);
            const double slack = 1e-9 * std::max(1.0, size);
            EXPECT_GE(hit.x, -slack);
            EXPECT_GE(hit.y, -slack);
            EXPECT_LE(hit.x + hit.y, size + slack);
            EXPECT_NEAR(triangle.density_per_sr(s.direction) / s.density_per_sr, 1, 1e-12);
        }
    }
}

TEST(Warps, ARectangleBySolidAngleAgreesWithLambertFromTouchingToFar)
{
    for (double height : {1e-9, 1e-4, 0.1, 1.0, 30.0, 1e4}) {
        SCOPED_TRACE(height);
        const Point corner{-0.4, -0.7, height};
        const Vec3 x{1.6, 0.4, 0}, y{-0.3, 1.2, 0};
        const SphericalRectangle rectangle({}, corner, x, y);
        const auto draw = [&](UnitSquare u) { return rectangle.sample(u); };
        const double expected = lambert({corner, corner + x, corner + x + y, corner + y});
        EXPECT_TRUE(agrees(integral(draw, one), rectangle.solid_angle_sr()));
        const Estimate found = integral(draw, cosine);
        EXPECT_TRUE(agrees(found, expected)) << found.value << " against " << expected;
        EXPECT_LT(found.standard_error / found.value, 0.02 / 3);
    }
}

TEST(Warps, AParallelogramIsSampledWithTheDensityItStates)
{
    const Point corner{-0.4, -0.7, 2};
    const Vec3 x{1.6, 0.4, 0}, y{0.9, 1.2, 0};
    const SphericalRectangle skewed({}, corner, x, y);
    const Estimate found = integral([&](UnitSquare u) { return skewed.sample(u); }, cosine);
    EXPECT_TRUE(agrees(found, lambert({corner, corner + x, corner + x + y, corner + y})));
}

TEST(Warps, WhatIsSeenEdgeOnOrHasNoAreaHasNothingToSample)
{
    EXPECT_EQ(SphericalRectangle({}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}).sample({0.3, 0.3}).density_per_sr, 0);
    EXPECT_EQ(SphericalRectangle({}, {1, 0, 1}, {0, 0, 0}, {0, 1, 0}).sample({0.3, 0.3}).density_per_sr, 0);
    EXPECT_EQ(SphericalTriangle({}, {1, 0, 1}, {2, 0, 1}, {3, 0, 1}).sample({0.3, 0.3}).density_per_sr, 0);
    EXPECT_EQ(SphericalTriangle({}, {}, {2, 0, 1}, {3, 0, 1}).sample({0.3, 0.3}).density_per_sr, 0);
}

TEST(Warps, ATriangleByAreaIsFilledEvenly)
{
    // Barycentric halving: the four sub-triangles of half size have equal area.
    std::vector<double> found(4), expected(4, many / 4.0);
    RandomStream random(6);
    for (int i = 0; i < many; ++i) {
        const Point p = triangle_by_area({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, random.square());
        ++found[p.x >= 1 ? 0 : p.y >= 1 ? 1 : p.x + p.y < 1 ? 2 : 3];
    }
    EXPECT_GT(chi_square_probability(found, expected), 1e-6);
}
