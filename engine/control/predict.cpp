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
/// The longer side of a pilot picture.
constexpr int pilot_side = 96;
/// A second size tells how the cost grows with the work: sensors that share light in so many times the number, pictures
/// with so many times smaller sides.
constexpr int second_size = 2;
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
    WorkCounts work;
};
/// The simulation on some of the sensors or pixels.
struct Excerpt {
    double items;
    std::function<Outcome(double accuracy, int samples, const Progress& progress)> run;
};

PilotRun measure(const Excerpt& excerpt, double accuracy, int samples, const Progress& progress)
{
    StageClock clock(progress);
    const Outcome outcome = excerpt.run(accuracy, samples, clock.progress());
    clock.stop();
    const auto rays = [](const RayCounts& counts) { return static_cast<double>(counts.total()); };
    PilotRun run{accuracy, excerpt.items, static_cast<double>(outcome.samples), outcome.error, {}, {}, {}};
    run.ambient = {rays(outcome.work.ambient_rays), clock.seconds("ambient light")};
    // Values go on from what a first look has followed: of the time beside ambient light, each has its share by rays.
    const double rest_s = std::fmax(clock.total() - run.ambient.seconds, 0);
    const double fixed_rays = rays(outcome.work.fixed_rays), value_rays = rays(outcome.work.value_rays);
    const double fixed_share = fixed_rays / std::fmax(fixed_rays + value_rays, 1);
    run.fixed = {fixed_rays, rest_s * fixed_share};
    run.values = {value_rays, rest_s * (1 - fixed_share)};
    return run;
}

void count(Prediction& prediction, const PilotRun& run)
{
    prediction.pilot.rays += run.rays();
    prediction.pilot.seconds += run.seconds();
}

/// Through two values, unless they lie at the same place.
PowerLaw law(double before_at, double before, double last_at, double last, double low, double high, double usual)
{
    PowerLaw found{last_at, last, usual};
    if (before_at > last_at && before > 0 && last > 0)
        found.exponent = std::clamp(std::log(last / before) / std::log(last_at / before_at), low, high);
    return found;
}

/// The accuracy at which a cost that falls with it comes down to the limit.
double accuracy_for(const std::function<double(double accuracy)>& cost, double limit)
{
    double fine = finest_accuracy, coarse = coarsest_accuracy;
    for (int step = 0; step < 50; ++step) {
        const double middle = std::sqrt(fine * coarse);
        (cost(middle) > limit ? fine : coarse) = middle;
    }
    return coarse;
}

/// A coarse run first, then the finest that the limit allows, up to the wish itself.
std::vector<PilotRun> series(const Excerpt& excerpt, double wanted, double pilot_rays, const Progress& progress)
{
    const double coarse = std::fmax(wanted, std::fmin(coarsest_pilot * wanted, coarsest_accuracy));
    std::vector<PilotRun> runs{measure(excerpt, coarse, 0, progress)};
    double left = pilot_rays - runs.back().rays();
    while (runs.back().accuracy > wanted && runs.size() < most_pilots) {
        const CostModel model = fit(runs);
        const double affordable =
            accuracy_for([&](double accuracy) { return model.rays(accuracy, excerpt.items); }, left);
        if (affordable > finer_step * runs.back().accuracy)
            break;
        runs.push_back(measure(excerpt, std::fmax(affordable, wanted), 0, progress));
        left -= runs.back().rays();
    }
    return runs;
}

/// What is wanted, and what finding out may take.
struct Wish {
    double accuracy;
    int samples;  ///< 0: those that the accuracy takes
    double items; ///< sensors or pixels of the whole
    double pilot_rays;
};

struct Found {
    Prediction prediction;
    PilotRun last; ///< the finest of the pilot runs
};

Found predict_accuracy(const Excerpt& excerpt, const Wish& wish, const Progress& progress)
{
    Prediction prediction;
    const std::vector<PilotRun> runs = series(excerpt, wish.accuracy, wish.pilot_rays, progress);
    for (const PilotRun& run : runs)
        count(prediction, run);
    prediction.model = fit(runs);
    prediction.samples = static_cast<int>(std::lround(prediction.model.samples_at(wish.accuracy)));
    prediction.error = prediction.model.error_at(wish.accuracy);
    return {prediction, runs.back()};
}

