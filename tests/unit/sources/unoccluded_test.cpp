#include "engine/sources/unoccluded.h"

#include "engine/base/frame.h"
#include "engine/sources/local_source.h"

#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace lightwell {
namespace {

nlohmann::json technique(const std::string& id)
{
    const char* shared = std::getenv("LIGHTWELL_SHARED");
    std::ifstream file(std::string(shared != nullptr ? shared : LIGHTWELL_ROOT "/../shared") +
                       "/validation/techniques.json");
    if (!file)
        return {};
    const nlohmann::json table = nlohmann::json::parse(file);
    for (const auto& one : table.at("cases"))
        if (one.at("id") == id)
            return one;
    return {};
}

Direction tilted(double angle, double turn)
{
    return {std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn), std::cos(angle)};
}

/// Midpoint sum over the directions of a cone about an axis: what the closed forms are checked against.
double cone_sum(const Direction& axis, double half_angle, const Direction& normal)
{
    const Frame frame = frame_about(axis);
    constexpr int rings = 600, sectors = 600;
    double sum = 0;
    for (int i = 0; i < rings; ++i) {
        const double angle = half_angle * (i + 0.5) / rings;
        for (int k = 0; k < sectors; ++k) {
            const Direction d = frame.to_world(tilted(angle, 2 * pi * (k + 0.5) / sectors));
            sum += std::fmax(0, dot(normal, d)) * std::sin(angle);
        }
    }
    return sum * half_angle / rings * 2 * pi / sectors;
}

/// Midpoint sum over a disc: cos cos / r^2.
double disc_sum(const Vec3& centre, const Direction& axis, double radius, const Direction& normal)
{
    const Frame frame = frame_about(axis);
    constexpr int rings = 1000, sectors = 400;
    double sum = 0;
    for (int i = 0; i < rings; ++i) {
        const double r = radius * (i + 0.5) / rings;
        for (int k = 0; k < sectors; ++k) {
            const double turn = 2 * pi * (k + 0.5) / sectors;
            const Vec3 p = centre + frame.x * (r * std::cos(turn)) + frame.y * (r * std::sin(turn));
            const double squared = dot(p, p);
            sum += std::fmax(0, dot(normal, p)) * -dot(axis, p) / (squared * squared) * r;
        }
    }
    return sum * radius / rings * 2 * pi / sectors;
}

TEST(PolygonIrradiance, MatchesTheWorkedRectangles)
{
    const nlohmann::json one = technique("ext_gradients_rect");
    if (one.is_null())
        GTEST_SKIP() << "techniques.json is not there";
    for (const auto& sensor : one.at("sensors")) {
        const auto p = sensor.at("position").get<std::vector<double>>();
        std::vector<Vec3> corners;
        for (const auto& v : one.at("geometry").at(0).at("vertices"))
            corners.push_back(Vec3{v.at(0), v.at(1), v.at(2)} - Vec3{p[0], p[1], p[2]});
        const double expected = one.at("expected").at(sensor.at("id").get<std::string>()).at("E").get<double>() / 1000;
        EXPECT_NEAR(polygon_irradiance(corners.data(), 4, {0, 0, 1}), expected, 1e-6 * expected);
    }
}

TEST(PolygonIrradiance, OfAUnitSquareOnTheAxisMatchesTheWorkedRatios)
{
    const nlohmann::json one = technique("ext_source_subdivision");
    if (one.is_null())
        GTEST_SKIP() << "techniques.json is not there";
    for (const auto& [key, value] : one.at("expected").items()) {
        const double d = std::stod(key.substr(key.find('=') + 1));
        const Vec3 corners[4] = {{-0.5, -0.5, d}, {-0.5, 0.5, d}, {0.5, 0.5, d}, {0.5, -0.5, d}};
        const double expected = value.at("exact_over_single_point").get<double>() / (d * d);
        EXPECT_NEAR(polygon_irradiance(corners, 4, {0, 0, 1}), expected, 1e-6 * expected) << key;
    }
}

