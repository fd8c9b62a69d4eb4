#include "engine/control/predict.h"

#include "engine/control/stage_clock.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>

namespace lightwell {
namespace {

/// As many sensors as tell the median error to a tenth; where sensors are so many that they share ambient light, as
/// many as still do.
constexpr std::size_t few_sensors = 64, sharing_sensors = 2000;
/// Where sensors share ambient light, its cost is taken to grow with the root of their number: assumed, not measured.
constexpr double usual_sharing_growth = 0.5;
/// The longer side of a pilot picture, and of the smaller one that tells how ambient light grows with the pixels.
constexpr int pilot_side = 96, smaller_side = 48;
/// Pilot runs begin at this many times the wanted accuracy; each further one is finer by a clear step.
constexpr double coarsest_pilot = 4, finer_step = 0.7;
constexpr std::size_t most_pilots = 3;
/// Coarser than this says nothing; finer is never reached.
constexpr double coarsest_accuracy = 0.5, finest_accuracy = 1e-4;
/// Bounds of exponents by accuracy, beyond which a fit is noise: work grows by the inverse square, independent
/// samples lower the error in step with the accuracy, well stratified ones up to twice as fast.
constexpr double steepest_work = -3, steepest_error = 2, flattest_error = 0.6;
/// With the fewest samples, only the rays behind ambient light grow: by the inverse of the accuracy.
constexpr double steepest_ambient_error = 0.6, usual_ambient_error = 0.5;
constexpr int fewest_samples = 8;
constexpr int most_samples = 1 << 20;

struct Outcome {
    int samples;
    double error;
};
/// Runs the simulation on the pilot's items.
using Work = std::function<Outcome(double accuracy, int samples, const Progress& progress)>;

PilotRun measure(const Work& work, double items, double accuracy, int samples, const Progress& progress)
{
    StageClock clock(progress);
    const Outcome outcome = work(accuracy, samples, clock.progress());
    clock.stop();
    PilotRun run{accuracy, items, static_cast<double>(outcome.samples), outcome.error, 0, 0, 0};
    run.ambient_s = clock.seconds("ambient light");
    run.fixed_s = clock.seconds("pilot run") + clock.seconds("check");
    run.per_sample_s = std::fmax(clock.total() - run.ambient_s - run.fixed_s, 0) / (items * run.samples);
    return run;
}

PowerLaw law(const PilotRun& before, const PilotRun& last, double PilotRun::*what, double low, double high,
             double usual)
{
    PowerLaw found{last.accuracy, last.*what, usual};
    if (before.accuracy > last.accuracy && before.*what > 0 && last.*what > 0)
        found.exponent =
            std::clamp(std::log(last.*what / before.*what) / std::log(last.accuracy / before.accuracy), low, high);
    return found;
}

/// A coarse run first, then the finest that the time allows, up to the wish itself.
std::vector<PilotRun> series(const Work& work, double items, double wanted, double pilot_s, const Progress& progress)
{
    const double coarse = std::fmax(wanted, std::fmin(coarsest_pilot * wanted, coarsest_accuracy));
    std::vector<PilotRun> runs{measure(work, items, coarse, 0, progress)};
    double spent = runs.back().seconds();
    while (runs.back().accuracy > wanted && runs.size() < most_pilots) {
        const double affordable = accuracy_within(fit(runs), items, pilot_s - spent);
        if (affordable > finer_step * runs.back().accuracy)
            break;
        runs.push_back(measure(work, items, std::fmax(affordable, wanted), 0, progress));
        spent += runs.back().seconds();
    }
    return runs;
}

Prediction predict_accuracy(const Work& work, double pilot_items, double all_items, double wanted, double pilot_s,
                            const Progress& progress)
{
    const std::vector<PilotRun> runs = series(work, pilot_items, wanted, pilot_s, progress);
    Prediction prediction;
    for (const PilotRun& run : runs)
        prediction.pilot_cpu_seconds += run.seconds();
    prediction.model = fit(runs);
    prediction.samples = static_cast<int>(std::lround(prediction.model.samples_at(wanted)));
    prediction.error = prediction.model.error_at(wanted);
    prediction.cpu_seconds = prediction.model.seconds(wanted, all_items);
    return prediction;
}

/// With the samples given: few of them first.
Prediction predict_samples(const Work& work, double pilot_items, double all_items, double accuracy, int samples,
                           double pilot_s, const Progress& progress)
{
    Prediction prediction;
    PilotRun first = measure(work, pilot_items, accuracy, std::min(fewest_samples, samples), progress), last = first;
    prediction.pilot_cpu_seconds = first.seconds();
    while (last.samples < samples && prediction.pilot_cpu_seconds + 4 * last.seconds() < pilot_s) {
        last = measure(work, pilot_items, accuracy, std::min(4 * static_cast<int>(last.samples), samples), progress);
        prediction.pilot_cpu_seconds += last.seconds();
    }
    double rate = 0.5; // of independent samples
    if (last.samples > first.samples && first.error > 0 && last.error > 0)
        rate = std::clamp(std::log(first.error / last.error) / std::log(last.samples / first.samples), 0.0, 0.75);
    prediction.model = fit({last});
    prediction.model.fewest_taken = false;
    prediction.model.samples = {accuracy, static_cast<double>(samples), 0};
    prediction.model.error = {accuracy, last.error * std::pow(last.samples / samples, rate), 0};
    prediction.samples = samples;
    prediction.error = prediction.model.error.value;
    prediction.cpu_seconds = prediction.model.seconds(accuracy, all_items);
    return prediction;
}

Prediction predict_work(const Work& work, double pilot_items, double all_items, double accuracy, int samples,
                        double pilot_s, const Progress& progress)
{
    return samples > 0 ? predict_samples(work, pilot_items, all_items, accuracy, samples, pilot_s, progress)
                       : predict_accuracy(work, pilot_items, all_items, accuracy, pilot_s, progress);
}

/// Evenly spread sensors, from the middle of their stretch.
SensorGrid thinned(const SensorGrid& grid)
{
    const std::size_t wanted = grid.sensors.size() < sharing_sensors ? few_sensors : sharing_sensors;
    if (grid.sensors.size() <= wanted)
        return grid;
    SensorGrid thin{grid.name, {}, 0, 0, {}, grid.spacing_m};
    for (std::size_t i = 0; i < wanted; ++i)
        thin.sensors.push_back(grid.sensors[(2 * i + 1) * grid.sensors.size() / (2 * wanted)]);
    return thin;
}

PictureSettings reduced(const PictureSettings& settings, int side)
{
    PictureSettings small = settings;
    small.region = {}; // its pixels rest on the pre-pass of the whole
    const int longer = std::max(settings.width, settings.height);
    if (longer > side) {
        small.width = std::max(1, settings.width * side / longer);
        small.height = std::max(1, settings.height * side / longer);
    }
    return small;
}

/// By what a cost grows with `further` times the pixels when it grew by `growth` with `known` times; at most in
/// proportion.
double continued(double growth, double known, double further)
{
    if (!(known > 1) || !(further > 1))
        return 1;
    return std::pow(further, std::clamp(std::log(growth) / std::log(known), 0.0, 1.0));
}

double pixels_of(const PictureSettings& settings)
{
    return static_cast<double>(settings.width) * settings.height;
}

} // namespace

double PowerLaw::operator()(double x) const noexcept
{
    return value * std::pow(x / at, exponent);
}

double CostModel::samples_at(double accuracy) const noexcept
{
    const double excess = fewest_taken ? std::fmax(error(accuracy) / accuracy, 1) : 1;
    return std::clamp(samples(accuracy) * excess * excess, static_cast<double>(fewest_samples),
                      static_cast<double>(most_samples));
}

double CostModel::error_at(double accuracy) const noexcept
{
    return fewest_taken ? std::fmin(error(accuracy), accuracy) : error(accuracy);
}

double CostModel::seconds(double accuracy, double items) const noexcept
{
    return ambient_s(accuracy) + fixed_s + per_sample_s * items * samples_at(accuracy);
}

CostModel fit(const std::vector<PilotRun>& runs) noexcept
{
    const PilotRun& last = runs.back();
    const PilotRun& before = runs[runs.size() > 1 ? runs.size() - 2 : 0];
    CostModel model;
    model.fewest_taken = last.samples <= fewest_samples;
    model.ambient_s = law(before, last, &PilotRun::ambient_s, steepest_work, 0, -1);
    model.samples = law(before, last, &PilotRun::samples, steepest_work, 0, model.fewest_taken ? 0 : -2);
    model.error = model.fewest_taken
                      ? law(before, last, &PilotRun::error, 0, steepest_ambient_error, usual_ambient_error)
                      : law(before, last, &PilotRun::error, flattest_error, steepest_error, 1);
    model.fixed_s = last.fixed_s;
    model.per_sample_s = last.per_sample_s;
    return model;
}

Prediction predict(const Simulation& simulation, const SensorGrid& grid, const GridSettings& settings, double pilot_s,
                   const Progress& progress)
{
    const SensorGrid thin = thinned(grid);
    const Work work = [&](double accuracy, int samples, const Progress& told) {
        GridSettings coarse = settings;
        coarse.accuracy = accuracy;
        coarse.samples = samples;
        coarse.ambient_file = {}; // would belong to another accuracy
        const GridResult result = simulation.illuminance(thin, coarse, told);
        return Outcome{result.samples, result.median_relative_error};
    };
    const auto few = static_cast<double>(thin.sensors.size()), all = static_cast<double>(grid.sensors.size());
    Prediction prediction = predict_work(work, few, all, settings.accuracy, settings.samples, pilot_s, progress);
    if (grid.sensors.size() > sharing_sensors) {
        prediction.model.ambient_s.value *= std::pow(all / few, usual_sharing_growth);
        prediction.cpu_seconds = prediction.model.seconds(settings.accuracy, all);
    }
    return prediction;
}

Prediction predict(const Simulation& simulation, const View& view, const PictureSettings& settings, double pilot_s,
                   const Progress& progress)
{
    const PictureSettings small = reduced(settings, pilot_side), smaller = reduced(settings, smaller_side);
    const auto work_of = [&](const PictureSettings& size) -> Work {
        return [&simulation, &view, size](double accuracy, int samples, const Progress& told) {
            PictureSettings coarse = size;
            coarse.accuracy = accuracy;
            coarse.samples = samples;
            coarse.ambient_file = {}; // would belong to another accuracy
            const PictureResult result = simulation.render(view, coarse, told);
            return Outcome{result.samples, result.median_relative_error};
        };
    };
    const Tile wanted = wanted_pixels(settings);
    const double pixels = static_cast<double>(wanted.width) * wanted.height;
    Prediction prediction =
        predict_work(work_of(small), pixels_of(small), pixels, settings.accuracy, settings.samples, pilot_s, progress);
    if (pixels_of(smaller) == pixels_of(settings))
        return prediction;
    // Ambient light costs more in the large picture, by a power of the pixels.
    CostModel& model = prediction.model;
    const PilotRun coarse = measure(work_of(smaller), pixels_of(smaller), model.ambient_s.at, fewest_samples, progress);
    prediction.pilot_cpu_seconds += coarse.seconds();
    if (coarse.ambient_s > 0 && model.ambient_s.value > 0)
        model.ambient_s.value *=
            continued(model.ambient_s.value / coarse.ambient_s, pixels_of(small) / pixels_of(smaller),
                      pixels_of(settings) / pixels_of(small));
    prediction.cpu_seconds = model.seconds(settings.accuracy, pixels);
    return prediction;
}

double accuracy_within(const CostModel& model, double items, double cpu_seconds) noexcept
{
    double fine = finest_accuracy, coarse = coarsest_accuracy;
    for (int step = 0; step < 50; ++step) {
        const double middle = std::sqrt(fine * coarse);
        (model.seconds(middle, items) > cpu_seconds ? fine : coarse) = middle;
    }
    return coarse;
}

double process_cpu_seconds() noexcept
{
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

} // namespace lightwell