/// With the samples given: few of them first.
Found predict_samples(const Excerpt& excerpt, const Wish& wish, const Progress& progress)
{
    Prediction prediction;
    const PilotRun first = measure(excerpt, wish.accuracy, std::min(fewest_samples, wish.samples), progress);
    PilotRun last = first;
    count(prediction, first);
    while (last.samples < wish.samples && prediction.pilot.rays + 4 * last.rays() < wish.pilot_rays) {
        last = measure(excerpt, wish.accuracy, std::min(4 * static_cast<int>(last.samples), wish.samples), progress);
        count(prediction, last);
    }
    double rate = 0.5; // of independent samples
    if (last.samples > first.samples && first.error > 0 && last.error > 0)
        rate = std::clamp(std::log(first.error / last.error) / std::log(last.samples / first.samples), 0.0, 0.75);
    prediction.model = fit({last});
    prediction.model.fewest_taken = false;
    prediction.model.samples = {wish.accuracy, static_cast<double>(wish.samples), 0};
    prediction.model.error = {wish.accuracy, last.error * std::pow(last.samples / wish.samples, rate), 0};
    prediction.samples = wish.samples;
    prediction.error = prediction.model.error.value;
    return {prediction, last};
}

Found predict_work(const Excerpt& excerpt, const Wish& wish, const Progress& progress)
{
    return wish.samples > 0 ? predict_samples(excerpt, wish, progress) : predict_accuracy(excerpt, wish, progress);
}

void set_cost(Prediction& prediction, const Wish& wish)
{
    prediction.rays = prediction.model.rays(wish.accuracy, wish.items);
    prediction.cpu_seconds = prediction.model.seconds(wish.accuracy, wish.items);
}

/// The rays of a stage at the wanted size, when they are a power of the size: at most in proportion to it.
double grown(const StageCost& few, double few_items, const StageCost& many, double many_items, double wanted_items)
{
    if (!(few.rays > 0 && many.rays > 0 && many_items > few_items))
        return many.rays;
    const double power = std::clamp(std::log(many.rays / few.rays) / std::log(many_items / few_items), 0.0, 1.0);
    return many.rays * std::pow(wanted_items / many_items, power);
}

/// What a sample of a pixel takes in a picture of any size: where neighbours agree, pixels between them have none of
/// their own, and where they differ, along edges, their share falls with the inverse of the side.
double at_side(double small, double small_side, double large, double large_side, double wanted_side)
{
    const double edges = (small - large) / (1 / small_side - 1 / large_side);
    const double inside = large - edges / large_side;
    constexpr double least_own = 0.25; // of the pixels have samples of their own
    return std::clamp(inside + edges / wanted_side, least_own * large, std::fmax(small, large));
}

/// Evenly spread sensors, from the middle of their stretch.
SensorGrid thinned(const SensorGrid& grid, std::size_t wanted)
{
    if (grid.sensors.size() <= wanted)
        return grid;
    SensorGrid thin{grid.name, {}, 0, 0, {}, grid.spacing_m};
    for (std::size_t i = 0; i < wanted; ++i)
        thin.sensors.push_back(grid.sensors[(2 * i + 1) * grid.sensors.size() / (2 * wanted)]);
    return thin;
}

int longer_side(const PictureSettings& settings)
{
    return std::max(settings.width, settings.height);
}

