#include "plugins/validation/validation.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>

namespace lightwell {
namespace {

using nlohmann::json;

std::filesystem::path classical_file()
{
    const char* shared = std::getenv("LIGHTWELL_SHARED");
    return std::filesystem::path(shared != nullptr ? shared : LIGHTWELL_ROOT "/../shared") /
           "validation/classical.json";
}

/// Numbers by path: {"s0": {"direct": 1}} gives s0.direct; texts are explanations.
void flatten(const json& node, const std::string& key, std::map<std::string, double>& numbers)
{
    if (node.is_number())
        numbers[key] = node;
    else if (node.is_object())
        for (const auto& [name, child] : node.items())
            flatten(child, key.empty() ? name : key + "." + name, numbers);
}

/// Ten digits are printed: half a unit of the last.
constexpr double printed = 5.1e-10;

void compare(const json& entry, const std::map<std::string, double>& ours)
{
    std::map<std::string, double> numbers;
    flatten(entry["expected"], "", numbers);
    const json& tolerance = entry["tolerance"];
    const double relative = tolerance.value("ref_rel", 0.0), absolute = tolerance.value("ref_abs", 0.0);
    for (const auto& [key, value] : ours) {
        const auto theirs = numbers.find(key);
        if (theirs == numbers.end()) {
            // Names of our own rows may add a word to the key: "clear_dielectric_sphere_any_index 2.4".
            EXPECT_TRUE(numbers.count(key.substr(0, key.find(' '))) > 0) << key << " is not in the table";
            continue;
        }
        EXPECT_NEAR(value, theirs->second, (relative + printed) * std::fabs(theirs->second) + absolute + 1e-12) << key;
    }
    EXPECT_FALSE(ours.empty());
}

TEST(ClassicalTable, FormulasOfTheValidationAgreeWithItsNumbers)
{
    std::ifstream stream(classical_file());
    if (!stream)
        GTEST_SKIP() << "no table of classical cases at " << classical_file();
    const json table = json::parse(stream);
    std::map<std::string, std::map<std::string, double>> ours;
    for (const ReferenceValue& value : reference_values())
        ours[value.case_id][value.key] = value.value;
    std::size_t covered = 0, numbers = 0;
    for (const json& entry : table["cases"]) {
        const std::string id = entry["id"];
        SCOPED_TRACE(id);
        const auto found = ours.find(id);
        if (found == ours.end()) {
            ADD_FAILURE() << "not covered";
            continue;
        }
        compare(entry, found->second);
        ++covered;
        numbers += found->second.size();
    }
    std::cout << covered << " of " << table["cases"].size() << " cases covered, " << numbers << " numbers compared\n";
    EXPECT_EQ(covered, table["cases"].size());
}

} // namespace
} // namespace lightwell
