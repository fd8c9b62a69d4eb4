#include "engine/sampling/sobol.h"

#include "engine/sampling/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

using namespace lightwell;

namespace {

/// Every elementary box of 2^-a by 2^-b with a + b = exponent holds the same number of the first 2^exponent points.
void expect_net(const std::vector<UnitSquare>& points, int exponent)
{
    for (int a = 0; a <= exponent; ++a) {
        std::set<std::pair<int, int>> boxes;
        for (const UnitSquare& p : points)
            boxes.insert({static_cast<int>(p.u * (1 << a)), static_cast<int>(p.v * (1 << (exponent - a)))});
        EXPECT_EQ(boxes.size(), points.size()) << a;
    }
}

} // namespace

TEST(Sobol, TheFirstPointsAreThePublishedOnes)
{
    // Joe, Kuo 2008: 0; 1/2; 1/4, 3/4 in the order of the radical inverse; dimension 2: 0, 1/2, 3/4, 1/4, 5/8 ...
    const std::vector<double> second{0, 0.5, 0.75, 0.25, 0.625, 0.125, 0.375, 0.875};
    const std::vector<double> first{0, 0.5, 0.25, 0.75, 0.125, 0.625, 0.375, 0.875};
    for (std::uint32_t i = 0; i < 8; ++i) {
        EXPECT_EQ(sobol_bits(i, 0) * 0x1p-32, first[i]);
        EXPECT_EQ(sobol_bits(i, 1) * 0x1p-32, second[i]);
    }
}

TEST(Sobol, EveryAlignedRunOfAPairIsANetForAnyPairSeedAndItem)
{
    for (std::uint64_t seed : {0u, 1u, 77u})
        for (std::uint32_t pair : {0u, 2u, 4u, 40u})
            for (std::uint32_t start : {0u, 256u, 4096u}) {
                const SampleSequence sequence(seed, 1000 + pair);
                std::vector<UnitSquare> points;
                for (std::uint32_t i = 0; i < 256; ++i)
                    points.push_back(sequence.pair(start + i, pair));
                expect_net(points, 8);
            }
}

TEST(Sobol, TwoNeighbouringPairsAreStratifiedJointly)
{
    // A sequence of quality t <= 3: 256 points put 16 into each of the 16 halves, quarters, ... of four dimensions.
    const SampleSequence sequence(8, 9);
    std::vector<int> boxes(16);
    for (std::uint32_t i = 0; i < 256; ++i) {
        const UnitSquare a = sequence.pair(i, 6), b = sequence.pair(i, 7);
        ++boxes[(a.u < 0.5) + 2 * (a.v < 0.5) + 4 * (b.u < 0.5) + 8 * (b.v < 0.5)];
    }
    for (int count : boxes)
        EXPECT_EQ(count, 16);
}

TEST(Sobol, OddPairsAndSingleDimensionsAreStratifiedInEachCoordinate)
{
    const SampleSequence sequence(3, 4);
    std::set<int> u, v, w;
    for (std::uint32_t i = 0; i < 1024; ++i) {
        const UnitSquare p = sequence.pair(i, 7);
        u.insert(static_cast<int>(p.u * 1024));
        v.insert(static_cast<int>(p.v * 1024));
        w.insert(static_cast<int>(sequence.one(i, 5) * 1024));
    }
    EXPECT_EQ(u.size(), 1024u);
    EXPECT_EQ(v.size(), 1024u);
    EXPECT_EQ(w.size(), 1024u);
}

TEST(Sobol, DifferentSeedsGiveIndependentEstimatesWithoutBias)
{
    // Integral of u v^2 exp(w) = 1/2 * 1/3 * (e - 1); every seed is one unbiased estimate from 16 points.
    RunningStatistics means;
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
        const SampleSequence sequence(seed, 5);
        double sum = 0;
        for (std::uint32_t i = 0; i < 16; ++i) {
            const UnitSquare p = sequence.pair(i, 0);
            sum += p.u * p.v * p.v * std::exp(sequence.pair(i, 3).u);
        }
        means.add(sum / 16);
    }
    const double expected = (std::exp(1.0) - 1) / 6;
    EXPECT_TRUE(agrees(estimate_of(means), expected)) << means.mean() << " against " << expected;
    EXPECT_LT(means.standard_error() / expected, 0.02 / 7.2);
}

TEST(Sobol, SmoothIntegrandsConvergeFasterThanIndependentSamples)
{
    const auto deviation = [](std::uint32_t points) {
        RunningStatistics means;
        for (std::uint64_t seed = 0; seed < 200; ++seed) {
            const SampleSequence sequence(seed, 1);
            double sum = 0;
            for (std::uint32_t i = 0; i < points; ++i) {
                const UnitSquare p = sequence.pair(i, 2);
                sum += std::exp(p.u) * std::cos(p.v);
            }
            means.add(sum / points);
        }
        return std::sqrt(means.variance());
    };
    // Independent samples would gain a factor of 8; scrambled nets gain about 64^1.5 = 512.
    EXPECT_GT(deviation(16) / deviation(1024), 100);
}

TEST(Sobol, DistantDimensionsAndItemsAreUncorrelated)
{
    RunningStatistics dimensions, items;
    for (std::uint64_t item = 0; item < 20000; ++item) {
        const SampleSequence a(9, item), b(9, item + 1);
        const double x = a.pair(0, 0).u - 0.5;
        dimensions.add(x * (a.pair(0, 2).u - 0.5));
        dimensions.add(x * (a.one(0, 0) - 0.5));
        items.add(x * (b.pair(0, 0).u - 0.5));
    }
    EXPECT_TRUE(agrees(estimate_of(dimensions), 0));
    EXPECT_TRUE(agrees(estimate_of(items), 0));
}

TEST(Sobol, TheSamePointComesWhateverWasAskedBefore)
{
    const SampleSequence a(5, 6);
    const UnitSquare first = a.pair(123456789, 11);
    a.pair(3, 2);
    const UnitSquare again = SampleSequence(5, 6).pair(123456789, 11);
    EXPECT_EQ(first.u, again.u);
    EXPECT_EQ(first.v, again.v);
    EXPECT_LT(first.u, 1);
    EXPECT_GE(first.u, 0);
}
