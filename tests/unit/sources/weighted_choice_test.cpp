#include "engine/sources/weighted_choice.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

TEST(WeightedChoice, TakesEachEntryForItsShareOfTheNumbersAndHandsOnTheRest)
{
    const double summed[] = {1, 1, 4, 8}; // weights 1, 0, 3, 4
    double taken[4] = {}, left = 0;
    constexpr int numbers = 8000;
    for (int i = 0; i < numbers; ++i) {
        const WeightedChoice c = choose(summed, 4, (i + 0.5) / numbers);
        taken[c.index] += 1.0 / numbers;
        left += c.left / numbers;
        EXPECT_NEAR(c.share, (summed[c.index] - (c.index == 0 ? 0 : summed[c.index - 1])) / 8, 1e-15);
    }
    EXPECT_NEAR(taken[0], 1 / 8.0, 1e-12);
    EXPECT_EQ(taken[1], 0);
    EXPECT_NEAR(taken[2], 3 / 8.0, 1e-12);
    EXPECT_NEAR(taken[3], 4 / 8.0, 1e-12);
    EXPECT_NEAR(left, 0.5, 1e-9);
}

TEST(WeightedChoice, OfNothingHasNoShare)
{
    const double summed[] = {0, 0};
    EXPECT_EQ(choose(summed, 2, 0.7).share, 0);
}

} // namespace
} // namespace lightwell
