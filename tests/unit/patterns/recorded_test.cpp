#include "engine/base/errors.h"
#include "tests/unit/patterns/pattern_text.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

/// \file What another renderer's functions knew about the place that a ray met.
namespace lightwell {
namespace {

Vec3 vector_of(const nlohmann::json& numbers)
{
    return {numbers[0].get<double>(), numbers[1].get<double>(), numbers[2].get<double>()};
}

TEST(RecordedPatterns, FunctionsOfThePlaceHaveTheRecordedValues)
{
    std::ifstream file(LIGHTWELL_ROOT "/../shared/reference/function-files.json");
    if (!file)
        GTEST_SKIP() << "the recorded values are not here";
    const nlohmann::json cases = nlohmann::json::parse(file)["cases"];
    const PatternFolder folder;
    int compared = 0;
    for (const auto& recorded : cases) {
        if (!recorded["program"].get<std::string>().starts_with("brightfunc"))
            continue;
        SCOPED_TRACE(recorded["id"].get<std::string>() + ": " + recorded["expression"].get<std::string>());
        std::vector<std::string> words{recorded["expression"].get<std::string>(), "."};
        if (recorded["function_file_text"].is_string()) {
            folder.write("test.cal", recorded["function_file_text"].get<std::string>());
            words[1] = "test.cal";
        }
        for (const auto& word : recorded["transform"])
            words.push_back(word.get<std::string>());
        const auto numbers = recorded["real_arguments"].get<std::vector<double>>();
        ++compared;
        if (recorded["value"].is_null()) {
            EXPECT_THROW(folder.pattern("brightfunc", words, numbers), InputError);
            continue;
        }
        PatternPlace place;
        place.position = vector_of(recorded["point"]);
        place.direction = vector_of(recorded["ray_direction"]);
        place.normal = {0, 0, 1};
        place.distance_m = length(place.position - vector_of(recorded["ray_origin"]));
        // The tolerance is that of the record, made in single precision; slopes were taken there over a short step.
        const std::string expression = words[0];
        const bool slope = expression.starts_with("noise3") && !expression.starts_with("noise3(");
        const bool slopes = expression.starts_with("turbulencex");
        const double tolerance = slope || slopes ? 2e-3 : recorded["absolute_tolerance"].get<double>();
        EXPECT_NEAR(folder.pattern("brightfunc", words, numbers)->at(place).g, recorded["value"].get<double>(),
                    tolerance);
    }
    EXPECT_EQ(compared, 48);
}

} // namespace
} // namespace lightwell
