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

/// How much work: samples, or with ambient light kept in between, an accuracy.
struct Work {
    int samples = 0;
    double accuracy = 0;
};

GridSettings grid_settings(const Work& work, std::uint64_t seed)
{
    GridSettings settings;
    settings.samples = work.samples;
    settings.seed = seed;
    settings.threads = 1; // the cases run side by side
    settings.unbiased = work.accuracy <= 0;
    if (work.accuracy > 0)
        settings.accuracy = work.accuracy;
    return settings;
}

Measurement measure_sensors(const Simulation& simulation, const Check& check, const Work& work, std::uint64_t seed)
{
    SensorGrid grid;
    for (const WeightedSensor& s : check.sensors)
        grid.sensors.push_back(s.sensor);
    const GridResult result = simulation.illuminance(grid, grid_settings(work, seed));
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
                      : measure_sensors(simulation, check, {samples}, seed);
}

/// Where a path ends in one of two ways, well-spread samples hit the share of each way to one sample, all replicates
/// alike: their spread says nothing about that step, which must be small by itself.
int first_samples(const Check& check, const ValidationOptions& options)
{
    if (check.view && check.exact)
        return 1 << 10;
    if (check.view)
        return options.full ? 1 << 19 : 1 << 16;
    return 1 << 12;
}

/// To a power of two; where samples are many, and their number costs minutes, also to one and a half of one.
int round_up(unsigned samples)
{
    constexpr unsigned many = 1U << 19;
    const unsigned whole = std::bit_ceil(samples), less = whole / 4 * 3;
    return static_cast<int>(samples > many && less >= samples ? less : whole);
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
        samples = round_up(static_cast<unsigned>(std::min<double>(wanted, most)));
    }
}

/// The engine as it is used, asked for more until its standard error is as wanted.
Measurement refine_usual(const Simulation& simulation, const Check& check, double wanted_error,
                         const ValidationOptions& options)
{
    constexpr int most_tries = 5;
    double accuracy = std::min(0.1, aim * wanted_error / std::fabs(check.expected));
    for (int attempt = 1;; ++attempt) {
        const Measurement found = measure_sensors(simulation, check, {0, accuracy}, options.seed);
        if (found.error <= wanted_error || attempt == most_tries)
            return found;
        accuracy *= std::min(0.5, aim * wanted_error / found.error);
    }
}

/// One sensor of a check of each.
struct Single {
    double expected, tolerance, wanted;
    Measurement found{0, infinity};
    double allowed() const { return tolerance + 3 * found.error; }
    /// 1 and more: does not agree.
    double strain() const { return std::fabs(found.value - expected) / allowed(); }
};

/// All those that are not known well enough yet, with one work for all.
void measure_again(const Simulation& simulation, const Check& check, const Work& work, std::uint64_t seed,
                   std::vector<Single>& singles)
{
    SensorGrid grid;
    std::vector<std::size_t> which;
    for (std::size_t i = 0; i < singles.size(); ++i)
        if (!(singles[i].found.error <= singles[i].wanted)) {
            grid.sensors.push_back(check.sensors[i].sensor);
            which.push_back(i);
        }
    if (which.empty())
        return;
    const GridResult result = simulation.illuminance(grid, grid_settings(work, seed));
    for (std::size_t k = 0; k < which.size(); ++k) {
        const double weight = check.sensors[which[k]].weight;
        singles[which[k]].found = {weight * result.values[k].value, weight * result.standard_errors[k].value};
    }
}

/// Largest standard error in units of the wanted one.
double noisiest(const std::vector<Single>& singles)
{
    double ratio = 0;
    for (const Single& single : singles)
        ratio = std::max(ratio, single.found.error / single.wanted);
    return ratio;
}

/// Least relative standard error that is wanted.
double least_wanted(const std::vector<Single>& singles)
{
    double least = 1;
    for (const Single& single : singles)
        if (single.expected != 0)
            least = std::min(least, single.wanted / std::fabs(single.expected));
    return least;
}

/// How many times as many samples the noisiest of them asks for: the error of well-spread samples falls about as their
/// number to the power of 0.8.
int more_samples(const std::vector<Single>& singles)
{
    constexpr double samples_per_error = 1.25;
    constexpr double most = 16;
    const double wanted = std::clamp(std::pow(noisiest(singles) / aim, samples_per_error), 2.0, most);
    return static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::ceil(wanted))));
}

/// Each sensor until it is known well enough; the row shows the one under most strain.
ValidationRow run_each(const Simulation& simulation, const Check& check, const ValidationOptions& options)
{
    std::vector<Single> singles;
    for (const double expected : check.each) {
        const double full = check.tolerance + check.tolerance_part * std::fabs(expected);
        const double tolerance = options.full ? full : std::max(full, check.quick_relative * std::fabs(expected));
        singles.push_back({expected, tolerance, tolerance / 3});
    }
    if (check.method == Method::usual) {
        constexpr int most_tries = 5;
        double accuracy = aim * least_wanted(singles);
        for (int attempt = 1; attempt <= most_tries; ++attempt) {
            measure_again(simulation, check, {0, accuracy}, options.seed, singles);
            accuracy *= std::clamp(aim / noisiest(singles), 0.3, 0.8);
        }
    } else {
        constexpr int first = 1 << 9, most = 1 << 21;
        for (int samples = first; samples <= most; samples *= more_samples(singles))
            measure_again(simulation, check, {samples}, options.seed, singles);
    }
    std::size_t worst = 0;
    bool fine = true;
    for (std::size_t i = 0; i < singles.size(); ++i) {
        fine = fine && singles[i].found.error <= singles[i].wanted;
        if (singles[i].strain() > singles[worst].strain())
            worst = i;
    }
    const Single& shown = singles[worst];
    ValidationRow row;
    row.quantity = check.quantity + ", worst: " + check.names[worst];
    row.unit = check.unit;
    row.expected = shown.expected;
    row.tolerance = shown.tolerance;
    row.found = shown.found.value;
    row.half_width_95 = t_95 * shown.found.error;
    row.passed = fine && shown.strain() <= 1;
    row.reason = shown.strain() > 1 ? "deviates" : fine ? "" : "too noisy to tell";
    return row;
}

} // namespace

ValidationRow run_check(const Simulation& simulation, const Check& check, const ValidationOptions& options)
{
    if (!check.each.empty())
        return run_each(simulation, check, options);
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
    const Measurement found = check.method == Method::usual ? refine_usual(simulation, check, wanted, options)
                                                            : refine(simulation, check, wanted, options);
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
