#include "engine/base/threads.h"
#include "engine/sampling/statistics.h"
#include "engine/sampling/warps.h"
#include "engine/simulate/ambient_build.h"
#include "engine/simulate/replicates.h"

#include <algorithm>

namespace lightwell {
namespace {

constexpr std::size_t pilot_sensors = 64;
constexpr int pilot_paths = 8 * pilot_samples;
/// From this number on, sensors share records of ambient light.
constexpr std::size_t many_sensors = 2000;
/// Sensors checked against plain path tracing.
constexpr std::size_t checked_sensors = 32;

/// Keeps the random numbers of direct light and of rays apart.
constexpr std::uint64_t direct_salt = 0x64697265;
/// Rays of ambient light to one test of the lamps: their light is found exactly where nothing is half hidden.
constexpr std::uint32_t rays_a_test = 16;

struct SensorTask {
    const PathTracer& tracer;
    const std::vector<SurfacePlace>& places;
    std::uint64_t seed;
    const DeepField* deep; ///< null: plain paths, or records of the cache
    std::optional<Spectrum> only_direct =
        {}; ///< irradiance beside that of lamps and suns, W/m^2, where no other is wanted

    /// Illuminance of a sensor, lx, by replicate.
    /// @param same_paths  all replicates follow the same paths, so that only their ambient light differs
    std::array<double, replicates> operator()(std::size_t i, int samples, bool same_paths) const
    {
        std::array<double, replicates> found{};
        const auto each = static_cast<std::uint32_t>(samples / replicates);
        for (int r = 0; r < replicates; ++r) {
            const std::uint64_t key = mix_bits(seed, static_cast<std::uint64_t>(same_paths ? 0 : r));
            const Spectrum irradiance = only_direct       ? direct(i, key, each).irradiance + *only_direct
                                        : deep != nullptr ? by_hemisphere(i, r, key, each)
                                                          : by_paths(i, r, key, each);
            found[static_cast<std::size_t>(r)] = illuminance_of(irradiance).value;
        }
        return found;
    }

private:
    struct Direct {
        Spectrum irradiance;
        double lamp_share = 0; ///< of the hemisphere, cosine-weighted
    };
    Direct direct(std::size_t i, std::uint64_t key, std::uint32_t tests) const
    {
        Direct sum;
        for (std::uint32_t n = 0; n < tests; ++n) {
            PathRandom random(mix_bits(key, direct_salt), i, n);
            const DirectIrradiance found = tracer.sensor_direct(places[i], random);
            sum.irradiance += (found.lamps + found.suns) / tests;
            sum.lamp_share += found.lamp_share / tests;
        }
        return sum;
    }
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
        const Direct tested = direct(i, key, std::max(1u, count / rays_a_test));
        Spectrum ambient;
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
        return tested.irradiance +
               (others > 0 ? ambient * ((1 - std::min(1.0, tested.lamp_share)) / others) : Spectrum{});
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
Some measure_some(const SensorTask& task, int samples, std::size_t step, int threads, Teller& teller,
                  bool same_paths = false)
{
    const std::size_t count = (task.places.size() + step - 1) / step;
    Some some{std::vector<double>(count), std::vector<double>(count)};
    std::vector<std::array<double, replicates>> found(count);
    parallel_for(count, threads, [&](std::size_t k) {
        teller.check();
        found[k] = task(k * step, samples, same_paths);
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

/// Paths start at a sensor, upwards with the cosine, as its light arrives.
AmbientBuild::Start from_sensors(const std::vector<SurfacePlace>& receivers)
{
    return [&receivers](std::size_t i, PathRandom& random, Ray& ray) {
        const Direction local = cosine_hemisphere(random.pair());
        const Direction direction = frame_about(receivers[i].normal).to_world(local);
        ray = {receivers[i].position + receivers[i].normal * receivers[i].error_m, direction, infinity};
        return true;
    };
}

/// Sensors a metre apart may be a centimetre apart from a neighbouring surface that is dark, and each is a number that
/// someone reads: records have the reach that their light allows, without a least one.
void add_records(AmbientBuild& ambient, const std::vector<SurfacePlace>& receivers)
{
    for (std::size_t step = 64;; step /= 4) {
        std::vector<AmbientCandidate> candidates;
        for (std::size_t i = step / 2; i < receivers.size(); i += step)
            candidates.push_back({receivers[i], 0});
        ambient.grow(candidates);
        if (step == 1)
            return ambient.complete();
    }
}

/// Some of the sensors, looked at before all of them.
class PilotRun {
public:
    PilotRun(const SensorTask& task, int threads, const Progress& progress, const std::string& grid)
        : task_(task), threads_(threads), teller_(progress, "pilot run, grid " + grid, pilot_sensors)
    {
    }
    double shared_error() { return error_with(pilot_paths / same_paths_share, true); }
    /// Far beyond what was looked at, a further look tells how errors really fall.
    int samples_for(double shared, double accuracy)
    {
        constexpr int times = 4;
        int looked_at = pilot_paths;
        double with_fewer = error_with(looked_at / times, false);
        for (;; looked_at *= times) {
            const double found = error_with(looked_at, false);
            const PilotErrors pilot = pilot_errors(found, looked_at, shared, with_fewer, looked_at / times);
            const int samples = lightwell::samples_for(pilot, accuracy, most_samples);
            if (samples <= times * looked_at)
                return samples;
            with_fewer = found;
        }
    }

private:
    double error_with(int samples, bool same_paths)
    {
        const std::size_t step = step_for(task_.places.size(), pilot_sensors);
        const Some some = measure_some(task_, samples, step, threads_, teller_, same_paths);
        return median_relative(some.values, some.errors);
    }
    const SensorTask& task_;
    int threads_;
    Teller teller_;
};

/// Sensors meet many places of the deep field, so that few rays a site often serve; where its error shows in the pilot
/// run it gets more, by what that error says.
constexpr double first_deep = 2;                       // times the accuracy: how far its sites are apart
constexpr double coarsest_deep = 0.05;                 // coarser ones cost about the same
constexpr double most_work = 64;                       // times the rays of its first look
constexpr double most_shared = 1, wished_shared = 0.9; // times the accuracy

double more_work(double work, double shared, double accuracy)
{
    constexpr double most_times = 16;
    const double excess = shared / (wished_shared * accuracy);
    return std::min(most_work, work * std::clamp(excess * excess, 2.0, most_times));
}

/// Adds the bias to expect of each value, by plain path tracing at a few sensors.
void add_bias(GridResult& result, const SensorTask& plain, int threads, Teller& teller)
{
    const std::size_t step = step_for(plain.places.size(), checked_sensors);
    const auto measure = [&](int paths) {
        const Some checks = measure_some(plain, paths, step, threads, teller);
        std::vector<Checked> points;
        for (std::size_t k = 0; k < checks.values.size(); ++k)
            points.push_back(
                {result.values[k * step].value, checks.values[k], checks.errors[k], plain.places[k * step].position});
        return points;
    };
    const double all_paths = static_cast<double>(result.samples) * static_cast<double>(plain.places.size());
    const BiasCheck check = check_bias(measure, result.median_relative_error, {all_paths, result.work.rays()});
    result.bias = check.whole;
    const LocalBias local(check.whole, check.points);
    for (std::size_t i = 0; i < plain.places.size(); ++i)
        result.biases.push_back(Illuminance{local.at(plain.places[i].position, result.values[i].value)});
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
    const std::optional<AmbientLimit>& limit = parts_->preparation.ambient_limit;
    const bool plain =
        settings.unbiased || !settings.techniques.deep_field || limit || parts_->plan.needs.only_direct();
    const bool own_field = !plain && !techniques.cache && settings.ambient_file.file.empty();
    AmbientEffort effort = effort_of(settings);
    if (own_field)
        effort.set_deep(std::min(first_deep * settings.accuracy, coarsest_deep));
    double work = effort.deep.work;
    AmbientBuild ambient(*parts_, effort, techniques, stop_when_asked(progress),
                         plain ? "" : settings.ambient_file.file);
    RayLaps rays;
    RayCounts ambient_rays, fixed_rays;
    if (!plain) {
        progress.tell("ambient light, grid " + grid.name, 0);
        ambient.build_deep(receivers.size(), from_sensors(receivers));
        if (techniques.cache)
            add_records(ambient, receivers);
        ambient_rays += rays.next();
    }
    SensorTask task{plain ? parts_->tracer : ambient.tracer(), receivers, settings.seed,
                    plain || techniques.cache ? nullptr : &ambient.deep()};
    if (!settings.unbiased && (limit ? limit->bounces == 0 : parts_->plan.needs.only_direct()))
        task.only_direct = limit ? limit->radiance * pi : Spectrum{};
    result.samples = whole_replicates(settings.samples);
    PilotRun pilot(task, settings.threads, progress, grid.name);
    double shared = plain || (!own_field && settings.samples > 0) ? 0 : pilot.shared_error();
    while (own_field && shared > most_shared * settings.accuracy && work < most_work) {
        work = more_work(work, shared, settings.accuracy);
        fixed_rays += rays.next();
        ambient.refine_deep(work);
        ambient_rays += rays.next();
        shared = pilot.shared_error();
    }
    if (settings.samples <= 0)
        result.samples = pilot.samples_for(shared, settings.accuracy);
    fixed_rays += rays.next();
    Teller teller(progress, "grid " + grid.name, receivers.size());
    const Some all = measure_some(task, result.samples, 1, settings.threads, teller);
    result.work = ambient.work();
    result.work.ambient_rays = ambient_rays;
    result.work.fixed_rays = fixed_rays;
    result.work.value_rays = rays.next();
    for (std::size_t i = 0; i < receivers.size(); ++i) {
        result.values.push_back(Illuminance{all.values[i]});
        result.standard_errors.push_back(Illuminance{all.errors[i]});
    }
    result.mean_standard_error = Illuminance{all.mean_error};
    result.median_relative_error = median_relative(all.values, all.errors);
    if (!plain || task.only_direct) {
        Teller check(progress, "check, grid " + grid.name, checked_sensors);
        add_bias(result, {parts_->tracer, receivers, mix_bits(settings.seed), nullptr}, settings.threads, check);
    }
    result.work.fixed_rays += rays.next();
    result.report = ambient.report();
    result.seconds = seconds_since(start);
    return result;
}

} // namespace lightwell
