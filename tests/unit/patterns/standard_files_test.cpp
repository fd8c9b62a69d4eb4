#include "engine/sky/sky.h"
#include "tests/unit/patterns/pattern_text.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

PatternPlace sky_at(double altitude, double azimuth)
{
    PatternPlace place;
    place.direction = {std::cos(altitude) * std::cos(azimuth), std::cos(altitude) * std::sin(azimuth),
                       std::sin(altitude)};
    place.normal = -place.direction;
    place.distant = true;
    return place;
}

TEST(StandardFunctionFiles, SkyBrightnessIsThatOfTheBuiltInSkies)
{
    const PatternFolder folder;
    const Direction to_sun = normalized({0.4, -0.5, 0.7});
    for (const int kind : {1, 2, 3, 4}) {
        SCOPED_TRACE(kind);
        const auto sky = folder.pattern("brightfunc", {"skybr", "skybright.cal"},
                                        {static_cast<double>(kind), 31, 9, 1.7, to_sun.x, to_sun.y, to_sun.z});
        for (double altitude = -1.5; altitude <= 1.5; altitude += 0.097)
            for (double azimuth = 0; azimuth < 6.3; azimuth += 0.7) {
                const PatternPlace place = sky_at(altitude, azimuth);
                const double built_in = sky_brightness(kind, 31, 9, 1.7, to_sun, place.direction, false);
                EXPECT_NEAR(sky->at(place).g, built_in, 1e-9 * built_in);
            }
        EXPECT_EQ(sky->failures(), 0u);
    }
}

TEST(StandardFunctionFiles, AllWeatherSkyHasItsFormula)
{
    // Perez et al. 1993, Eq. (1), written out for one direction well above the horizon.
    const PatternFolder folder;
    const auto sky =
        folder.pattern("brightfunc", {"skybright", "perezlum.cal"}, {40, 5, -1.1, -.3, 8, -2.5, .4, 0, 0, 1});
    const double altitude = 0.9, gamma = pi / 2 - altitude, sine = std::sin(altitude);
    const double above = 40 * (1 - 1.1 * std::exp(-.3 / sine)) * (1 + 8 * std::exp(-2.5 * gamma) + .4 * sine * sine);
    const double up = std::pow(sine + 1.01, 10), down = 1 / up;
    const double expected = (above * up + 5 * down) / (up + down);
    EXPECT_NEAR(sky->at(sky_at(altitude, 2)).g, expected, 1e-12 * expected);
}

TEST(StandardFunctionFiles, AnglesOfLampsCountFromBelow)
{
    const PatternFolder folder;
    PatternPlace place;
    const auto value = [&](const char* formula, const Direction& leaves, const std::vector<double>& numbers = {}) {
        place.direction = -leaves; // the ray goes to the lamp
        place.normal = {0, 0, -1};
        return folder.pattern("brightfunc", {formula, "source.cal"}, numbers)->at(place).g;
    };
    const double slant = std::sqrt(0.5);
    EXPECT_NEAR(value("src_theta", {0, 0, -1}), 0, 1e-6);
    EXPECT_NEAR(value("src_theta", {slant, 0, -slant}), 45, 1e-9);
    EXPECT_NEAR(value("src_phi", {0, slant, -slant}), 90, 1e-9);
    EXPECT_NEAR(value("src_phi", {0, -slant, -slant}), 270, 1e-9);
    EXPECT_NEAR(value("src_phi2", {0, -slant, -slant}), 90, 1e-9);
    EXPECT_NEAR(value("src_phi4", {-slant * std::cos(.3), slant * std::sin(.3), -slant}), .3 / radians_per_degree,
                1e-9);
    EXPECT_NEAR(value("flatcorr(3)", {slant, 0, -slant}), 3 / slant, 1e-12);
    EXPECT_NEAR(value("flatcorr(3)", {slant, 0, -slant}, {2}), 6 / slant, 1e-12);
    EXPECT_NEAR(value("boxcorr(3)", {slant, 0, -slant}, {1, .5, .4, .2}), 3 / (slant * (.4 * .2 + .5 * .4)), 1e-12);
    EXPECT_NEAR(value("cylcorr(3)", {1, 0, 0}, {1, .2, .5}), 3 / .1, 1e-12);
}

TEST(StandardFunctionFiles, DataOfLampsAreCorrectedForThePlace)
{
    // The correction asks for the place, not only for what the table gives.
    const PatternFolder folder;
    folder.write("even.dat", "2\n0 90 2\n0 180 2\n6 6\n6 6\n");
    PatternPlace place;
    place.direction = {std::sqrt(0.75), 0, 0.5};
    place.normal = {0, 0, -1};
    const auto lamp = folder.pattern("brightdata", {"flatcorr", "even.dat", "source.cal", "src_phi4", "src_theta"});
    EXPECT_NEAR(lamp->at(place).g, 12, 1e-12);
}

} // namespace
} // namespace lightwell
