#include "engine/control/work_count.h"

#include "engine/sampling/replicates.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

/// Share of the time that pilot runs may take, and the most, which is enough for any.
constexpr double pilot_share = 0.1, most_pilot_rays = 2 * usual_pilot_rays;
/// The first pilot runs lead to this accuracy; when the time is enough for finer ones, more follow from where it is.
constexpr double first_accuracy = 0.0625;
/// Runs stay a little below the time asked for: predictions err to both sides.
constexpr double used_share = 0.9;
constexpr int most_samples = 1 << 20;

double two_digits(double x)
{
    const double step = std::pow(10.0, std::floor(std::log10(x)) - 1);
    const double digits = std::round(x / step);
    // Divided by a whole power of ten, so that the number is the one that "0.013" reads as.
    return step < 1 ? digits / std::round(1 / step) : digits * step;
}

template <class Item, class Settings>
WorkCount fill(double cpu_seconds, const Simulation& simulation, const Item& item, Settings settings, double items,
               const Progress& progress)
{
    const double pilot_rays = std::min(pilot_share * cpu_seconds * usual_rays_a_second, most_pilot_rays);
    settings.samples = 0;
    settings.accuracy = first_accuracy;
    Prediction found = predict(simulation, item, settings, pilot_rays / 2, progress);
    StageCost spent = found.pilot;
    const double reachable = work_of(found, items, cpu_seconds - spent.seconds).accuracy;
    if (reachable < first_accuracy / 2 && spent.rays < pilot_rays) {
        settings.accuracy = reachable;
        found = predict(simulation, item, settings, pilot_rays - spent.rays, progress);
        spent = {spent.rays + found.pilot.rays, spent.seconds + found.pilot.seconds};
    }
    WorkCount work = work_of(found, items, cpu_seconds - spent.seconds);
    work.cpu_seconds += spent.seconds;
    work.prediction.pilot = spent;
    return work;
}

} // namespace

WorkCount work_of(const Prediction& prediction, double items, double cpu_seconds)
{
    const CostModel& model = prediction.model;
    const double available = used_share * std::max(cpu_seconds, 0.0);
    WorkCount work;
    work.accuracy = two_digits(accuracy_within(model, items, available));
    const double left = available - model.ambient_s(work.accuracy) - model.fixed.seconds;
    const double samples = model.sample.seconds > 0 ? left / (model.sample.seconds * items) : 0;
    work.samples =
        static_cast<int>(std::clamp(samples, double{replicates}, double{most_samples})) / replicates * replicates;
    const double taken = items * static_cast<double>(work.samples);
    work.cpu_seconds = model.ambient_s(work.accuracy) + model.fixed.seconds + model.sample.seconds * taken;
    work.prediction = prediction;
    work.prediction.rays = model.ambient_rays(work.accuracy) + model.fixed.rays + model.sample.rays * taken;
    work.prediction.samples = work.samples;
    work.prediction.cpu_seconds = work.cpu_seconds;
    work.prediction.error = model.error_at(work.accuracy);
    return work;
}

WorkCount work_within(double cpu_seconds, const Simulation& simulation, const SensorGrid& grid,
                      const GridSettings& settings, const Progress& progress)
{
    return fill(cpu_seconds, simulation, grid, settings, static_cast<double>(grid.sensors.size()), progress);
}

WorkCount work_within(double cpu_seconds, const Simulation& simulation, const View& view,
                      const PictureSettings& settings, const Progress& progress)
{
    const Tile wanted = wanted_pixels(settings);
    return fill(cpu_seconds, simulation, view, settings, static_cast<double>(wanted.width) * wanted.height, progress);
}

} // namespace lightwell
