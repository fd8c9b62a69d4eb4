#include "engine/sampling/statistics.h"

#include "engine/base/random.h"

#include <gtest/gtest.h>

using namespace lightwell;

TEST(Statistics, MeanAndVarianceKeepTheirDigitsFarFromZero)
{
    RunningStatistics statistics;
    for (double x : {1e9 + 4, 1e9 + 7, 1e9 + 13, 1e9 + 16})
        statistics.add(x);
    EXPECT_DOUBLE_EQ(statistics.mean(), 1e9 + 10);
    EXPECT_DOUBLE_EQ(statistics.variance(), 30);
    EXPECT_DOUBLE_EQ(statistics.standard_error(), std::sqrt(7.5));
}

TEST(Statistics, MergedPartsAreTheWhole)
{
    RunningStatistics whole, first, second, empty;
    RandomStream random(1);
    for (int i = 0; i < 1000; ++i) {
        const double x = random.next();
        whole.add(x);
        (i < 300 ? first : second).add(x);
    }
    first.merge(second);
    first.merge(empty);
    EXPECT_EQ(first.count(), whole.count());
    EXPECT_NEAR(first.mean(), whole.mean(), 1e-14);
    EXPECT_NEAR(first.variance(), whole.variance(), 1e-14);
}

TEST(Statistics, QuantilesAreTheTabulatedOnes)
{
    EXPECT_NEAR(normal_quantile(0.975), 1.959963985, 1e-9);
    EXPECT_NEAR(normal_quantile(0.5), 0, 1e-9);
    EXPECT_NEAR(normal_quantile(1 - 0.975), -1.959963985, 1e-9);
    EXPECT_NEAR(student_t_quantile(0.975, 1), 12.7062047362, 1e-8);
    EXPECT_NEAR(student_t_quantile(0.975, 7), 2.36462425, 1e-8);
    EXPECT_NEAR(student_t_quantile(0.95, 30), 1.69726089, 1e-8);
    EXPECT_NEAR(student_t_quantile(0.025, 7), -2.36462425, 1e-8);
    EXPECT_NEAR(chi_square_survival(3.841458821, 1), 0.05, 1e-9);
    EXPECT_NEAR(chi_square_survival(18.30703805, 10), 0.05, 1e-9);
    EXPECT_NEAR(chi_square_survival(40, 10) / 1.694474e-5, 1, 1e-5);
}

TEST(Statistics, AgreementFailsAsOftenAsItsFalseAlarmAllows)
{
    // 20000 means of 64 uniform numbers, tested at 5 %: 1000 +- 31 alarms.
    int alarms = 0;
    for (std::uint64_t item = 0; item < 20000; ++item) {
        RunningStatistics statistics;
        RandomStream random(1, item, 0);
        for (int i = 0; i < 64; ++i)
            statistics.add(random.next());
        alarms += !agrees({statistics.mean(), std::sqrt(1.0 / 12 / 64)}, 0.5, 0.05);
    }
    EXPECT_NEAR(alarms, 1000, 5 * 31);
    EXPECT_FALSE(agrees({1.02, 0.0025}, 1));
    EXPECT_TRUE(agrees({1.01, 0.0025}, 1));
}

TEST(Statistics, CountsFarFromTheExpectedOnesAreRejectedAndRareCellsArePooled)
{
    EXPECT_LT(chi_square_probability({200, 100, 100}, {133, 133, 134}), 1e-6);
    // One count where 1e-3 is expected says nothing once the cell is pooled.
    EXPECT_GT(chi_square_probability({100, 100, 1}, {100, 100, 1e-3}), 0.9);
    EXPECT_EQ(chi_square_probability({10, 10}, {10, 10}), 1);
}
