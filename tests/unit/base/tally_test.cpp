#include "engine/base/tally.h"
#include "engine/base/threads.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace lightwell {
namespace {

TEST(RayCounts, OfALoopAreTheSameForAnyNumberOfThreads)
{
    for (const int threads : {1, 2, 4}) {
        RayLaps laps;
        parallel_for(1000, threads, [](std::size_t i) {
            rays_of_thread.followed += i;
            rays_of_thread.shadow += 2;
        });
        EXPECT_EQ(laps.next(), (RayCounts{999 * 1000 / 2, 2000})) << threads << " threads";
        EXPECT_EQ(laps.next(), RayCounts{}) << "each lap begins where the last one ended";
    }
}

TEST(RayCounts, OfALoopWithinALoopCountOnce)
{
    RayLaps laps;
    parallel_for(10, 2, [](std::size_t) {
        ++rays_of_thread.followed;
        parallel_for(10, 2, [](std::size_t) { ++rays_of_thread.shadow; });
    });
    EXPECT_EQ(laps.next(), (RayCounts{10, 100}));
}

TEST(RayCounts, SurviveALoopThatThrows)
{
    const auto throwing = [](std::size_t i) {
        ++rays_of_thread.followed;
        if (i == 3)
            throw std::runtime_error("stop");
    };
    EXPECT_THROW(parallel_for(8, 2, throwing), std::runtime_error);
    RayLaps laps;
    parallel_for(5, 2, [](std::size_t) { ++rays_of_thread.followed; });
    EXPECT_EQ(laps.next(), (RayCounts{5, 0}));
}

} // namespace
} // namespace lightwell