/// A vertical strip from the horizon to elevation e, very wide, seen by a level receiver: pi/2 sin^2 e ... by symmetry
/// a rectangle half below the horizon gives what its upper half gives.
TEST(PolygonIrradiance, WhatLiesBelowTheHorizonDoesNotCount)
{
    const Vec3 whole[4] = {{2, -1, -1}, {2, 1, -1}, {2, 1, 1}, {2, -1, 1}},
               upper[4] = {{2, -1, 0}, {2, 1, 0}, {2, 1, 1}, {2, -1, 1}};
    const double half = polygon_irradiance(upper, 4, {0, 0, 1});
    EXPECT_NEAR(polygon_irradiance(whole, 4, {0, 0, 1}), half, 1e-14);
    EXPECT_GT(half, 0.05);
    EXPECT_EQ(polygon_irradiance(whole, 4, {-1, 0, 0}), 0);
}

TEST(SphereIrradiance, MatchesASumOverDirectionsAboveAcrossAndBelowTheHorizon)
{
    for (const double ratio : {0.05, 0.5, 0.95}) {
        const double half_angle = std::asin(ratio);
        for (const double tilt : {0.0, 0.5, 1.2, pi / 2, 1.8, 2.6}) {
            SCOPED_TRACE(testing::Message() << "radius / distance " << ratio << ", tilt " << tilt);
            const Direction axis = tilted(tilt, 0.3);
            EXPECT_NEAR(sphere_irradiance(axis * 2, 2 * ratio, {0, 0, 1}), cone_sum(axis, half_angle, {0, 0, 1}),
                        2e-5 * half_angle * half_angle);
        }
    }
}

TEST(DiscIrradiance, MatchesASumOverTheDiscForAnyTilt)
{
    const Vec3 places[] = {{0, 0, 2}, {1, 0.5, 2}, {4, 0, 2.5}};
    for (const Vec3& centre : places)
        for (const double turn : {0.0, 0.4, -0.3}) {
            const Direction axis = tilted(pi - std::fabs(turn), turn < 0 ? 2 : 0.7);
            for (const double radius : {0.01, 0.9}) {
                SCOPED_TRACE(testing::Message() << "x " << centre.x << " turn " << turn << " radius " << radius);
                const Direction normal = tilted(0.3, 1);
                const double expected = disc_sum(centre, axis, radius, normal);
                EXPECT_NEAR(disc_irradiance(centre, axis, radius, normal), expected, 2e-6 * expected);
            }
        }
}

/// As a source far away shrinks to a point, all forms tend to L A cos cos / r^2, to 1e-6 at ten thousand radii.
TEST(ClosedForms, KeepTheirDigitsFarAway)
{
    for (const double distance : {1e2, 1e4, 1e8}) {
        SCOPED_TRACE(distance);
        const Vec3 centre = tilted(0.5, 0.2) * distance;
        const Direction normal{0, 0, 1}, down{0, 0, -1};
        const double cosines = std::pow(std::cos(0.5), 2) / (distance * distance);
        const double error = std::fmax(1e-6, 2 / (distance * distance));
        EXPECT_NEAR(disc_irradiance(centre, down, 1, normal) / (pi * cosines), 1, error);
        EXPECT_NEAR(sphere_irradiance(centre, 1, normal) / (pi * cosines / std::cos(0.5)), 1, error);
    }
}

