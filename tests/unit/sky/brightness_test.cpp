#include "engine/sky/sky.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace lightwell;

namespace {

const Direction up{0, 0, 1};

Direction at(double altitude_deg, double azimuth_deg)
{
    return sun_direction({altitude_deg, azimuth_deg});
}

/// Irradiance of a horizontal surface from the sky alone, midpoint rule over the upper hemisphere, per cos^2 band.
double horizontal_irradiance(int kind, double normalization, const Direction& to_sun)
{
    constexpr int rings = 400, sectors = 400;
    double sum = 0;
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < sectors; ++j) {
            // Equal steps of sin^2 of the polar angle have equal projected solid angle.
            const double z = std::sqrt(1 - (i + 0.5) / rings), r = std::sqrt(1 - z * z);
            const double azimuth = 2 * pi * (j + 0.5) / sectors;
            sum += sky_brightness(kind, 1, 0, normalization, to_sun, {r * std::cos(azimuth), r * std::sin(azimuth), z});
        }
    return sum * pi / (rings * sectors);
}

} // namespace

TEST(SkyBrightness, TheOvercastSkyGivesSevenNinthsOfPiTimesTheZenith)
{
    // The blend with the (here black) ground takes 0.3 % of it near the horizon.
    EXPECT_NEAR(horizontal_irradiance(2, 1, up) / (7 * pi / 9), 1, 0.004);
    EXPECT_NEAR(horizontal_irradiance(3, 1, up) / pi, 1, 0.005);
}

TEST(SkyBrightness, TheOvercastSkyIsThriceAsBrightAtTheZenithAsAtTheHorizon)
{
    EXPECT_NEAR(sky_brightness(2, 12, 12.0 / 3, 1, up, {1, 0, 0}), 4, 0.02);
    EXPECT_NEAR(sky_brightness(2, 12, 0, 1, up, up), 12, 1e-4);
    EXPECT_NEAR(sky_brightness(2, 12, 0, 1, up, {0.6, 0, 0.8}), 12 * 2.6 / 3, 1e-3);
}

TEST(SkyBrightness, TheGroundShowsBelowAndBlendsOverTheHorizon)
{
    for (int kind : {1, 2, 3, 4}) {
        EXPECT_NEAR(sky_brightness(kind, 10, 3, 1, at(40, 120), {0, 0, -1}), 3, 1e-6) << kind;
        EXPECT_NEAR(sky_brightness(kind, 10, 3, 1, at(40, 120), {0.8, 0, -0.6}), 3, 1e-2) << kind;
    }
    // At the horizon the weights are 1.01^10 and 1.01^-10: 0.5496 of the sky.
    const double weight = std::pow(1.01, 20) / (1 + std::pow(1.01, 20));
    EXPECT_NEAR(sky_brightness(3, 10, 2, 1, up, {1, 0, 0}), 10 * weight + 2 * (1 - weight), 1e-12);
}

TEST(SkyBrightness, EveryModelGivesTheZenithRadianceItIsGiven)
{
    for (CieSky kind : {CieSky::clear, CieSky::intermediate, CieSky::overcast, CieSky::uniform})
        for (double altitude : {2.0, 20.0, 55.0, 80.0}) {
            const SkyModel sky = make_sky({kind, true, 2.45, 0.2}, at(altitude, 200));
            const int number = kind == CieSky::clear      ? 1
                               : kind == CieSky::overcast ? 2
                               : kind == CieSky::uniform  ? 3
                                                          : 4;
            const double zenith = sky_brightness(number, sky.zenith, 0, sky.normalization, sky.to_sun, up);
            // The published constants are rounded to three digits.
            EXPECT_NEAR(zenith / sky.zenith, 1, 2e-3) << number << " " << altitude;
        }
}

TEST(SkyBrightness, TheSkyIsBrightestAroundTheSunAndRelativeValuesAreTheClosedForm)
{
    const Direction sun = at(60, 180);
    const SkyModel sky = make_sky({CieSky::clear, true, 2.45, 0.2}, sun);
    const auto radiance = [&](const Direction& d) {
        return sky_brightness(1, sky.zenith, 0, sky.normalization, sky.to_sun, d) / sky.zenith;
    };
    EXPECT_GT(radiance(sun), radiance(at(60, 0)));
    // CIE clear sky: (0.91 + 10 e^-3g + 0.45 cos^2 g)(1 - e^(-0.32/sin a)) / (0.274 (0.91 + 10 e^-3z + 0.45 cos^2 z)).
    const double z = 30 * radians_per_degree, g = 90 * radians_per_degree;
    const double below = 0.274 * (0.91 + 10 * std::exp(-3 * z) + 0.45 * std::cos(z) * std::cos(z));
    EXPECT_NEAR(radiance(at(30, 0)), (0.91 + 10 * std::exp(-3 * g)) * (1 - std::exp(-0.64)) / below, 1e-3);
}

TEST(SkyBrightness, ASkyWithoutASunInItIsFiniteEverywhere)
{
    for (int kind : {1, 2, 3, 4})
        for (const Direction& d : {up, Direction{0, 0, -1}, Direction{1, 0, 0}, at(0.5, 10), at(-0.5, 10)})
            for (const Direction& sun : {up, at(-30, 0), d}) {
                const double radiance = sky_brightness(kind, 5, 1, 0.5, sun, d);
                EXPECT_TRUE(std::isfinite(radiance));
                EXPECT_GE(radiance, 0);
            }
}
