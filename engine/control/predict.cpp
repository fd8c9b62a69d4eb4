#include "engine/control/predict.h"

#include "engine/simulate/replicates.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>

namespace lightwell {
namespace {

/// As many sensors as tell the median error to a tenth.
constexpr std::size_t pilot_sensors = 64;
/// The longer side of a pilot picture: its pixels are a few thousand.
constexpr int pilot_pixels_a_side = 96;
/// Pilot runs begin at this many times the wanted accuracy and halve it while time is left.
constexpr double coarsest_pilot = 8;
/// Coarser than this says nothing.
constexpr double coarsest_accuracy = 0.5;
/// Independent samples 0.5; well stratified ones up to 0.75 (engine/sampling); beyond that the fit is noise.
constexpr double slowest_rate = 0.5, fastest_rate = 0.75;
constexpr int most_samples = 1 << 20;

struct Outcome {
    int samples;
    double error;
};
using Work = std::function<Outcome(double accuracy, int samples)>;

PilotRun measure(const Work& work, double items, double accuracy, int samples)
{
    const double start = process_cpu_seconds();
    const Outcome outcome = work(accuracy, samples);
    return {items, static_cast<double>(outcome.samples), outcome.error, process_cpu_seconds() - start};
}

/// Samples that a run for `wanted` will choose, from one that was asked for `accuracy`.
double samples_wanted(const PilotRun& run, double accuracy, double wanted) noexcept
{
    // Where the pilot took the fewest samples possible, its error says more than its wish.
    const double found = run.samples > replicates ? accuracy : std::fmax(run.error, wanted);
    return std::clamp(run.samples * found * found / (wanted * wanted), static_cast<double>(replicates),
                      static_cast<double>(most_samples));
}

/// Coarse runs first, each twice as accurate, until the wish itself or the end of the time.
Prediction predict_work(const Work& work, double pilot_items, double all_items, double wanted, int samples,
                        double pilot_s)
{
    std::vector<PilotRun> runs;
    Prediction prediction;
    double accuracy = std::fmax(wanted, std::fmin(coarsest_pilot * wanted, coarsest_accuracy));
    const double first_samples = std::fmin(replicates, samples);
    int n = static_cast<int>(first_samples);
    for (;;) {
        runs.push_back(measure(work, pilot_items, accuracy, samples > 0 ? n : 0));
        prediction.pilot_cpu_seconds += runs.back().cpu_seconds;
        prediction.model = fit(runs);
        const bool there = samples > 0 ? n >= samples : accuracy <= wanted;
        const double next = samples > 0 ? std::min(4 * n, samples)
                                        : samples_wanted(runs.back(), accuracy, std::fmax(wanted, accuracy / 2));
        if (there || prediction.pilot_cpu_seconds + prediction.model.seconds(pilot_items, next) > pilot_s)
            break;
        n = std::min(4 * n, samples);
        accuracy = std::fmax(wanted, accuracy / 2);
    }
    const double most = samples > 0 ? samples : samples_wanted(runs.back(), accuracy, wanted);
    prediction.samples = static_cast<int>(std::lround(most));
    prediction.cpu_seconds = prediction.model.seconds(all_items, most);
    prediction.error = prediction.model.error(most);
    return prediction;
}

/// Every n-th sensor, from the middle of its stretch.
SensorGrid thinned(const SensorGrid& grid)
{
    if (grid.sensors.size() <= pilot_sensors)
        return grid;
    SensorGrid thin{grid.name, {}, 0, 0, {}, grid.spacing_m};
    for (std::size_t i = 0; i < pilot_sensors; ++i)
        thin.sensors.push_back(grid.sensors[(2 * i + 1) * grid.sensors.size() / (2 * pilot_sensors)]);
    return thin;
}

} // namespace

double CostModel::seconds(double items, double samples) const noexcept
{
    return fixed_s + per_sample_s * items * samples;
}

double CostModel::error(double samples) const noexcept
{
    return error_at_one * std::pow(samples, -rate);
}

CostModel fit(const std::vector<PilotRun>& runs) noexcept
{
    CostModel model;
    const PilotRun& last = runs.back();
    const auto fewest = std::min_element(runs.begin(), runs.end(),
                                         [](const PilotRun& a, const PilotRun& b) { return a.samples < b.samples; });
    if (fewest->samples < last.samples) {
        model.per_sample_s = (last.cpu_seconds - fewest->cpu_seconds) / (last.samples - fewest->samples) / last.items;
        if (last.error > 0 && fewest->error > 0)
            model.rate = std::clamp(std::log(fewest->error / last.error) / std::log(last.samples / fewest->samples),
                                    slowest_rate, fastest_rate);
    }
    if (!(model.per_sample_s > 0))
        model.per_sample_s = last.cpu_seconds / (last.samples * last.items);
    model.fixed_s = std::fmax(0, last.cpu_seconds - model.per_sample_s * last.samples * last.items);
    model.error_at_one = last.error * std::pow(last.samples, model.rate);
    return model;
}

Prediction predict(const Simulation& simulation, const SensorGrid& grid, const GridSettings& settings, double pilot_s,
                   const Progress& progress)
{
    const SensorGrid thin = thinned(grid);
    const Work work = [&](double accuracy, int samples) {
        GridSettings coarse = settings;
        coarse.accuracy = accuracy;
        coarse.samples = samples;
        const GridResult result = simulation.illuminance(thin, coarse, progress);
        return Outcome{result.samples, result.median_relative_error};
    };
    return predict_work(work, static_cast<double>(thin.sensors.size()), static_cast<double>(grid.sensors.size()),
                        settings.accuracy, settings.samples, pilot_s);
}

Prediction predict(const Simulation& simulation, const View& view, const PictureSettings& settings, double pilot_s,
                   const Progress& progress)
{
    PictureSettings small = settings;
    const int longer = std::max(settings.width, settings.height);
    if (longer > pilot_pixels_a_side) {
        small.width = std::max(1, settings.width * pilot_pixels_a_side / longer);
        small.height = std::max(1, settings.height * pilot_pixels_a_side / longer);
    }
    const Work work = [&](double accuracy, int samples) {
        PictureSettings coarse = small;
        coarse.accuracy = accuracy;
        coarse.samples = samples;
        const PictureResult result = simulation.render(view, coarse, progress);
        return Outcome{result.samples, result.median_relative_error};
    };
    const auto pixels = [](const PictureSettings& s) { return static_cast<double>(s.width) * s.height; };
    return predict_work(work, pixels(small), pixels(settings), settings.accuracy, settings.samples, pilot_s);
}

double accuracy_within(const Prediction& prediction, double items, double cpu_seconds) noexcept
{
    const CostModel& model = prediction.model;
    const double samples = (cpu_seconds - model.fixed_s) / (model.per_sample_s * items);
    return model.error(std::clamp(samples, static_cast<double>(replicates), static_cast<double>(most_samples)));
}

double process_cpu_seconds() noexcept
{
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

} // namespace lightwell
