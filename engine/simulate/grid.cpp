#include "engine/base/threads.h"
#include "engine/sampling/statistics.h"
#include "engine/sampling/warps.h"
#include "engine/simulate/ambient_build.h"
#include "engine/simulate/replicates.h"

#include <algorithm>

namespace lightwell {
namespace {

/// A sensor that lies in a surface is lifted off it by this share of the scene's size.
constexpr double sensor_lift = 1e-9;
constexpr std::size_t pilot_sensors = 64;
constexpr int pilot_paths = 16 * pilot_samples;
/// From this number on, sensors share records of ambient light.
constexpr std::size_t many_sensors = 2000;
/// Sensors checked against plain path tracing, and paths at each.
constexpr std::size_t checked_sensors = 32;
constexpr int check_paths = 16 * replicates;

SurfacePlace receiver_of(const Sensor& sensor, double size_m)
{
    const double error = sensor_lift * size_m + 64 * std::numeric_limits<double>::epsilon() * max_abs(sensor.position);
    return {sensor.position, normalized(sensor.normal), error};
}

/// Keeps the random numbers of direct light and of rays apart.
constexpr std::uint64_t direct_salt = 0x64697265;
/// Rays of ambient light to one test of the lamps: their light is found exactly where nothing is half hidden.
constexpr std::uint32_t rays_a_test = 16;

struct SensorTask {
    const PathTracer& tracer;
    const std::vector<SurfacePlace>& places;
    std::uint64_t seed;
    const DeepField* deep; ///< null: plain paths, or records of the cache