PictureSettings reduced(const PictureSettings& settings, int side)
{
    PictureSettings small = settings;
    small.region = {}; // its pixels rest on the pre-pass of the whole
    const int longer = longer_side(settings);
    if (longer > side) {
        small.width = std::max(1, settings.width * side / longer);
        small.height = std::max(1, settings.height * side / longer);
    }
    return small;
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

double CostModel::rays(double accuracy, double items) const noexcept
{
    return ambient_rays(accuracy) + fixed.rays + sample.rays * items * samples_at(accuracy);
}

double CostModel::seconds(double accuracy, double items) const noexcept
{
    return ambient_s(accuracy) + fixed.seconds + sample.seconds * items * samples_at(accuracy);
}

CostModel fit(const std::vector<PilotRun>& runs) noexcept
{
    const PilotRun& last = runs.back();
    const PilotRun& before = runs[runs.size() > 1 ? runs.size() - 2 : 0];
    const auto by_accuracy = [&](double before_value, double last_value, double low, double high, double usual) {
        return law(before.accuracy, before_value, last.accuracy, last_value, low, high, usual);
    };
    CostModel model;
    model.fewest_taken = last.samples <= fewest_samples;
    model.ambient_rays = by_accuracy(before.ambient.rays, last.ambient.rays, steepest_work, 0, -1);
    model.samples = by_accuracy(before.samples, last.samples, steepest_work, 0, model.fewest_taken ? 0 : -2);
    model.error = model.fewest_taken
                      ? by_accuracy(before.error, last.error, 0, steepest_ambient_error, usual_ambient_error)
                      : by_accuracy(before.error, last.error, flattest_error, steepest_error, 1);
    model.fixed = last.fixed;
    // What a ray takes is told best by all of them together.
    StageCost ambient, values;
    for (const PilotRun& run : runs) {
        ambient = {ambient.rays + run.ambient.rays, ambient.seconds + run.ambient.seconds};
        values = {values.rays + run.items * run.samples, values.seconds + run.values.seconds};
    }
    model.ambient_s_per_ray = ambient.rays > 0 ? ambient.seconds / ambient.rays : 0;
    model.sample = {last.values.rays / (last.items * last.samples), values.seconds / values.rays};
    return model;
}

Prediction predict(const Simulation& simulation, const SensorGrid& grid, const GridSettings& settings,
                   double pilot_rays, const Progress& progress)
{
    const auto excerpt_of = [&](std::size_t count) -> Excerpt {
        SensorGrid thin = thinned(grid, count);
        return {static_cast<double>(thin.sensors.size()),
                [&simulation, settings, thin](double accuracy, int samples, const Progress& told) {
                    GridSettings coarse = settings;
                    coarse.accuracy = accuracy;
                    coarse.samples = samples;
                    coarse.ambient_file = {}; // would belong to another accuracy
                    const GridResult result = simulation.illuminance(thin, coarse, told);
                    return Outcome{result.samples, result.median_relative_error, result.work};
                }};
    };
    const bool sharing = grid.sensors.size() > sharing_sensors;
    const Wish wish{settings.accuracy, settings.samples, static_cast<double>(grid.sensors.size()), pilot_rays};
    const Excerpt excerpt = excerpt_of(grid.sensors.size() < sharing_sensors ? few_sensors : sharing_sensors);
    Prediction prediction = predict_work(excerpt, wish, progress).prediction;
    if (sharing) { // ambient light costs more for all of them
        PowerLaw& ambient = prediction.model.ambient_rays;
        const Excerpt larger = excerpt_of(second_size * sharing_sensors);
        const PilotRun wide = measure(larger, ambient.at, fewest_samples, progress);
        count(prediction, wide);
        ambient.value = grown({ambient.value, 0}, excerpt.items, wide.ambient, larger.items, wish.items);
    }
    set_cost(prediction, wish);
    return prediction;
}

Prediction predict(const Simulation& simulation, const View& view, const PictureSettings& settings, double pilot_rays,
                   const Progress& progress)
{
    const PictureSettings small = reduced(settings, pilot_side), smaller = reduced(settings, pilot_side / second_size);
    const auto excerpt_of = [&](const PictureSettings& size) -> Excerpt {
        return {pixels_of(size), [&simulation, &view, size](double accuracy, int samples, const Progress& told) {
                    PictureSettings coarse = size;
                    coarse.accuracy = accuracy;
                    coarse.samples = samples;
                    coarse.ambient_file = {}; // would belong to another accuracy
                    const PictureResult result = simulation.render(view, coarse, told);
                    return Outcome{result.samples, result.median_relative_error, result.work};
                }};
    };
    const Tile wanted = wanted_pixels(settings);
    const Wish wish{settings.accuracy, settings.samples, static_cast<double>(wanted.width) * wanted.height, pilot_rays};
    auto [prediction, last] = predict_work(excerpt_of(small), wish, progress);
    if (pixels_of(smaller) < pixels_of(settings)) {
        CostModel& model = prediction.model;
        PowerLaw& ambient = model.ambient_rays;
        const PilotRun coarse = measure(excerpt_of(smaller), last.accuracy, static_cast<int>(last.samples), progress);
        count(prediction, coarse);
        ambient.value =
            grown(coarse.ambient, pixels_of(smaller), {ambient.value, 0}, pixels_of(small), pixels_of(settings));
        const double before = model.sample.rays;
        model.sample.rays = at_side(coarse.values.rays / (coarse.items * coarse.samples), longer_side(smaller), before,
                                    longer_side(small), longer_side(settings));
        model.sample.seconds *= before > 0 ? model.sample.rays / before : 1;
    }
    set_cost(prediction, wish);
    return prediction;
}

double accuracy_within(const CostModel& model, double items, double cpu_seconds) noexcept
{
    return accuracy_for([&](double accuracy) { return model.seconds(accuracy, items); }, cpu_seconds);
}

double process_cpu_seconds() noexcept
{
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

} // namespace lightwell
