#include "engine/ambient/site.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

AmbientSite flat_site(double along_m, double across_m)
{
    AmbientSite site;
    site.position = {10, 20, 0};
    site.normal = {0, 0, 1};
    site.axis = {1, 0, 0};
    site.reach_m[0] = along_m;
    site.reach_m[1] = across_m;
    return site;
}

double distance_to(const AmbientSite& site, const Vec3& offset, const Direction& normal = {0, 0, 1})
{
    return site_distance(site, site.position + offset, normal);
}

/// What an upright wall that faces the site gives back to a ray.
Met wall_at(double distance_m, const Direction& ray)
{
    return {distance_m, normalized({-ray.x, -ray.y, 0})};
}

TEST(AmbientSite, DistanceCountsInReachesAndEndsAtOne)
{
    const AmbientSite site = flat_site(2, 2);
    EXPECT_EQ(distance_to(site, {0, 0, 0}), 0);
    EXPECT_NEAR(distance_to(site, {0.6, 0.8, 0}), 0.5, 1e-15);
    EXPECT_NEAR(distance_to(site, {-1.9, 0, 0}), 0.95, 1e-15);
    EXPECT_EQ(distance_to(site, {2.01, 0, 0}), infinity);
    EXPECT_EQ(distance_to(site, {1.5, 1.5, 0}), infinity);
}

TEST(AmbientSite, AnEllipseReachesFartherAlongItsAxisThanAcross)
{
    AmbientSite site = flat_site(3, 0.5);
    EXPECT_NEAR(distance_to(site, {1.5, 0, 0}), 0.5, 1e-15);
    EXPECT_NEAR(distance_to(site, {0, 0.25, 0}), 0.5, 1e-15);
    EXPECT_NEAR(distance_to(site, {1.5, 0.25, 0}), std::sqrt(0.5), 1e-15);
    EXPECT_EQ(distance_to(site, {0, 1.5, 0}), infinity);
    site.axis = {0, 1, 0};
    EXPECT_NEAR(distance_to(site, {0, 1.5, 0}), 0.5, 1e-15);
    EXPECT_EQ(distance_to(site, {1.5, 0, 0}), infinity);
}

/// Turned by an angle a: squares add, of distance / reach and of (1 - cos a) / (1 - 0.94).
TEST(AmbientSite, TurnOfTheNormalAddsToTheDistanceAndEndsAtTwentyDegrees)
{
    const AmbientSite site = flat_site(2, 2);
    for (const double degrees : {1.0, 10.0, 19.0}) {
        const double a = degrees * radians_per_degree;
        EXPECT_NEAR(distance_to(site, {0, 0, 0}, {std::sin(a), 0, std::cos(a)}), std::sqrt((1 - std::cos(a)) / 0.06),
                    1e-9)
            << degrees;
    }
    const double a = 10 * radians_per_degree;
    EXPECT_NEAR(distance_to(site, {0, 1, 0}, {std::sin(a), 0, std::cos(a)}), std::sqrt(0.25 + (1 - std::cos(a)) / 0.06),
                1e-9);
    const double b = 21 * radians_per_degree;
    EXPECT_EQ(distance_to(site, {0, 0, 0}, {std::sin(b), 0, std::cos(b)}), infinity);
    EXPECT_EQ(distance_to(site, {0, 0, 0}, {0, 0, -1}), infinity) << "the other side of a sheet is another place";
}

TEST(AmbientSite, ShelvesAboveAndBelowAreNotTheSamePlace)
{
    const AmbientSite site = flat_site(2, 1);
    EXPECT_LT(distance_to(site, {0.5, 0.1, 0.004}), 1) << "a floor need not be perfectly even";
    EXPECT_EQ(distance_to(site, {0.1, 0.1, 0.11}), infinity);
    EXPECT_EQ(distance_to(site, {0.1, 0.1, -0.11}), infinity);
}

/// Two points of a sphere lie in its mean tangent plane exactly, however far either lies off the other's.
TEST(AmbientSite, CurvedSurfacesStayOneSurface)
{
    for (const double radius : {1e-6, 1.0, 1e6}) {
        AmbientSite site;
        site.position = {0, 0, radius};
        site.normal = {0, 0, 1};
        site.axis = {1, 0, 0};
        const double a = 8 * radians_per_degree, chord = 2 * radius * std::sin(a / 2);
        site.reach_m[0] = site.reach_m[1] = 1.25 * chord;
        const Direction there{std::sin(a), 0, std::cos(a)};
        const double flat = radius * std::sin(a) / (1.25 * chord);
        EXPECT_NEAR(site_distance(site, there * radius, there), std::hypot(flat, std::sqrt((1 - std::cos(a)) / 0.06)),
                    1e-6)
            << radius;
    }
}

