#include "engine/base/duration.h"
#include "engine/control/work_count.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

/// Ambient light costs 0.02 / accuracy seconds, a sample 1e-6 s; 0.04 / accuracy^2 samples reach the accuracy.
Prediction made_up()
{
    Prediction prediction;
    prediction.model.ambient_rays = {0.04, 5e5, -1};
    prediction.model.ambient_s_per_ray = 1e-6;
    prediction.model.samples = {0.04, 25, -2};
    prediction.model.error = {0.04, 0.04, 1};
    prediction.model.sample = {2, 1e-6};
    prediction.model.fixed = {2e5, 0.25};
    return prediction;
}

TEST(WorkCount, FillsTheTimeButForATenth)
{
    for (const double seconds : {3.0, 10.0, 100.0}) {
        const WorkCount work = work_of(made_up(), 10000, seconds);
        EXPECT_LE(work.cpu_seconds, 0.9 * seconds * (1 + 1e-9));
        EXPECT_GT(work.cpu_seconds, 0.8 * seconds);
        EXPECT_EQ(work.samples % 8, 0);
    }
}

TEST(WorkCount, MoreTimeBuysBothBetterAmbientLightAndMoreSamples)
{
    const WorkCount little = work_of(made_up(), 10000, 4), much = work_of(made_up(), 10000, 100);
    EXPECT_LT(much.accuracy, 0.5 * little.accuracy);
    EXPECT_GT(much.samples, 4 * little.samples);
}

TEST(WorkCount, AccuracyHasTwoDigitsSoThatItReadsBackTheSame)
{
    for (const double seconds : {2.0, 7.0, 31.0, 1000.0}) {
        const double accuracy = work_of(made_up(), 10000, seconds).accuracy;
        char text[32];
        std::snprintf(text, sizeof text, "%.1e", accuracy);
        EXPECT_EQ(std::stod(text), accuracy) << text;
    }
}

TEST(WorkCount, TooLittleTimeStillMakesTheCoarsestResult)
{
    for (const double seconds : {0.0, -1.0, 1e-6}) {
        const WorkCount work = work_of(made_up(), 10000, seconds);
        EXPECT_EQ(work.samples, 8);
        EXPECT_GT(work.accuracy, 0.1);
        EXPECT_LT(work.accuracy, 1);
    }
}

TEST(Duration, IsReadWithItsUnit)
{
    EXPECT_EQ(parse_duration("60s"), 60);
    EXPECT_EQ(parse_duration("0.5s"), 0.5);
    EXPECT_EQ(parse_duration("5min"), 300);
    EXPECT_EQ(parse_duration("2h"), 7200);
    EXPECT_EQ(parse_duration("12"), 12);
    for (const char* bad : {"", "s", "0s", "-1s", "nan", "inf", "1e400", "5 s", "5d", "60ss", "2026-03-21T12:00+01:00"})
        EXPECT_FALSE(parse_duration(bad)) << bad;
}

} // namespace
} // namespace lightwell
