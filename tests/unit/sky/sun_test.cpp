#include "engine/sky/sky.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

using namespace lightwell;

namespace {

/// Angle between two places in the sky: an azimuth near the zenith is worth less than one near the horizon.
double apart_deg(const SunPosition& a, const SunPosition& b)
{
    const Direction x = sun_direction(a), y = sun_direction(b);
    return std::atan2(length(cross(x, y)), dot(x, y)) / radians_per_degree;
}

} // namespace

TEST(Sun, ThePublishedExampleOfTheSolarPositionAlgorithmComesOut)
{
    // Reda, Andreas 2004, Appendix A.5: zenith angle 50.11162 with refraction, of which 0.01632 is refraction.
    const SunPosition found = sun_position({39.742476, -105.1786, -7, 2003, 10, 17, 12 + 30.0 / 60 + 30.0 / 3600});
    EXPECT_NEAR(found.azimuth_deg, 194.34024, 0.003);
    EXPECT_NEAR(found.altitude_deg, 90 - 50.11162 - 0.01632, 0.003);
}

TEST(Sun, PlacesAndTimesOfACenturyAgreeWithTheEphemerisWithinAHundredthOfADegree)
{
    // PyEphem 4.1.4 (VSOP87), without refraction: universal time, altitude, azimuth.
    const struct {
        PlaceAndTime when;
        double altitude_deg, azimuth_deg;
    } rows[] = {{{53.80, -157.28, 0, 1974, 2, 9, 13.66}, -37.9612, 58.5543},
                {{-8.99, 54.57, 0, 1971, 2, 27, 11.89}, 40.9150, 266.5328},
                {{-83.95, 120.88, 0, 1987, 9, 3, 2.25}, -2.3206, 25.0494},
                {{47.55, 70.50, 0, 2027, 8, 26, 14.58}, -4.6330, 290.8304},
                {{-48.28, 160.30, 0, 1997, 10, 15, 17.32}, -10.2949, 115.7873},
                {{-84.47, 14.91, 0, 2006, 12, 16, 0.73}, 18.3507, 153.9148},
                {{83.49, 81.31, 0, 2018, 5, 26, 16.48}, 15.5651, 330.3358},
                {{-11.06, -1.51, 0, 2044, 9, 2, 5.32}, -12.7868, 84.5463},
                {{31.48, 93.94, 0, 1991, 10, 28, 8.30}, 29.7015, 229.2472},
                {{-14.92, 149.86, 0, 2001, 12, 30, 22.24}, 35.5919, 107.9913},
                {{87.67, 129.58, 0, 1967, 12, 11, 4.46}, -20.7299, 197.9666},
                {{70.41, 170.37, 0, 1971, 9, 10, 17.84}, 0.9488, 77.6997}};
    for (const auto& row : rows)
        EXPECT_LT(apart_deg(sun_position(row.when), {row.altitude_deg, row.azimuth_deg}), 0.003)
            << row.when.year << "-" << row.when.month;
}

TEST(Sun, ReferencePositionsAgree)
{
    const char* elsewhere = std::getenv("LIGHTWELL_SHARED");
    const std::filesystem::path folder = elsewhere ? elsewhere : LIGHTWELL_ROOT "/../shared";
    std::ifstream file(folder / "validation/daylight.json");
    if (!file)
        GTEST_SKIP() << "the validation data is not beside the repository";
    int compared = 0;
    const nlohmann::json data = nlohmann::json::parse(file);
    for (const auto& c : data["cases"]) {
        if (!c.contains("input") || !c["input"].contains("date_utc"))
            continue;
        const auto& in = c["input"];
        const auto& date = in["date_utc"];
        const PlaceAndTime when{in["latitude_deg"], in["longitude_deg_east"], 0, date[0], date[1], date[2],
                                in["hour_utc"]};
        const SunPosition expected{c["expected"]["altitude"], c["expected"]["azimuth"]};
        EXPECT_LT(apart_deg(sun_position(when), expected), 0.004) << c["id"];
        ++compared;
    }
    EXPECT_GE(compared, 7);
}

TEST(Sun, TheUtcOffsetAndTheDateLineMoveTheClockOnly)
{
    const SunPosition utc = sun_position({-33.87, 151.2, 0, 2015, 9, 1, 3.25});
    const SunPosition local = sun_position({-33.87, 151.2, 10, 2015, 9, 1, 13.25});
    EXPECT_LT(apart_deg(utc, local), 1e-6);
    // 1 o'clock on New Year's day at UTC+14 is 11 o'clock of the day before.
    EXPECT_LT(apart_deg(sun_position({2, -157.5, 14, 2021, 1, 1, 1}), sun_position({2, -157.5, 0, 2020, 12, 31, 11})),
              1e-6);
}

TEST(Sun, DirectionsFollowTheCompassAndTheModelsNorth)
{
    const Direction east = sun_direction({0, 90});
    EXPECT_NEAR(east.x, 1, 1e-15);
    EXPECT_NEAR(east.y, 0, 1e-15);
    const Direction south_half_up = sun_direction({30, 180});
    EXPECT_NEAR(south_half_up.y, -std::sqrt(0.75), 1e-15);
    EXPECT_NEAR(south_half_up.z, 0.5, 1e-15);
    // The model's north lies along -x, a quarter turn counter-clockwise from +y: a northern sun shines along it.
    const Direction north = sun_direction({0, 0}, 90);
    EXPECT_NEAR(north.x, -1, 1e-15);
    EXPECT_NEAR(north.y, 0, 1e-15);
}