/// Something a metre away stands between the site and what lies farther in that direction, and nowhere else.
TEST(AmbientSite, NothingIsSharedWithWhatLiesBehindAnObstacle)
{
    AmbientSite site = flat_site(4, 4);
    const double elevation = 10 * radians_per_degree;
    const Direction low{std::cos(elevation) * std::cos(0.2), std::cos(elevation) * std::sin(0.2), std::sin(elevation)};
    add_horizon(site, low, wall_at(1 / std::cos(elevation), low));
    const Vec3 way{std::cos(0.2), std::sin(0.2), 0};
    EXPECT_NEAR(distance_to(site, way * 0.99), 0.2475, 1e-9);
    EXPECT_EQ(distance_to(site, way * 1.01), infinity);
    EXPECT_EQ(distance_to(site, way * 3), infinity);
    EXPECT_NEAR(distance_to(site, way * -3), 0.75, 1e-9) << "the other way is free";
    EXPECT_NEAR(distance_to(site, {0, 3, 0}), 0.75, 1e-9);
}

/// A straight wall, met by two low rays in each sector: nothing beyond it answers, at whatever azimuth its foot lies.
TEST(AmbientSite, AStraightWallHidesAllThatLiesBehindIt)
{
    for (double turn = 0; turn < 2 * pi; turn += 0.07) {
        AmbientSite site = flat_site(8, 8);
        const auto to_wall = [&](double azimuth) { return 1 / std::cos(azimuth - turn); };
        for (int ray = 0; ray < 2 * horizon_sectors; ++ray) {
            const double azimuth = 2 * pi * ((ray + 0.5) / (2 * horizon_sectors));
            const double away = to_wall(azimuth);
            if (away > 0) {
                const Direction low = normalized({std::cos(azimuth), std::sin(azimuth), 1e-6});
                add_horizon(site, low, {away, {-std::cos(turn), -std::sin(turn), 0}});
            }
        }
        int near_side = 0, asked = 0;
        for (int i = 0; i < 360; ++i) {
            const double azimuth = 2 * pi * (i + 0.5) / 360, wall = to_wall(azimuth);
            if (!(wall > 0 && wall < 7))
                continue;
            const Vec3 way{std::cos(azimuth), std::sin(azimuth), 0};
            EXPECT_EQ(distance_to(site, way * (wall * 1.001)), infinity) << turn << ' ' << i;
            near_side += distance_to(site, way * (wall * 0.99)) < 1 ? 1 : 0;
            ++asked;
        }
        EXPECT_EQ(near_side, asked) << "this side of the wall is served up to its foot";
    }
}

/// A slope that rises away from the site, met half a metre up: it begins where its plane meets the floor.
TEST(AmbientSite, ASlopeHidesWhatLiesBeyondItsFoot)
{
    AmbientSite site = flat_site(4, 4);
    const Direction low = normalized({1, 0, 0.25});
    add_horizon(site, low, {2 / low.x, normalized({-1, 0, 0.5})}); // 2 m away, half a metre up
    EXPECT_NEAR(distance_to(site, {1.74, 0, 0}), 0.435, 1e-6);
    EXPECT_EQ(distance_to(site, {1.76, 0, 0}), infinity);
}

TEST(AmbientSite, TheNearestObstacleOfASectorCounts)
{
    AmbientSite site = flat_site(4, 4);
    const Direction low = normalized({1, 0.2, 0.01});
    for (const double distance : {3.0, 1.0, 2.0})
        add_horizon(site, low, wall_at(distance, low));
    EXPECT_EQ(distance_to(site, {1.2, 0.24, 0}), infinity);
    EXPECT_LT(distance_to(site, {0.8, 0.16, 0}), 1);
}

TEST(AmbientSite, WhatStandsHigherThanFortyFiveDegreesHidesNothing)
{
    AmbientSite site = flat_site(4, 4);
    add_horizon(site, normalized({1, 0, 1.01}), wall_at(0.1, {1, 0, 0}));
    add_horizon(site, normalized({1, 0, 0.1}), Met{});
    EXPECT_EQ(site.least_horizon_m, infinity);
    EXPECT_NEAR(distance_to(site, {3, 0, 0}), 0.75, 1e-12);
}

/// A bowl's floor bends up before the ray: its places are told by their normals, not by a horizon.
TEST(AmbientSite, TheSurfaceItselfThatBendsUpHidesNothing)
{
    AmbientSite site = flat_site(4, 4);
    add_horizon(site, normalized({1, 0, 0.01}), {0.5, normalized({-0.1, 0, 1})});
    EXPECT_NEAR(distance_to(site, {3, 0, 0}), 0.75, 1e-12);
    add_horizon(site, normalized({1, 0, 0.01}), {0.5, normalized({-1, 0, 1})});
    EXPECT_EQ(distance_to(site, {3, 0, 0}), infinity);
}

TEST(AmbientSite, NumbersThatAreNoneAreInfinitelyFar)
{
    const double none = std::numeric_limits<double>::quiet_NaN();
    const AmbientSite site = flat_site(2, 2);
    EXPECT_EQ(distance_to(site, {none, 0, 0}), infinity);
    EXPECT_EQ(distance_to(site, {0, 0, 0}, {none, 0, 0}), infinity);
    EXPECT_EQ(distance_to(flat_site(0, 0), {0, 0, 0}), infinity) << "a site without reach answers nowhere";
    EXPECT_EQ(distance_to(flat_site(none, 2), {0, 0, 0}), infinity);
}

} // namespace
} // namespace lightwell
