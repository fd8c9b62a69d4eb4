#include "plugins/validation/refinement.h"

#include <gtest/gtest.h>

#include <random>

namespace lightwell {
namespace {

/// Light of which one sample in 500 finds all: its mean is 1. Eight replicates stand behind the error.
class RareLight {
public:
    explicit RareLight(unsigned seed) : random_(seed) {}
    MeasuredValue measure(double samples)
    {
        constexpr double rarity = 500;
        constexpr int replicates = 8;
        const double each = samples / replicates;
        std::poisson_distribution<int> hits(each / rarity);
        double sum = 0, squares = 0;
        for (int r = 0; r < replicates; ++r) {
            const double value = hits(random_) * rarity / each;
            sum += value / replicates;
            squares += value * value / replicates;
        }
        return {sum, std::sqrt(std::max(0.0, squares - sum * sum) / (replicates - 1))};
    }

private:
    std::mt19937_64 random_;
};

constexpr int seeds = 1000;
constexpr double wanted = 0.1, first = 512;

double kept(unsigned seed)
{
    RareLight light(seed);
    std::vector<WantedQuantity> quantity{{1, 3 * wanted, wanted}};
    refine_by([&](const auto&, double work) { return std::vector<MeasuredValue>{light.measure(work)}; },
              {first / 4, 4 * first, 1 << 22, 1.5, false}, quantity);
    EXPECT_LE(quantity[0].found.error, wanted) << seed;
    return quantity[0].found.value;
}

/// What is wrong with doubling until the error is small.
double kept_because_its_own_error_is_small(unsigned seed)
{
    RareLight light(seed);
    for (double samples = first;; samples *= 2)
        if (const MeasuredValue found = light.measure(samples); found.error <= wanted)
            return found.value;
}

} // namespace

TEST(Refinement, ValuesThatMissedRareLightAreNotKept)
{
    double mean = 0, mean_by_own_error = 0;
    for (unsigned seed = 1; seed <= seeds; ++seed) {
        mean += kept(seed) / seeds;
        mean_by_own_error += kept_because_its_own_error_is_small(seed) / seeds;
    }
    // 1000 values with an error of 0.1 each: 0.003; what is left of the bias is that of runs too small three times.
    EXPECT_NEAR(mean, 1, 0.03);
    EXPECT_LT(mean_by_own_error, 0.8);
}

TEST(Refinement, TheMostWorkEndsItHoweverNoisyTheValueIs)
{
    std::vector<WantedQuantity> quantity{{1, 0, 0}};
    int runs = 0;
    double largest = 0;
    refine_by(
        [&](const auto&, double work) {
            largest = std::max(largest, work);
            EXPECT_LE(++runs, 20);
            return std::vector<MeasuredValue>{{1, std::numeric_limits<double>::quiet_NaN()}};
        },
        {64, 4096, 1 << 20, 1.5, false}, quantity);
    EXPECT_LE(largest, 1 << 20);
    EXPECT_FALSE(quantity[0].found.error <= quantity[0].wanted);
}

TEST(Refinement, EachQuantityGetsTheWorkThatItNeeds)
{
    // The second is ten times as noisy as the first.
    std::vector<WantedQuantity> quantities{{1, 0.03, 0.01}, {1, 0.03, 0.01}};
    double most[2] = {0, 0};
    refine_by(
        [&](const std::vector<std::size_t>& which, double work) {
            std::vector<MeasuredValue> found;
            for (const std::size_t i : which) {
                most[i] = std::max(most[i], work);
                found.push_back({1, (i == 0 ? 0.5 : 5) / std::sqrt(work)});
            }
            return found;
        },
        {256, 4096, 1 << 24, 2, false}, quantities);
    EXPECT_TRUE(quantities[0].known && quantities[1].known);
    EXPECT_EQ(most[0], 4096);
    EXPECT_GE(most[1], 2.5e5); // (5 / 0.01)^2
    EXPECT_LE(most[1], 1e6);
}

} // namespace lightwell
