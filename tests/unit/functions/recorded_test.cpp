#include "engine/base/errors.h"
#include "engine/base/vector.h"
#include "materials/functions/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <sstream>

/// \file Values of the language as recorded from another implementation.
namespace lightwell {
namespace {

nlohmann::json recorded_cases()
{
    std::ifstream file(LIGHTWELL_ROOT "/../shared/reference/function-files.json");
    if (!file)
        return {};
    return nlohmann::json::parse(file)["cases"];
}

Definitions definitions_of(const nlohmann::json& recorded)
{
    Definitions definitions;
    if (recorded.contains("function_file"))
        definitions = standard_definitions();
    for (const auto& text : recorded["definitions"])
        definitions.add(text.get<std::string>(), "definition");
    return definitions;
}

/// An infinite value is recorded as a word.
double value_of(const nlohmann::json& value)
{
    return value.is_string() ? infinity : value.get<double>();
}

TEST(RecordedFunctions, EveryExpressionHasTheRecordedValue)
{
    const nlohmann::json cases = recorded_cases();
    if (cases.is_null())
        GTEST_SKIP() << "the recorded values are not here";
    int compared = 0;
    for (const auto& recorded : cases) {
        // The calculator lacks the error functions; here all programs have them.
        const bool has_value = recorded.contains("value") && recorded["program"] == "rcalc -n -od";
        const std::string expression = recorded.value("expression", "");
        if (!has_value || expression.starts_with("erf"))
            continue;
        SCOPED_TRACE(recorded["id"].get<std::string>() + ": " + expression);
        const auto found = [&] {
            const Program program = Program::compile(definitions_of(recorded), {expression}, "", {}, "test");
            double value = 0;
            program.evaluate({}, {&value, 1});
            return value;
        };
        ++compared;
        if (recorded["value"].is_null()) {
            // abs() is among our standard definitions only.
            EXPECT_THROW(found(), InputError);
            continue;
        }
        const double expected = value_of(recorded["value"]);
        if (std::isinf(expected))
            EXPECT_EQ(found(), expected);
        else
            EXPECT_NEAR(found(), expected, 1e-12 * std::fabs(expected) + 1e-15);
    }
    EXPECT_GE(compared, 115);
}

TEST(RecordedFunctions, ChannelsInAndOutHaveTheRecordedValues)
{
    const nlohmann::json cases = recorded_cases();
    if (cases.is_null())
        GTEST_SKIP() << "the recorded values are not here";
    int compared = 0;
    for (const auto& recorded : cases) {
        if (recorded["category"] != "channels" || recorded.contains("stderr") || recorded["id"] == "ff-195" ||
            recorded["id"] == "ff-188") // `in` and `cond` belong to the command
            continue;
        SCOPED_TRACE(recorded["id"].get<std::string>());
        const Definitions definitions = definitions_of(recorded);
        std::vector<Program> outputs;
        for (int channel = 1; definitions.find('$' + std::to_string(channel), "") != nullptr; ++channel)
            outputs.push_back(Program::compile_definition(definitions, '$' + std::to_string(channel), "test"));
        std::istringstream in(recorded["input"].get<std::string>()), out(recorded["output"].get<std::string>());
        std::string line;
        while (std::getline(in, line)) {
            std::istringstream words(line);
            std::vector<double> channels;
            for (double value = 0; words >> value;)
                channels.push_back(value);
            for (const Program& output : outputs) {
                double expected = 0, value = 0;
                ASSERT_TRUE(out >> expected);
                output.evaluate(channels, {&value, 1});
                EXPECT_NEAR(value, expected, 1e-8 * std::fabs(expected)); // nine digits are recorded
                ++compared;
            }
        }
    }
    EXPECT_GE(compared, 16);
}

} // namespace
} // namespace lightwell
