#include "engine/sky/sky.h"

#include "engine/base/errors.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

using namespace lightwell;

namespace {

/// One recorded run of a sky program: what it was asked, and the numbers it printed.
struct Recorded {
    std::string id;
    SkyOptions options{CieSky::clear, true, 2.45, 0.2};
    bool comparable = true; ///< false where an option that make_sky() has not was given
    Direction to_sun;
    bool has_sun_direction = false;
    double sun_radiance = 0;
    std::vector<double> sky; ///< kind, zenith, ground, normalization, sun
};

void read_arguments(const nlohmann::json& args, Recorded& run)
{
    for (std::size_t i = 0; i < args.size(); ++i) {
        const std::string a = args[i];
        if (a == "+s" || a == "-s")
            run.options.kind = CieSky::clear, run.options.with_sun = a[0] == '+';
        else if (a == "+i" || a == "-i")
            run.options.kind = CieSky::intermediate, run.options.with_sun = a[0] == '+';
        else if (a == "-c")
            run.options.kind = CieSky::overcast;
        else if (a == "-u")
            run.options.kind = CieSky::uniform;
        else if (a == "-t")
            run.options.turbidity = std::stod(args[++i].get<std::string>());
        else if (a == "-g")
            run.options.ground_reflectance = std::stod(args[++i].get<std::string>());
        else if (a == "-b" || a == "-B" || a == "-r" || a == "-R")
            run.comparable = false;
        else if (a == "-ang") {
            // Azimuth is counted westwards from south there.
            const double altitude = std::stod(args[i + 1].get<std::string>());
            run.to_sun = sun_direction({altitude, 180 + std::stod(args[i + 2].get<std::string>())});
            run.has_sun_direction = true;
            i += 2;
        }
    }
}

void read_output(const std::string& text, Recorded& run)
{
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::vector<double> numbers;
        for (double x; words >> x;)
            numbers.push_back(x);
        if (numbers.size() == 4 && numbers[0] == 3 && numbers[1] == numbers[2])
            run.sun_radiance = numbers[1];
        else if (numbers.size() == 4 && numbers[0] == 3)
            run.sky.assign(numbers.begin() + 1, numbers.end());
        else if (numbers.size() == 8 && numbers[0] == 7)
            run.sky.assign(numbers.begin() + 1, numbers.end());
    }
    // "3 kind zenith ground" has three numbers after the count as well; kinds 2 and 3 have no sun.
    std::istringstream again(text);
    for (std::string line; std::getline(again, line);)
        if (line.rfind("3 2 ", 0) == 0 || line.rfind("3 3 ", 0) == 0) {
            std::istringstream words(line.substr(2));
            run.sky.clear();
            for (double x; words >> x;)
                run.sky.push_back(x);
        }
    if (!run.has_sun_direction && run.sky.size() == 7) {
        run.to_sun = {run.sky[4], run.sky[5], run.sky[6]};
        run.has_sun_direction = true;
    }
}

std::vector<Recorded> recorded_runs()
{
    const char* elsewhere = std::getenv("LIGHTWELL_SHARED");
    const std::filesystem::path folder = elsewhere ? elsewhere : LIGHTWELL_ROOT "/../shared";
    std::ifstream file(folder / "reference/sky-programs.json");
    std::vector<Recorded> runs;
    if (!file)
        return runs;
    const nlohmann::json data = nlohmann::json::parse(file);
    for (const auto& c : data["cases"]) {
        if (c["program"] != "gensky" || c["exit_status"] != 0)
            continue;
        Recorded run;
        run.id = c["id"];
        read_arguments(c["args"], run);
        read_output(c["output"], run);
        if (run.comparable && run.has_sun_direction && run.sky.size() >= 3)
            runs.push_back(run);
    }
    return runs;
}

double sine_squared(double full_angle_deg)
{
    return std::pow(std::sin(full_angle_deg / 2 * radians_per_degree), 2);
}

} // namespace

