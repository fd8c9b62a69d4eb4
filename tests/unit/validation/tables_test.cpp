// Tables of ../shared/validation that need no transport: skies, weather, well-spread points.

#include "engine/sampling/sobol.h"
#include "engine/sky/perez_sky.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <vector>

namespace lightwell {
namespace {

using nlohmann::json;

json cases_of(const std::string& name)
{
    const char* shared = std::getenv("LIGHTWELL_SHARED");
    std::ifstream stream(std::filesystem::path(shared != nullptr ? shared : LIGHTWELL_ROOT "/../shared") /
                         "validation" / name);
    return stream ? json::parse(stream)["cases"] : json();
}

/// Direction of a key as alt60_az180, azimuth clockwise from north.
Direction direction_of(const std::string& key)
{
    const double altitude = std::stod(key.substr(3)) * radians_per_degree;
    const double azimuth = std::stod(key.substr(key.find("_az") + 3)) * radians_per_degree;
    return {std::cos(altitude) * std::sin(azimuth), std::cos(altitude) * std::cos(azimuth), std::sin(altitude)};
}

/// Luminance over that of the zenith.
double over_zenith(const SkyShape& sky, const Direction& to_sun, const Direction& direction)
{
    const double cosine = std::fmin(1, std::fmax(-1, dot(direction, to_sun)));
    return sky.relative(direction.z, std::acos(cosine)) / sky.relative(1, std::acos(to_sun.z));
}

/// Keeps the largest deviation over tolerance.
class Worst {
public:
    void compare(double found, double expected, double relative, const std::string& where)
    {
        EXPECT_NEAR(found, expected, relative * std::fabs(expected)) << where;
        ratio_ = std::fmax(ratio_, std::fabs(found / expected - 1) / relative);
        ++count_;
    }
    void print(const char* what) const
    {
        std::printf("%s: %d numbers, worst deviation / tolerance %.3g\n", what, count_, ratio_);
    }
    int count() const { return count_; }

private:
    double ratio_ = 0;
    int count_ = 0;
};

TEST(SharedTables, GeneralSkiesHaveTheLuminancesOfTheTable)
{
    const json cases = cases_of("daylight.json");
    if (cases.is_null())
        GTEST_SKIP() << "the tables are not beside the repository";
    constexpr double accepted = 1e-8; // the tables have ten digits
    Worst worst;
    for (const json& entry : cases) {
        const std::string id = entry["id"], start = "day_cie_sky";
        if (!id.starts_with(start))
            continue;
        const int type = std::stoi(id.substr(start.size(), 2));
        if (type > 15)
            continue;
        const double altitude = std::stod(id.substr(id.find("_sun") + 4)) * radians_per_degree;
        const Direction to_sun{0, -std::cos(altitude), std::sin(altitude)};
        for (const auto& [key, value] : entry["expected"]["L_over_Lz"].items())
            worst.compare(over_zenith(general_sky(type), to_sun, direction_of(key)), value, accepted, id + " " + key);
    }
    worst.print("daylight.json, general skies");
    EXPECT_EQ(worst.count(), 15 * 2 * 6);
}

TEST(SharedTables, SkiesOfTheWeatherHaveTheShapeAndEfficacyOfTheTable)
{
    const json cases = cases_of("daylight.json");
    if (cases.is_null())
        GTEST_SKIP() << "the tables are not beside the repository";
    Worst worst;
    for (const json& entry : cases) {
        const std::string id = entry["id"];
        if (!id.starts_with("day_perez"))
            continue;
        const double accepted = entry["tolerance"]["accept_rel"];
        const json &in = entry["input"], &expected = entry["expected"];
        const double zenith = in["solar_zenith_deg"].get<double>() * radians_per_degree;
        const Direction to_sun{0, -std::sin(zenith), std::cos(zenith)};
        const Weather weather{expected["epsilon_used"], expected["delta_used"], in["precipitable_water_cm"]};
        const SkyShape sky = perez_shape(weather, zenith);
        const double zenith_luminance = expected["zenith_luminance_cd_m2"];
        for (const auto& [key, value] : expected["luminance_cd_m2"].items())
            worst.compare(over_zenith(sky, to_sun, direction_of(key)), value.get<double>() / zenith_luminance, accepted,
                          id + " " + key);
        worst.compare(sky.integral(to_sun), expected["integral_exact"], accepted, id + " integral");
        worst.compare(diffuse_efficacy(weather, zenith), expected["diffuse_efficacy"], accepted, id + " diffuse");
        if (expected["direct_efficacy"].is_number() && in["direct_normal_W_m2"] > 0)
            worst.compare(direct_efficacy(weather, zenith), expected["direct_efficacy"], accepted, id + " direct");
    }
    worst.print("daylight.json, Perez");
    EXPECT_GE(worst.count(), 8 * 8);
}

TEST(SharedTables, TheFirstPointsOfTheSequenceAreThoseOfTheTable)
{
    const json cases = cases_of("techniques.json");
    if (cases.is_null())
        GTEST_SKIP() << "the tables are not beside the repository";
    for (const json& entry : cases) {
        if (entry["id"] != "ext_sobol")
            continue;
        std::set<std::vector<double>> expected, found;
        for (const json& point : entry["expected"]["points"])
            expected.insert(point.get<std::vector<double>>());
        for (std::uint32_t i = 0; i < expected.size(); ++i) {
            std::vector<double> point;
            for (int dimension = 0; dimension < 4; ++dimension)
                point.push_back(sobol_bits(i, dimension) * 0x1p-32);
            found.insert(point);
        }
        EXPECT_EQ(found.size(), 16u);
        EXPECT_EQ(found, expected);
        return;
    }
    FAIL() << "no case ext_sobol";
}

} // namespace
} // namespace lightwell
