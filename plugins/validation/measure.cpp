#include "plugins/validation/measure.h"

#include <algorithm>
#include <bit>

namespace lightwell {
namespace {

/// Student's t for a two-sided 95 % interval with 7 degrees of freedom: 8 replicates stand behind each value.
constexpr double t_95 = 2.365;
constexpr double detection_tolerance = 0.005, detection_error = 0.001;
/// The standard error is itself known to a quarter only: the next attempt aims lower than is asked.
constexpr double aim = 0.8;

struct Measurement {
    double value, error;
};

Measurement measure_sensors(const Simulation& simulation, const Check& check, int samples, std::uint64_t seed)
{
    GridSettings settings;
    settings.samples = samples;
    settings.seed = seed;
    settings.threads = 1; // the cases run side by side
    settings.unbiased = true;
    SensorGrid grid;
    for (const WeightedSensor& s : check.sensors)
        grid.sensors.push_back(s.sensor);
    const GridResult result = simulation.illuminance(grid, settings);
    double value = 0, squares = 0;
    for (std::size_t i = 0; i < check.sensors.size(); ++i) {
        value += check.sensors[i].weight * result.values[i].value;
        squares += std::pow(check.sensors[i].weight * result.standard_errors[i].value, 2);
    }
    return {value, std::sqrt(squares)};
}

Measurement measure_view(const Simulation& simulation, const Check& check, int samples, std::uint64_t seed)
{
    PictureSettings settings;
    settings.width = settings.height = 1;
    settings.samples = samples;
    settings.seed = seed;
    settings.threads = 1;
    settings.unbiased = true;
    const Picture picture = simulation.render(*check.view, settings).picture;
    // All scenes are grey, so that one channel is the whole.
    return {lumens_per_watt * picture.at("G", 0, 0), lumens_per_watt * picture.at("error.G", 0, 0)};
}

Measurement measure(const Simulation& simulation, const Check& check, int samples, std::uint64_t seed)
{
    return check.view ? measure_view(simulation, check, samples, seed)
                      : measure_sensors(simulation, check, samples, seed);
}

/// Where a path ends in one of two ways, well-spread samples hit the share of each way to one sample, all replicates
/// alike: their spread says nothing about that step, which must be small by itself.
int first_samples(const Check& check, const ValidationOptions& options)
{
    if (check.view)
        return options.full ? 1 << 19 : 1 << 16;
    return 1 << 12;
}

/// More samples until the standard error is as wanted, or too dear.
Measurement refine(const Simulation& simulation, const Check& check, double wanted_error,
                   const ValidationOptions& options)
{
    // A mean over many sensors needs few samples at each.
    const int share = static_cast<int>(std::bit_floor(std::max<std::size_t>(1, check.sensors.size())));
    const int most = std::max((options.full ? 1 << 26 : 1 << 22) / share, 64);
    int samples = std::max(first_samples(check, options) / share, 64);
    for (;;) {
        const Measurement found = measure(simulation, check, samples, options.seed);
        if (found.error <= wanted_error || samples >= most)
            return found;
        const double ratio = found.error / (aim * wanted_error);
        const double wanted = samples * std::clamp(ratio * ratio, 2.0, 64.0);
        samples = static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::min<double>(wanted, most))));
    }
}

} // namespace

ValidationRow run_check(const Simulation& simulation, const Check& check, const ValidationOptions& options)
{
    ValidationRow row;
    row.quantity = check.quantity;
    row.unit = check.unit;
    row.expected = check.expected;
    row.detection = check.detection;
    row.tolerance = check.tolerance;
    const double size = std::fabs(check.expected);
    if (check.detection)
        row.tolerance = std::max(check.tolerance, detection_tolerance * size);
    else if (!options.full)
        row.tolerance = std::max(check.tolerance, check.quick_relative * size);
    const double affordable = row.tolerance / 3;
    const double wanted = check.detection && options.full ? std::min(affordable, detection_error * size) : affordable;
    const Measurement found = refine(simulation, check, wanted, options);
    row.found = found.value;
    row.half_width_95 = t_95 * found.error;
    const bool fine = found.error <= affordable;
    const bool agrees = std::fabs(row.deviation()) <= row.tolerance + 3 * found.error;
    row.passed = fine && agrees;
    if (!agrees)
        row.reason = "deviates";
    else if (!fine)
        row.reason = "too noisy to tell";
    return row;
}

} // namespace lightwell
