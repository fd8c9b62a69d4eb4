#pragma once

#include "engine/simulate/simulate.h"

#include <string>
#include <vector>

namespace lightwell {

/// What a stage of a run took. Rays are the same each time and on every machine; seconds are not.
struct StageCost {
    double rays = 0, seconds = 0; ///< CPU seconds
};

/// One run on a part of the work: how many sensors or pixels, how well, and what its stages took.
struct PilotRun {
    double accuracy = 0; ///< asked for
    double items = 0;    ///< sensors or pixels
    double samples = 0;  ///< of each
    double error = 0;    ///< median relative standard error reached
    StageCost ambient;   ///< for ambient light, before any value
    StageCost fixed;     ///< choosing the samples, checking the bias
    StageCost values;    ///< all samples of all items

    double rays() const noexcept { return ambient.rays + fixed.rays + values.rays; }
    double seconds() const noexcept { return ambient.seconds + fixed.seconds + values.seconds; }
};

/// value * (x / at)^exponent.
struct PowerLaw {
    double at = 1, value = 0, exponent = 0;
    double operator()(double x) const noexcept;
};

/// Cost and error by accuracy, continued from the two last of a series of pilot runs, each more accurate.
struct CostModel {
    PowerLaw ambient_rays, samples, error; ///< by accuracy; error with the samples that the last pilot run took, or
                                           ///< with those that bring it in step with the accuracy
    /// The last pilot run was content with the fewest samples possible: more are taken only from where the error would
    /// exceed the accuracy.
    bool fewest_taken = false;
    double ambient_s_per_ray = 0;
    StageCost fixed;
    StageCost sample; ///< one sample of one sensor or pixel

    double samples_at(double accuracy) const noexcept;
    double error_at(double accuracy) const noexcept;
    double ambient_s(double accuracy) const noexcept { return ambient_rays(accuracy) * ambient_s_per_ray; }
    /// @param items  sensors or pixels whose values are found; ambient light is that of the whole grid or view
    double rays(double accuracy, double items) const noexcept;
    double seconds(double accuracy, double items) const noexcept;
};
/// @param runs  at least one, at one number of items
CostModel fit(const std::vector<PilotRun>& runs) noexcept;

/// What a run is expected to take and to reach.
struct Prediction {
    double rays = 0; ///< of all stages: WorkCounts::rays()
    double cpu_seconds = 0;
    double error = 0; ///< median relative standard error
    int samples = 0;
    StageCost pilot; ///< what it took to find out
    CostModel model;
};

/// What pilot runs may take at most, roughly. In rays, so that a prediction is the same each time but for the seconds
/// that a ray takes.
inline constexpr double usual_pilot_rays = 2e6;
/// Rays of a CPU second in a scene of no special kind, within a factor of 3: for deciding what a pilot run may take.
inline constexpr double usual_rays_a_second = 1e6;

/// @throws InputError as the simulation does; Cancelled
Prediction predict(const Simulation& simulation, const SensorGrid& grid, const GridSettings& settings,
                   double pilot_rays = usual_pilot_rays, const Progress& progress = {});
Prediction predict(const Simulation& simulation, const View& view, const PictureSettings& settings,
                   double pilot_rays = usual_pilot_rays, const Progress& progress = {});

/// The accuracy to ask for so that a run takes this many CPU seconds; the coarsest useful one when even that takes
/// longer.
/// @param model  of the same grid or view
double accuracy_within(const CostModel& model, double items, double cpu_seconds) noexcept;

/// CPU seconds of this process so far, all threads.
double process_cpu_seconds() noexcept;

} // namespace lightwell
