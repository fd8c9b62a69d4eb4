#pragma once

#include "engine/simulate/simulate.h"

#include <string>
#include <vector>

namespace lightwell {

/// One run on a part of the work: how many sensors or pixels, how well, and where its CPU time went.
struct PilotRun {
    double accuracy = 0;     ///< asked for
    double items = 0;        ///< sensors or pixels
    double samples = 0;      ///< of each
    double error = 0;        ///< median relative standard error reached
    double ambient_s = 0;    ///< for ambient light, before any value
    double fixed_s = 0;      ///< choosing the samples, checking the bias
    double per_sample_s = 0; ///< one sample of one sensor or pixel

    double seconds() const noexcept { return ambient_s + fixed_s + per_sample_s * items * samples; }
};

/// value * (x / at)^exponent.
struct PowerLaw {
    double at = 1, value = 0, exponent = 0;
    double operator()(double x) const noexcept;
};

/// Cost and error by accuracy, continued from the two last of a series of pilot runs, each more accurate.
struct CostModel {
    PowerLaw ambient_s, samples, error; ///< by accuracy; error with the samples that the last pilot run took, or with
                                        ///< those that bring it in step with the accuracy
    /// The last pilot run was content with the fewest samples possible: more are taken only from where the error would
    /// exceed the accuracy.
    bool fewest_taken = false;
    double fixed_s = 0, per_sample_s = 0;

    double samples_at(double accuracy) const noexcept;
    double error_at(double accuracy) const noexcept;
    /// @param items  sensors or pixels whose values are found; ambient light is that of the whole grid or view
    double seconds(double accuracy, double items) const noexcept;
};
/// @param runs  at least one, at one number of items
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
inline constexpr double usual_pilot_s = 2;

/// @throws InputError as the simulation does; Cancelled
Prediction predict(const Simulation& simulation, const SensorGrid& grid, const GridSettings& settings,
                   double pilot_s = usual_pilot_s, const Progress& progress = {});
Prediction predict(const Simulation& simulation, const View& view, const PictureSettings& settings,
                   double pilot_s = usual_pilot_s, const Progress& progress = {});

/// The accuracy to ask for so that a run takes this many CPU seconds; the coarsest useful one when even that takes
/// longer.
/// @param model  of the same grid or view
double accuracy_within(const CostModel& model, double items, double cpu_seconds) noexcept;

/// CPU seconds of this process so far, all threads.
double process_cpu_seconds() noexcept;

} // namespace lightwell