    /// Illuminance of a sensor, lx, by replicate.
    std::array<double, replicates> operator()(std::size_t i, int samples) const
    {
        std::array<double, replicates> found{};
        const auto each = static_cast<std::uint32_t>(samples / replicates);
        for (int r = 0; r < replicates; ++r) {
            const std::uint64_t key = mix_bits(seed, static_cast<std::uint64_t>(r));
            found[static_cast<std::size_t>(r)] =
                illuminance_of(deep != nullptr ? by_hemisphere(i, r, key, each) : by_paths(i, r, key, each)).value;
        }
        return found;
    }

private:
    Spectrum by_paths(std::size_t i, int replicate, std::uint64_t key, std::uint32_t count) const
    {
        Spectrum sum;
        for (std::uint32_t n = 0; n < count; ++n) {
            PathRandom random(key, i, n);
            sum += tracer.irradiance(places[i], replicate, random);
        }
        return sum / count;
    }
    Spectrum by_hemisphere(std::size_t i, int replicate, std::uint64_t key, std::uint32_t count) const
    {
        const std::uint32_t tests = std::max(1u, count / rays_a_test);
        Spectrum direct, ambient;
        double lamp_share = 0;
        for (std::uint32_t n = 0; n < tests; ++n) {
            PathRandom random(mix_bits(key, direct_salt), i, n);
            const DirectIrradiance found = tracer.sensor_direct(places[i], random);
            direct += (found.lamps + found.suns) / tests;
            lamp_share += found.lamp_share / tests;
        }
        const Frame frame = frame_about(places[i].normal);
        std::vector<Dependence> dependences;
        std::uint32_t others = 0;
        for (std::uint32_t n = 0; n < count; ++n) {
            PathRandom random(key, i, n);
            const Direction direction = hemisphere_direction(frame, random.pair());
            dependences.clear();
            const Arrival arrival = tracer.arrive(places[i], direction, random, dependences);
            ambient += arrival.irradiance + deep->sum(dependences, replicate);
            others += arrival.met_lamp ? 0 : 1;
        }
        // How much of the hemisphere shows lamps is known better from the shadow rays than from these.
        return direct + (others > 0 ? ambient * ((1 - std::min(1.0, lamp_share)) / others) : Spectrum{});
    }
};

RunningStatistics statistics_of(const std::array<double, replicates>& values)
{
    RunningStatistics statistics;
    for (const double value : values)
        statistics.add(value);
    return statistics;
}

/// Every step-th sensor, from the first.
struct Some {
    std::vector<double> values, errors;
    double mean_error = 0; ///< of the mean over the sensors, which share their ambient light
};
Some measure_some(const SensorTask& task, int samples, std::size_t step, int threads, Teller& teller)
{
    const std::size_t count = (task.places.size() + step - 1) / step;
    Some some{std::vector<double>(count), std::vector<double>(count)};
    std::vector<std::array<double, replicates>> found(count);
    parallel_for(count, threads, [&](std::size_t k) {
        teller.check();
        found[k] = task(k * step, samples);
        const RunningStatistics statistics = statistics_of(found[k]);
        some.values[k] = statistics.mean();
        some.errors[k] = statistics.standard_error();
        teller.done_one();
    });
    std::array<double, replicates> means{};
    for (const auto& sensor : found)
        for (std::size_t r = 0; r < replicates; ++r)
            means[r] += sensor[r] / static_cast<double>(count);
    some.mean_error = statistics_of(means).standard_error();
    return some;
}

std::size_t step_for(std::size_t sensors, std::size_t wanted)
{
    return std::max<std::size_t>(1, sensors / wanted);
}

void build(AmbientBuild& ambient, const std::vector<SurfacePlace>& receivers, bool cached, double footprint_m)
{
    // Paths start at a sensor, upwards with the cosine, as its light arrives.
    ambient.build_deep(receivers.size(), [&](std::size_t i, PathRandom& random, Ray& ray) {
        const Direction local = cosine_hemisphere(random.pair());
        const Direction direction = frame_about(receivers[i].normal).to_world(local);
        ray = {receivers[i].position + receivers[i].normal * receivers[i].error_m, direction, infinity};
        return true;
    });
    if (!cached)
        return;
    for (std::size_t step = 64;; step /= 4) {
        std::vector<AmbientCandidate> candidates;
        for (std::size_t i = step / 2; i < receivers.size(); i += step)
            candidates.push_back({receivers[i], footprint_m});
        ambient.grow(candidates);
        if (step == 1)
            return;
    }
}

} // namespace

GridResult Simulation::illuminance(const SensorGrid& grid, const GridSettings& settings, const Progress& progress) const
{
    const auto start = std::chrono::steady_clock::now();
    check_accuracy(settings.accuracy, "grid " + grid.name);
    std::vector<SurfacePlace> receivers;
    for (const Sensor& sensor : grid.sensors)
        receivers.push_back(receiver_of(sensor, parts_->box.diagonal()));
    GridResult result;
    if (receivers.empty())
        return result;
    Techniques techniques = settings.techniques;
    techniques.cache = techniques.cache && receivers.size() >= many_sensors;
    const bool plain = settings.unbiased || !settings.techniques.deep_field;
    AmbientBuild ambient(*parts_, effort_of(settings), techniques, stop_when_asked(progress),
                         plain ? "" : settings.ambient_file.file);
    if (!plain) {
        progress.tell("ambient light, grid " + grid.name, 0);
        build(ambient, receivers, techniques.cache, grid.spacing_m);
    }
    const SensorTask task{plain ? parts_->tracer : ambient.tracer(), receivers, settings.seed,
                          plain || techniques.cache ? nullptr : &ambient.deep()};
    result.samples = whole_replicates(settings.samples);
    if (settings.samples <= 0) {
        Teller teller(progress, "pilot run, grid " + grid.name, pilot_sensors);
        const Some some =
            measure_some(task, pilot_paths, step_for(receivers.size(), pilot_sensors), settings.threads, teller);
        result.samples = samples_for(median_relative(some.values, some.errors), pilot_paths, settings.accuracy,
                                     most_samples, plain ? 0.5 : 1);
    }
    Teller teller(progress, "grid " + grid.name, receivers.size());
    const Some all = measure_some(task, result.samples, 1, settings.threads, teller);
    for (std::size_t i = 0; i < receivers.size(); ++i) {
        result.values.push_back(Illuminance{all.values[i]});
        result.standard_errors.push_back(Illuminance{all.errors[i]});
    }
    result.mean_standard_error = Illuminance{all.mean_error};
    result.median_relative_error = median_relative(all.values, all.errors);
    if (!plain) {
        const std::size_t step = step_for(receivers.size(), checked_sensors);
        Teller check(progress, "check, grid " + grid.name, checked_sensors);
        const SensorTask plain_task{parts_->tracer, receivers, mix_bits(settings.seed), nullptr};
        const Some checks = measure_some(plain_task, check_paths, step, settings.threads, check);
        std::vector<Checked> points;
        for (std::size_t k = 0; k < checks.values.size(); ++k)
            points.push_back({all.values[k * step], checks.values[k], checks.errors[k]});
        result.bias = bias_of(points);
    }
    result.work = ambient.work();
    result.report = ambient.report();
    result.seconds = seconds_since(start);
    return result;
}

} // namespace lightwell
