#include "engine/sampling/warps.h"
#include "engine/simulate/ambient_build.h"
#include "engine/simulate/sensor_task.h"

#include <algorithm>

namespace lightwell {
namespace {

constexpr std::size_t pilot_sensors = 64;
constexpr int pilot_paths = 8 * pilot_samples;
/// From this number on, sensors share records of ambient light.
constexpr std::size_t many_sensors = 2000;
/// Sensors checked against plain path tracing.
constexpr std::size_t checked_sensors = 32;

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
        const std::size_t count = task_.places.size();
        const MeasuredSensors some = measure_sensors(task_, samples, every_of(step_for(count, pilot_sensors), count),
                                                     threads_, teller_, same_paths);
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
    const std::size_t count = plain.places.size();
    const std::vector<std::size_t> sensors = every_of(step_for(count, checked_sensors), count);
    const auto checked = [&](int paths) {
        const MeasuredSensors checks = measure_sensors(plain, paths, sensors, threads, teller);
        std::vector<Checked> points;
        for (std::size_t k = 0; k < sensors.size(); ++k)
            points.push_back({result.values[sensors[k]].value, checks.values[k], checks.errors[k],
                              plain.places[sensors[k]].position});
        return points;
    };
    const double all_paths = static_cast<double>(result.samples) * static_cast<double>(plain.places.size());
    const BiasCheck check = check_bias(checked, result.median_relative_error, {all_paths, result.work.rays()});
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
    MeasuredSensors all =
        measure_sensors(task, result.samples, every_of(1, receivers.size()), settings.threads, teller);
    result.work = ambient.work();
    result.work.ambient_rays = ambient_rays;
    result.work.fixed_rays = fixed_rays;
    result.work.value_rays = rays.next();
    for (std::size_t i = 0; i < receivers.size(); ++i) {
        result.values.push_back(Illuminance{all.values[i]});
        result.standard_errors.push_back(Illuminance{all.errors[i]});
    }
    result.mean_standard_error = Illuminance{all.mean_error()};
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
