#pragma once

#include "engine/simulate/simulate.h"

#include <gtest/gtest.h>

namespace lightwell {

/// One sensor's illuminance with its standard error, lx.
struct Found {
    double value, error;
};

inline Found illuminance_at(const Simulation& simulation, const Sensor& sensor, int samples, std::uint64_t seed = 1,
                            bool unbiased = false)
{
    GridSettings settings;
    settings.samples = samples;
    settings.seed = seed;
    settings.unbiased = unbiased;
    SensorGrid grid;
    grid.sensors = {sensor};
    const GridResult result = simulation.illuminance(grid, settings);
    return {result.values[0].value, result.standard_errors[0].value};
}

/// Eight replicates give a t distribution with 7 degrees of freedom: beyond 13.9 standard errors with probability
/// 2.4e-6, a false alarm of the whole suite of some fifty such checks of about 1e-4.
inline constexpr double interval = 13.9;

/// The value agrees with the expected one, and was measured finely enough to notice a relative bias of `bias`.
/// @param errors  standard errors within which it must agree
inline void expect_agrees(const Found& found, double expected, double bias, double reference_error = 1e-9,
                          double errors = interval)
{
    EXPECT_NEAR(found.value, expected, errors * found.error + reference_error * std::fabs(expected));
    EXPECT_LE(errors * found.error, bias * std::fabs(expected)) << "too coarse to notice the bias it must catch";
}

/// Runs with seeds of their own, averaged: four have 28 degrees of freedom, for which the same false alarm of 2.4e-6
/// lies at 5.9 standard errors. For light whose noise falls slowly this is cheaper than more samples in one run.
inline constexpr std::uint64_t pooled_runs = 4;
inline constexpr double pooled_interval = 5.9;

inline Found pooled_illuminance_at(const Simulation& simulation, const Sensor& sensor, int samples_per_run,
                                   bool unbiased = false)
{
    double sum = 0, squares = 0;
    for (std::uint64_t seed = 1; seed <= pooled_runs; ++seed) {
        const Found found = illuminance_at(simulation, sensor, samples_per_run, seed, unbiased);
        sum += found.value;
        squares += found.error * found.error;
    }
    return {sum / pooled_runs, std::sqrt(squares) / pooled_runs};
}

} // namespace lightwell
