#include "engine/sky/perez_sky.h"

#include "engine/base/errors.h"
#include "engine/sky/sky.h"
#include "engine/sky/sky_clock.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightwell {
namespace {

Direction sun_at(double altitude_deg)
{
    return {0, -std::cos(altitude_deg * radians_per_degree), std::sin(altitude_deg * radians_per_degree)};
}

TEST(GeneralSkies, TheOvercastSkyFallsToOneThirdAtTheHorizonNearly)
{
    // Type 1 was made to resemble the old overcast sky, whose zenith is three times its horizon.
    const SkyShape sky = general_sky(1);
    EXPECT_NEAR(sky.relative(1, 1) / sky.relative(0.01, 1), 3, 0.05);
    // Type 5 is uniform.
    const SkyShape uniform = general_sky(5);
    EXPECT_NEAR(uniform.relative(0.02, 0.3) / uniform.relative(1, 2), 1, 1e-12);
    EXPECT_NEAR(uniform.integral(sun_at(40)), pi * uniform.relative(1, 0), 1e-5);
}

TEST(GeneralSkies, TheShapeIsTheFormulaOfTheStandard)
{
    // Type 12, the CIE standard clear sky: gradation V, indicatrix 4; both relative to the value at a right angle to
    // the sun, worked out from the published a = -1, b = -0.32, c = 10, d = -3, e = 0.45.
    const SkyShape sky = general_sky(12);
    const auto published = [](double height, double angle) {
        const double cosine = std::cos(angle);
        return (1 - std::exp(-0.32 / height)) *
               (1 + 10 * (std::exp(-3 * angle) - std::exp(-3 * pi / 2)) + 0.45 * cosine * cosine);
    };
    for (const double height : {0.05, 0.3, 0.7, 1.0})
        for (const double angle : {0.0, 0.4, 1.0, 2.0})
            EXPECT_NEAR(sky.relative(height, angle) / sky.relative(1, pi / 2) * published(1, pi / 2),
                        published(height, angle), 1e-12);
    EXPECT_THROW(general_sky(0), InputError);
    EXPECT_THROW(general_sky(16), InputError);
}

TEST(PerezSkies, PatchesComeCloseToTheIntegral)
{
    for (const double clearness : {1.0, 1.15, 1.4, 2.0, 3.0, 5.0, 7.0})
        for (const double altitude : {15.0, 40.0, 70.0}) {
            const SkyShape shape = perez_shape({clearness, 0.2}, (90 - altitude) * radians_per_degree);
            EXPECT_NEAR(shape.patch_sum(sun_at(altitude)) / shape.integral(sun_at(altitude)), 1, 0.03)
                << clearness << ' ' << altitude;
        }
}

TEST(PerezSkies, WeatherAndIrradianceAreInverse)
{
    const double zenith = 50 * radians_per_degree;
    const SkyIrradiance light = irradiance_of({4.2, 0.15}, zenith, 100);
    const Weather weather = weather_of(light, zenith, 100);
    EXPECT_NEAR(weather.clearness, 4.2, 1e-12);
    EXPECT_NEAR(weather.brightness, 0.15, 1e-12);
    EXPECT_NEAR(diffuse_share(0.5), 0.6593, 1e-3); // the published curve at one half
}

TEST(SkyClocks, ADateGivesTheSunOfTheEphemeris)
{
    for (const int year : {1950, 1987, 2024, 2050})
        for (const int month : {1, 4, 7, 10}) {
            PlaceAndTime when{48, 11.5, 1, year, month, 17, 9.25};
            const SunPosition exact = sun_position(when);
            const SkyClock clock{48 * radians_per_degree, -11.5 * radians_per_degree, -15 * radians_per_degree};
            const SunAngles found = sun_angles(solar_time_of_date(year, month, 17, 9.25, clock), clock.latitude_rad);
            EXPECT_NEAR(found.altitude_rad / radians_per_degree, exact.altitude_deg, 0.015) << year << ' ' << month;
            EXPECT_NEAR(found.azimuth_rad / radians_per_degree + 180, exact.azimuth_deg, 0.02) << year << ' ' << month;
        }
}

} // namespace
} // namespace lightwell
