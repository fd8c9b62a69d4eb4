#include "engine/base/errors.h"
#include "plugins/validation/validation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightwell {
namespace {

bool contains(const ValidationRow& row, Technique technique)
{
    return (row.techniques & static_cast<unsigned>(technique)) != 0;
}

/// The run that everything else is compared with, made once.
const std::vector<ValidationRow>& honest_rows()
{
    static const std::vector<ValidationRow> rows = validate_engine({});
    return rows;
}

TEST(Validation, AllRowsPassInAnHonestRun)
{
    ASSERT_GT(honest_rows().size(), 150u);
    for (const ValidationRow& row : honest_rows())
        EXPECT_TRUE(row.passed) << row.case_id << " " << row.quantity << ": " << row.reason << ", found " << row.found
                                << ", expected " << row.expected << ", tolerance " << row.tolerance;
}

/// A row of interreflection is lit by something: its detection rows are those whose main light has been reflected.
class DeliberateError : public testing::TestWithParam<Technique> {};

TEST_P(DeliberateError, OfTwoPercentIsNoticedByTheDetectionRowsOfItsTechniqueAndByNoOther)
{
    ValidationOptions options;
    options.perturb = GetParam();
    const std::vector<ValidationRow> rows = validate_engine(options);
    ASSERT_EQ(rows.size(), honest_rows().size());
    std::size_t noticed = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const ValidationRow& row = rows[i];
        SCOPED_TRACE(row.case_id + " " + row.quantity);
        if (!contains(row, GetParam())) {
            EXPECT_EQ(row.found, honest_rows()[i].found) << "does not contain the technique";
        } else if (row.detection) {
            EXPECT_FALSE(row.passed) << "found " << row.found << ", expected " << row.expected;
            ++noticed;
        }
    }
    EXPECT_GE(noticed, 2u);
}

INSTANTIATE_TEST_SUITE_P(EachTechnique, DeliberateError,
                         testing::Values(Technique::direct, Technique::sky, Technique::glass,
                                         Technique::interreflection),
                         [](const auto& each) { return technique_names(static_cast<unsigned>(each.param))[0]; });

TEST(Validation, ResultsDoNotDependOnTheNumberOfThreads)
{
    ValidationOptions options;
    options.only = "cl_corner_0.5";
    options.threads = 1;
    const std::vector<ValidationRow> one = validate_engine(options);
    options.threads = 3;
    const std::vector<ValidationRow> three = validate_engine(options);
    ASSERT_EQ(one.size(), three.size());
    for (std::size_t i = 0; i < one.size(); ++i)
        EXPECT_EQ(one[i].found, three[i].found) << one[i].quantity;
}

TEST(Validation, AnUnknownTechniqueIsRefusedWithTheNamesOfAll)
{
    try {
        parse_perturbation("specular");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "--perturb specular: is not a technique; use direct, sky, glass or interreflection");
    }
}

TEST(Validation, StopsWhenAsked)
{
    Progress progress;
    progress.cancelled = [] { return true; };
    EXPECT_THROW(validate_engine({}, progress), Cancelled);
}

} // namespace
} // namespace lightwell
