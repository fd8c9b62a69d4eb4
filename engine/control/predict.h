#pragma once

#include "engine/simulate/simulate.h"

#include <string>
#include <vector>

namespace lightwell {

/// One run on a small part of the work: how many sensors or pixels, how well, at what cost.
struct PilotRun {
    double items = 0;   ///< sensors or pixels
    double samples = 0; ///< of each
    double error = 0;   ///< median relative standard error
    double cpu_seconds = 0;
};

/// Cost and error as functions of the samples, fitted to pilot runs: seconds = fixed + per_sample * items * samples,
/// error = error_at_one * samples^-rate.
struct CostModel {
    double fixed_s = 0, per_sample_s = 0;
    double error_at_one = 0, rate = 0.5;

    double seconds(double items, double samples) const noexcept;
    double error(double samples) const noexcept;
};
/// @param runs  at least one; of two with different samples the rate of the error is found, within what stratified
///              samples can do
CostModel fit(const std::vector<PilotRun>& runs) noexcept;

/// What a run is expected to take and to reach.
struct Prediction {
    double cpu_seconds = 0;
    double error = 0; ///< median relative standard error
    int samples = 0;
    double pilot_cpu_seconds = 0; ///< what it took to find out
    CostModel model;
};

/// What pilot runs may take at most, roughly, CPU seconds.
inline constexpr double usual_pilot_s = 1;

/// @throws InputError as the simulation does; Cancelled
Prediction predict(const Simulation& simulation, const SensorGrid& grid, const GridSettings& settings,
                   double pilot_s = usual_pilot_s, const Progress& progress = {});
Prediction predict(const Simulation& simulation, const View& view, const PictureSettings& settings,
                   double pilot_s = usual_pilot_s, const Progress& progress = {});

/// The accuracy that a number of CPU seconds buys; the model of a prediction for the same grid or view.
double accuracy_within(const Prediction& prediction, double items, double cpu_seconds) noexcept;

/// CPU seconds of this process so far, all threads.
double process_cpu_seconds() noexcept;

} // namespace lightwell
