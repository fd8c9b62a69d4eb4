#include "plugins/validation/measure.h"

#include "plugins/validation/refinement.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <ctime>
#include <map>
#include <numeric>

namespace lightwell {
namespace {

/// Student's t for a two-sided 95 % interval with 7 degrees of freedom: 8 replicates stand behind each value.
constexpr double t_95 = 2.365;
constexpr double detection_tolerance = 0.005, detection_error = 0.001;

/// Where a path ends in one of two ways, well-spread samples hit the share of each way to one sample, all replicates
/// alike: their spread says nothing about that step, which must be small by itself.
double least_samples(const Check& check, const ValidationOptions& options)
{
    if (check.view && check.exact)
        return 1 << 10;
    if (check.view)
        return options.full ? 1 << 19 : 1 << 16;
    return check.each.empty() ? 1 << 12 : 1 << 11;
}

/// Least relative standard error that is wanted.
double least_wanted(const std::vector<WantedQuantity>& quantities)
{
    double least = 1;
    for (const WantedQuantity& quantity : quantities)
        if (quantity.expected != 0)
            least = std::min(least, quantity.wanted / std::fabs(quantity.expected));
    return least;
}

WorkRange range_of(const Check& check, const std::vector<WantedQuantity>& quantities, const ValidationOptions& options)
{
    if (check.method == Method::usual) {
        // The accuracy asked for is that of the median place; the noisiest follow it more slowly than samples would.
        constexpr double coarsest = 0.1, pilot_part = 1.0 / 9, finest_part = 8, follow = 1;
        const double accuracy = std::min(coarsest, refinement_aim * least_wanted(quantities));
        const double least = 1 / (accuracy * accuracy);
        return {least * pilot_part, least, least * finest_part, follow, true};
    }
    // A mean over many sensors needs few samples at each.
    const double share =
        check.each.empty() ? static_cast<double>(std::bit_floor(std::max<std::size_t>(1, check.sensors.size()))) : 1;
    constexpr double fewest = 64, pilot_part = 1.0 / 16;
    constexpr double most_of_each = 1 << 21;
    const double most = !check.each.empty() ? most_of_each : options.full ? 1 << 26 : 1 << 22;
    const double least = std::max(least_samples(check, options) / share, fewest);
    // The error of well-spread samples falls as their number to the power of 0.5 to 0.8.
    constexpr double well_spread = 1.5;
    return {std::max(least * pilot_part, fewest), least, std::max(most / share, least), well_spread, false};
}

/// The engine asked for all or some quantities of one check.
class Probe {
public:
    Probe(const Simulation& simulation, const Check& check, std::uint64_t seed)
        : simulation_(simulation), check_(check), seed_(seed)
    {
    }

    /// Samples of no run are those of another.
    std::vector<MeasuredValue> measure(const std::vector<std::size_t>& which, double work)
    {
        // An odd number far from 0 keeps the runs' seeds apart from those of users, who count from 1.
        constexpr std::uint64_t apart = 0x9E3779B97F4A7C15;
        const std::uint64_t seed = seed_ + apart * runs_++;
        if (check_.view)
            return {of_view(static_cast<int>(work), seed)};
        return check_.each.empty() ? std::vector<MeasuredValue>{of_sum(work, seed)} : of_each(which, work, seed);
    }

private:
    GridSettings settings(double work, std::uint64_t seed) const
    {
        GridSettings settings;
        settings.seed = seed;
        settings.threads = 1; // the cases run side by side
        settings.unbiased = check_.method == Method::plain;
        if (settings.unbiased)
            settings.samples = static_cast<int>(work);
        else
            settings.accuracy = 1 / std::sqrt(work);
        return settings;
    }

    MeasuredValue of_view(int samples, std::uint64_t seed) const
    {
        PictureSettings settings;
        settings.width = settings.height = 1;
        settings.samples = samples;
        settings.seed = seed;
        settings.threads = 1;
        settings.unbiased = true;
        const Picture picture = simulation_.render(*check_.view, settings).picture;
        // All scenes are grey, so that one channel is the whole.
        return {lumens_per_watt * picture.at("G", 0, 0), lumens_per_watt * picture.at("error.G", 0, 0)};
    }

    std::vector<MeasuredValue> of_each(const std::vector<std::size_t>& which, double work, std::uint64_t seed) const
    {
        SensorGrid grid;
        for (const std::size_t i : which)
            grid.sensors.push_back(check_.sensors[i].sensor);
        const GridResult result = simulation_.illuminance(grid, settings(work, seed));
        std::vector<MeasuredValue> found;
        for (std::size_t k = 0; k < which.size(); ++k) {
            const double weight = check_.sensors[which[k]].weight;
            found.push_back({weight * result.values[k].value, weight * result.standard_errors[k].value});
        }
        return found;
    }

    MeasuredValue of_sum(double work, std::uint64_t seed) const
    {
        std::vector<std::size_t> all(check_.sensors.size());
        std::iota(all.begin(), all.end(), std::size_t{0});
        double value = 0, squares = 0;
        for (const MeasuredValue& part : of_each(all, work, seed)) {
            value += part.value;
            squares += part.error * part.error;
        }
        return {value, std::sqrt(squares)};
    }

    const Simulation& simulation_;
    const Check& check_;
    std::uint64_t seed_, runs_ = 0;
};

void refine(const Simulation& simulation, const Check& check, const ValidationOptions& options,
            std::vector<WantedQuantity>& quantities)
{
    Probe probe(simulation, check, options.seed);
    refine_by([&](const std::vector<std::size_t>& which, double work) { return probe.measure(which, work); },
              range_of(check, quantities, options), quantities);
}

/// Each sensor until it is known well enough; the row shows the one under most strain.
ValidationRow run_each(const Simulation& simulation, const Check& check, const ValidationOptions& options)
{
    std::vector<WantedQuantity> quantities;
    for (const double expected : check.each) {
        const double full = check.tolerance + check.tolerance_part * std::fabs(expected);
        const double tolerance = options.full ? full : std::max(full, check.quick_relative * std::fabs(expected));
        quantities.push_back({expected, tolerance, tolerance / 3});
    }
    refine(simulation, check, options, quantities);
    std::size_t worst = 0;
    bool fine = true;
    for (std::size_t i = 0; i < quantities.size(); ++i) {
        fine = fine && quantities[i].found.error <= quantities[i].wanted;
        if (quantities[i].strain() > quantities[worst].strain())
            worst = i;
    }
    const WantedQuantity& shown = quantities[worst];
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

namespace {

double thread_cpu_s()
{
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

ValidationRow run_one(const Simulation& simulation, const Check& check, const ValidationOptions& options)
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
    std::vector<WantedQuantity> quantities{{check.expected, row.tolerance, wanted}};
    refine(simulation, check, options, quantities);
    const MeasuredValue found = quantities[0].found;
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

} // namespace

ValidationRow run_check(const Simulation& simulation, const Check& check, const ValidationOptions& options)
{
    const double before_s = thread_cpu_s();
    ValidationRow row = check.each.empty() ? run_one(simulation, check, options) : run_each(simulation, check, options);
    row.cpu_s = thread_cpu_s() - before_s;
    return row;
}

} // namespace lightwell
