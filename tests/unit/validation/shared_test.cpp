// Every table of ../shared/validation that the engine can be held against: the formulas of the validation agree with
// the numbers of the tables, and what the engine finds agrees with the tables within their tolerance.

#include "plugins/validation/validation.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>

namespace lightwell {
namespace {

using nlohmann::json;

std::optional<json> table(const std::string& name)
{
    const char* shared = std::getenv("LIGHTWELL_SHARED");
    std::ifstream stream(std::filesystem::path(shared != nullptr ? shared : LIGHTWELL_ROOT "/../shared") /
                         "validation" / name);
    return stream ? std::optional<json>(json::parse(stream)) : std::nullopt;
}

/// Tolerance of one number of a case at the highest accuracy.
double accepted(const json& entry, double value)
{
    const json& tolerance = entry["tolerance"];
    return tolerance.value("accept_rel", 0.0) * std::fabs(value) + tolerance.value("accept_abs", 0.0);
}

double uncertainty(const json& entry, const std::string& key, double value)
{
    constexpr double printed = 5.1e-10;
    const json& tolerance = entry["tolerance"];
    const double relative = tolerance.value("ref_rel", 0.0) + printed;
    const double stated =
        entry.contains("expected_uncertainty_abs") ? entry["expected_uncertainty_abs"].value(key, 0.0) : 0;
    return std::fmax(relative * std::fabs(value), stated) + tolerance.value("ref_abs", 0.0);
}

const json* number_of(const json& entry, const std::string& key)
{
    const json* node = &entry["expected"];
    if (node->contains(key))
        return &(*node)[key];
    const std::size_t dot = key.find('.');
    if (dot != std::string::npos && node->contains(key.substr(0, dot)) &&
        (*node)[key.substr(0, dot)].contains(key.substr(dot + 1)))
        return &(*node)[key.substr(0, dot)][key.substr(dot + 1)];
    return nullptr;
}

struct Worst {
    double ratio = 0;
    std::string where = "-";
    int compared = 0;
    void take(double found, const std::string& at)
    {
        ++compared;
        if (found > ratio) {
            ratio = found;
            where = at;
        }
    }
};

/// @param ours  relative error that our own way to the numbers is allowed beside theirs
void compare_formulas(std::map<std::string, std::map<std::string, double>>& values, const std::string& file,
                      double ours, const std::string& begin = "")
{
    const std::optional<json> whole = table(file);
    ASSERT_TRUE(whole) << file;
    Worst worst;
    int cases = 0, covered = 0;
    for (const json& entry : (*whole)["cases"]) {
        const std::string id = entry["id"];
        if (!id.starts_with(begin))
            continue;
        ++cases;
        covered += values.count(id) > 0 ? 1 : 0;
        EXPECT_TRUE(values.count(id) > 0) << id << " is not covered";
        for (const auto& [key, value] : values[id]) {
            const json* theirs = number_of(entry, key);
            if (theirs == nullptr)
                continue;
            const double expected = *theirs, allowed = uncertainty(entry, key, expected) + ours * std::fabs(expected);
            worst.take(std::fabs(value - expected) / (allowed + 1e-12), id + " " + key);
            EXPECT_NEAR(value, expected, allowed + 1e-12) << id << " " << key;
        }
    }
    std::printf("%s: %d of %d cases, %d numbers; formulas: worst deviation / allowed %.3f at %s\n", file.c_str(),
                covered, cases, worst.compared, worst.ratio, worst.where.c_str());
    EXPECT_GT(worst.compared, cases);
}

TEST(SharedTables, OurOwnWaysToTheNumbersAgreeWithTheTables)
{
    if (!table("radiosity.json"))
        GTEST_SKIP() << "the tables are not beside the repository";
    std::map<std::string, std::map<std::string, double>> values;
    for (const ReferenceValue& value : reference_values())
        values[value.case_id][value.key] = value.value;
    compare_formulas(values, "cie171_electric.json", 1e-9);
    compare_formulas(values, "cie171_daylight.json", 2e-4);
    compare_formulas(values, "daylight.json", 1e-4, "day_cie_sky");
    compare_formulas(values, "radiosity.json", 2e-3);
}

/// What the engine finds, in a quick look, against the tables' own tolerances beside its error: LIGHTWELL_FULL=1 runs
/// the full validation.
TEST(SharedTables, TheEngineFindsTheNumbersOfTheTables)
{
    ValidationOptions options;
    options.full = std::getenv("LIGHTWELL_FULL") != nullptr;
    const std::vector<ValidationRow> rows = validate_engine(options);
    int files = 0;
    for (const char* file :
         {"classical.json", "radiosity.json", "cie171_electric.json", "cie171_daylight.json", "daylight.json"}) {
        const std::optional<json> whole = table(file);
        if (!whole)
            continue;
        ++files;
        std::map<std::string, const json*> entries;
        for (const json& entry : (*whole)["cases"])
            entries[entry["id"]] = &entry;
        Worst worst;
        for (const ValidationRow& row : rows) {
            if (entries.count(row.case_id) == 0)
                continue;
            const double error = row.half_width_95 / 2.365;
            const double stated = options.full ? accepted(*entries[row.case_id], row.expected) : 0;
            const double allowed = stated > 0 ? stated : row.tolerance;
            const double ratio = std::fabs(row.deviation()) / (allowed + 3 * error);
            worst.take(ratio, row.case_id + " " + row.quantity);
            EXPECT_LE(ratio, 1) << row.case_id << " " << row.quantity << ": " << row.found << ", expected "
                                << row.expected;
        }
        std::printf("%s: %d rows of the engine; worst deviation / (tolerance + 3 standard errors) %.3f at %s\n", file,
                    worst.compared, worst.ratio, worst.where.c_str());
        EXPECT_GT(worst.compared, 0) << file;
    }
    if (files == 0)
        GTEST_SKIP() << "the tables are not beside the repository";
}

} // namespace
} // namespace lightwell