TEST(SkyModel, ZenithGroundNormalizationAndSunAreThoseOfTheRecordedRuns)
{
    const std::vector<Recorded> runs = recorded_runs();
    if (runs.empty())
        GTEST_SKIP() << "the recorded runs are not beside the repository";
    int with_sun = 0;
    for (const Recorded& run : runs) {
        SCOPED_TRACE(run.id);
        const SkyModel sky = make_sky(run.options, normalized(run.to_sun));
        // Printed with four digits; the sun's direction with six, which the tangent multiplies near the zenith.
        constexpr double digits = 2e-3;
        EXPECT_NEAR(sky.zenith, run.sky[1], digits * run.sky[1] + 1e-9);
        EXPECT_NEAR(sky.ground, run.sky[2], digits * run.sky[2] + 1e-9);
        if (run.sky.size() == 7) {
            EXPECT_NEAR(sky.normalization, run.sky[3], digits * run.sky[3]);
            EXPECT_NEAR(length(sky.to_sun - Direction{run.sky[4], run.sky[5], run.sky[6]}), 0, 1e-5);
        }
        EXPECT_EQ(sky.with_sun, run.sun_radiance > 0);
        if (sky.with_sun) {
            // The same irradiance from a disc of another size.
            const double irradiance = pi * sine_squared(sun_full_angle_deg) * sky.sun_radiance;
            EXPECT_NEAR(irradiance / (pi * sine_squared(0.5) * run.sun_radiance), 1, digits);
            ++with_sun;
        }
    }
    EXPECT_GE(runs.size(), 40u);
    EXPECT_GE(with_sun, 20);
}

TEST(SkyModel, ZenithLuminancesAreThoseOfTheModels)
{
    const Direction sun = sun_direction({30, 180});
    // Krochmann's overcast zenith: 123 + 8600 sin(altitude) cd/m^2, at 203 lm/W.
    EXPECT_NEAR(make_sky({CieSky::overcast, false, 2.45, 0.2}, sun).zenith * 203, 123 + 4300, 1e-9);
    // Clear: ((1.376 T - 1.81) tan(altitude) + 0.38) kcd/m^2.
    EXPECT_NEAR(make_sky({CieSky::clear, false, 4, 0.2}, sun).zenith * 203,
                1000 * ((1.376 * 4 - 1.81) / std::sqrt(3.0) + 0.38), 1e-9);
    // The ground under an overcast sky: 7/9 of the zenith, times its reflectance.
    const SkyModel overcast = make_sky({CieSky::overcast, false, 2.45, 0.3}, sun);
    EXPECT_NEAR(overcast.ground, overcast.zenith * 7 / 9 * 0.3, 1e-12);
    EXPECT_FALSE(make_sky({CieSky::overcast, true, 2.45, 0.3}, sun).with_sun);
}

TEST(SkyModel, AtNightTheSunIsOffAndNothingIsNegative)
{
    for (CieSky kind : {CieSky::clear, CieSky::intermediate, CieSky::overcast, CieSky::uniform})
        for (double altitude : {0.0, -1.0, -18.0, -90.0}) {
            const SkyModel sky = make_sky({kind, true, 2.45, 0.2}, sun_direction({altitude, 10}));
            EXPECT_FALSE(sky.with_sun);
            EXPECT_EQ(sky.sun_radiance, 0);
            EXPECT_GE(sky.zenith, 0);
            EXPECT_GE(sky.ground, 0);
            EXPECT_TRUE(std::isfinite(sky.normalization));
        }
}

TEST(SkyModel, ASunNearTheZenithIsHeldWhereTheModelHolds)
{
    const SkyModel highest = make_sky({CieSky::clear, true, 2.45, 0.2}, {0, 0, 1});
    EXPECT_NEAR(highest.to_sun.z, std::sin(87 * radians_per_degree), 1e-15);
    EXPECT_TRUE(std::isfinite(highest.zenith));
    // The overcast sky has no such limit.
    EXPECT_EQ(make_sky({CieSky::overcast, false, 2.45, 0.2}, {0, 0, 1}).to_sun.z, 1);
}

TEST(SkyModel, OptionsOutsideTheirRangeAreRefusedWithTheValue)
{
    const double nan_value = std::numeric_limits<double>::quiet_NaN();
    for (double bad : {nan_value, 0.5, infinity})
        EXPECT_THROW(make_sky({CieSky::clear, true, bad, 0.2}, {0, 0, 1}), InputError);
    for (double bad : {nan_value, -0.1, 1.1})
        EXPECT_THROW(make_sky({CieSky::clear, true, 2.45, bad}, {0, 0, 1}), InputError);
    EXPECT_THROW(make_sky({CieSky::clear, true, 2.45, 0.2}, {0, 0, 0.5}), InputError);
    EXPECT_THROW(make_sky({CieSky::clear, true, 2.45, 0.2}, {nan_value, 0, 1}), InputError);
    try {
        make_sky({CieSky::clear, true, 2.45, 1.5}, {0, 0, 1});
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()),
                  "sky: ground reflectance is 1.5, expected in [0, 1]; grass has 0.2, snow 0.8");
    }
}
