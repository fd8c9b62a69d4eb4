#include "engine/base/errors.h"
#include "plugins/validation/validation.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

bool contains(const ValidationRow& row, Technique technique)
{
    return (row.techniques & static_cast<unsigned>(technique)) != 0;
}

TEST(Validation, AllRowsPassInAnHonestRun)
{
    const std::vector<ValidationRow> rows = validate_engine({});
    ASSERT_GT(rows.size(), 200u);
    EXPECT_TRUE(all_passed(rows)) << validation_table(rows);
}

class DeliberateError : public testing::TestWithParam<Technique> {};

TEST_P(DeliberateError, OfTwoPercentIsNoticedByTheDetectionRowsOfItsTechniqueAndByNoOther)
{
    ValidationOptions options;
    options.only_detection = true;
    const std::vector<ValidationRow> honest = validate_engine(options);
    options.perturb = GetParam();
    const std::vector<ValidationRow> rows = validate_engine(options);
    ASSERT_EQ(rows.size(), honest.size());
    std::size_t noticed = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const ValidationRow& row = rows[i];
        SCOPED_TRACE(row.case_id + " " + row.quantity);
        EXPECT_TRUE(honest[i].passed) << honest[i].reason;
        if (!contains(row, GetParam())) {
            EXPECT_EQ(row.found, honest[i].found) << "does not contain the technique";
        } else {
            EXPECT_FALSE(row.passed) << "found " << row.found << ", expected " << row.expected;
            ++noticed;
        }
    }
    EXPECT_GE(noticed, 1u);
    const std::string own =
        "detects_" + (GetParam() == Technique::interreflection ? std::string("ambient")
                                                               : technique_names(static_cast<unsigned>(GetParam()))[0]);
    for (const ValidationRow& row : rows)
        if (row.case_id.starts_with("detects_")) {
            EXPECT_EQ(row.passed, row.case_id != own) << row.case_id;
        }
}

INSTANTIATE_TEST_SUITE_P(EachTechnique, DeliberateError,
                         testing::Values(Technique::direct, Technique::sky, Technique::glass,
                                         Technique::interreflection, Technique::specular),
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
        parse_perturbation("mirrors");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "--perturb mirrors: is not a technique; use direct, specular, ambient (or "
                                   "interreflection), sky or glass");
    }
    EXPECT_EQ(parse_perturbation("ambient"), Technique::interreflection);
}

TEST(Validation, ANameOfNoCaseIsRefusedRatherThanPassed)
{
    ValidationOptions options;
    options.only = "cl_sky_unifrom";
    try {
        validate_engine(options);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("cl_sky_uniform"), std::string::npos) << error.what();
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
