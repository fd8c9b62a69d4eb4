#include "engine/direct/adaptive.h"
#include "engine/direct/visibility_history.h"

#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace lightwell {
namespace {

/// Figure 4 of the paper.
const std::vector<double> potential{1053, 750, 600, 520, 100, 30, 11, 6, 2, 0, 0};
const std::vector<double> history{0.9, 0.55, 0.65, 0.95, 0.3, 1.0, 0.2, 0.6, 0.15, 0.9, 0.75};
const std::vector<bool> visible{true, false, false, true, false, false, false, false, false, false, false};

AdaptiveOutcome run(double threshold, double certainty, const std::vector<bool>& seen)
{
    return test_adaptively(
        potential.size(), [&](std::size_t i) { return potential[i]; }, [&](std::size_t i) { return history[i]; },
        [&](std::size_t i) { return seen[i] ? 1.0 : 0.0; }, threshold, certainty);
}

TEST(AdaptiveTesting, GivesTheSumOfFigure4)
{
    const AdaptiveOutcome outcome = run(0.1, 1, visible);
    EXPECT_EQ(outcome.tested, 4u);
    EXPECT_DOUBLE_EQ(outcome.found, 1573);
    EXPECT_DOUBLE_EQ(outcome.most_remaining, 149);
    EXPECT_NEAR(outcome.success_ratio, 2 / (0.9 + 0.55 + 0.65 + 0.95), 1e-12);
    EXPECT_NEAR(outcome.found + outcome.estimated, 1616.344262, 1e-6);
    EXPECT_NEAR(outcome.doubt(), 149 - 43.3442623, 1e-6);
}

TEST(AdaptiveTesting, MatchesTheSharedTableOfTechniques)
{
    const char* shared = std::getenv("LIGHTWELL_SHARED");
    std::ifstream file(std::string(shared != nullptr ? shared : LIGHTWELL_ROOT "/../shared") +
                       "/validation/techniques.json");
    if (!file)
        GTEST_SKIP() << "techniques.json is not there";
    const nlohmann::json table = nlohmann::json::parse(file);
    for (const auto& one : table.at("cases")) {
        if (one.at("id") != "ext_adaptive_shadow")
            continue;
        const auto& in = one.at("input");
        const auto p = in.at("potential").get<std::vector<double>>(), h = in.at("history").get<std::vector<double>>();
        const auto v = in.at("visible").get<std::vector<bool>>();
        const AdaptiveOutcome outcome = test_adaptively(
            p.size(), [&](std::size_t i) { return p[i]; }, [&](std::size_t i) { return h[i]; },
            [&](std::size_t i) { return v[i] ? 1.0 : 0.0; }, in.at("accuracy").get<double>(), 1);
        const auto& expected = one.at("expected");
        EXPECT_EQ(outcome.tested, expected.at("tested").get<std::size_t>());
        EXPECT_NEAR(outcome.found, expected.at("sum_of_tested").get<double>(), 1e-9);
        EXPECT_NEAR(outcome.success_ratio, expected.at("success_ratio").get<double>(), 1e-9);
        EXPECT_NEAR(outcome.estimated, expected.at("remainder_estimate").get<double>(), 1e-6);
        EXPECT_NEAR(outcome.found + outcome.estimated, expected.at("total_estimate").get<double>(), 1e-5);
        return;
    }
    FAIL() << "no case ext_adaptive_shadow";
}

TEST(AdaptiveTesting, AThresholdOfZeroTestsAll)
{
    const AdaptiveOutcome outcome = run(0, 1, visible);
    EXPECT_EQ(outcome.tested, potential.size());
    EXPECT_DOUBLE_EQ(outcome.found, 1573);
    EXPECT_EQ(outcome.estimated, 0);
    EXPECT_EQ(outcome.doubt(), 0);
}

TEST(AdaptiveTesting, WhereNothingIsVisibleAllThatCouldGiveLightAreTested)
{
    const AdaptiveOutcome outcome = run(0.1, 1, std::vector<bool>(potential.size(), false));
    EXPECT_EQ(outcome.tested, 9u) << "the last two give nothing anyway";
    EXPECT_EQ(outcome.found, 0);
}

/// With a certainty of 0 only the next source counts: 520 > 10 % of 1053 is tested, 100 <= 10 % of 1573 ends it; with
/// 11^0.5 = 3.3 the next three.
TEST(AdaptiveTesting, LessCertaintyLooksAtFewerSourcesBeforeItStops)
{
    EXPECT_EQ(run(0.1, 0, visible).tested, 4u);
    EXPECT_EQ(run(0.05, 0, visible).tested, 5u);
    EXPECT_EQ(run(0.05, 1, visible).tested, 5u);
    EXPECT_EQ(run(0.02, 0, visible).tested, 5u) << "30 is below 31.5";
    EXPECT_EQ(run(0.02, 0.5, visible).tested, 6u) << "30 + 11 + 6 is above it";
}

TEST(AdaptiveTesting, TheErrorStaysBelowTheDoubtForEveryPatternOfShadows)
{
    for (unsigned pattern = 0; pattern < 2048; ++pattern) {
        std::vector<bool> seen;
        double truth = 0;
        for (std::size_t i = 0; i < potential.size(); ++i) {
            seen.push_back((pattern >> i) & 1);
            truth += seen.back() ? potential[i] : 0;
        }
        const AdaptiveOutcome outcome = run(0.1, 1, seen);
        EXPECT_LE(std::fabs(outcome.found + outcome.estimated - truth), outcome.doubt() + 1e-9);
        EXPECT_LE(outcome.doubt(), 0.1 * outcome.found + 1e-9);
    }
}

TEST(VisibilityCounts, AddUpToTheSameWhateverTheOrder)
{
    VisibilityCounts a(2), b(2), ab(2), ba(2);
    for (int i = 0; i < 100; ++i) {
        a.record(0, 1 / (1.0 + i));
        b.record(0, 0.01 * i);
        b.record(1, 1);
    }
    ab.add(a);
    ab.add(b);
    ba.add(b);
    ba.add(a);
    EXPECT_EQ(ab.visible(0), ba.visible(0));
    EXPECT_EQ(ab.tested(0), 200u);
    EXPECT_NEAR(ab.visible(0), 5.19 + 49.5, 0.2);
    const VisibilityHistory known(ab);
    EXPECT_NEAR(known.rate(0), (ab.visible(0) + 1) / 201, 1e-6);
    EXPECT_EQ(known.rate(1), 1);
    EXPECT_EQ(VisibilityHistory().rate(7), 1) << "nothing is known in its way";
}

} // namespace
} // namespace lightwell