TEST(LocalSource, KnowsItsIrradianceWhereAClosedFormHolds)
{
    const Material light = Light{Spectrum::grey(1)};
    const Material spot = Spotlight{Spectrum::grey(1), 30, {0, 0, -1}};
    const RingEmitter ring{{{0, 0, 2}, {0, 0, -1}, 0.2, 0.5}};
    const LocalSource lamp(ring, light), beam(ring, spot);
    const double expected =
        disc_sum({0.3, 0, 2}, {0, 0, -1}, 0.5, {0, 0, 1}) - disc_sum({0.3, 0, 2}, {0, 0, -1}, 0.2, {0, 0, 1});
    EXPECT_NEAR(*lamp.projected_solid_angle_sr({-0.3, 0, 0}, {0, 0, 1}), expected, 2e-6);
    EXPECT_EQ(*lamp.projected_solid_angle_sr({0, 0, 3}, {0, 0, -1}), 0) << "from behind";
    EXPECT_FALSE(lamp.projected_solid_angle_sr({0, 0, 1.9}, {1, 0, 0})) << "the horizon cuts it";
    EXPECT_FALSE(beam.projected_solid_angle_sr({0, 0, 0}, {0, 0, 1})) << "a beam";
}

/// What a lamp sends to a point, by a grid of samples.
double sampled_irradiance(const LocalSource& lamp, const Point& at, const Direction& normal)
{
    constexpr int steps = 512;
    double sum = 0;
    for (int i = 0; i < steps; ++i)
        for (int k = 0; k < steps; ++k) {
            const SourceSample s = lamp.sample(at, UnitSquare{(i + 0.5) / steps, (k + 0.5) / steps});
            if (s.density_per_sr > 0)
                sum += s.radiance.g * std::fmax(0, dot(s.to_light, normal)) / s.density_per_sr;
        }
    return sum / (steps * steps);
}

TEST(LocalSource, PartsThatMakeUpAWholeTurnGiveTheLightOfTheWhole)
{
    const Material light = Light{Spectrum::grey(1)};
    const Point at{0.4, -0.2, 0.1};
    const Direction normal = normalized({0.1, 0.3, 1});
    const Ring ring{{0, 0, 2}, {0, 0, -1}, 0, 0.5};
    const Cone cone{{{-0.5, 0, 2}, {0.5, 0.2, 1.8}}, {0.3, 0.2}};
    const Direction axis = normalized(cone.ends[1] - cone.ends[0]), start = normalized(cross(axis, {0, 0, 1}));
    double of_rings = 0, of_cones = 0;
    for (const double sweep : {2.5, 2 * pi - 2.5}) {
        Ring part = ring;
        part.sector = {sweep == 2.5 ? Direction{1, 0, 0} : Direction{std::cos(2.5), -std::sin(2.5), 0}, sweep};
        const LocalSource lamp(RingEmitter{part}, light);
        of_rings += sampled_irradiance(lamp, at, normal);
        EXPECT_FALSE(lamp.projected_solid_angle_sr(at, normal)) << "no closed form";
        Cone half = cone;
        half.sector = {sweep == 2.5 ? start : start * std::cos(2.5) + cross(axis, start) * std::sin(2.5), sweep};
        of_cones += sampled_irradiance(LocalSource(ConeEmitter{half, false}, light), at, normal);
    }
    EXPECT_NEAR(of_rings / disc_irradiance(ring.centre - at, ring.normal, ring.outer_radius, normal), 1, 1e-4);
    EXPECT_NEAR(of_cones / sampled_irradiance(LocalSource(ConeEmitter{cone, false}, light), at, normal), 1, 1e-3);
}

TEST(LocalSource, AtTenRadiiTheMiddleTellsTheIrradianceToOnePercent)
{
    const Material light = Light{Spectrum::grey(1)};
    const LocalSource ball(SphereEmitter{{{0, 0, 0}, 0.5}}, light),
        disc(RingEmitter{{{0, 0, 0}, {0, 0, -1}, 0, 0.5}}, light);
    const Point at{3, 0, -4};
    for (const LocalSource* lamp : {&ball, &disc})
        EXPECT_NEAR(lamp->middle_solid_angle_sr(at, {0, 0, 1}) / *lamp->projected_solid_angle_sr(at, {0, 0, 1}), 1,
                    0.01);
}

} // namespace
} // namespace lightwell
