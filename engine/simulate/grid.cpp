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
        : task_(task), threads_(threads), teller_(progress, "pilot run, grid " + grid, pilot_sensors),
          step_(step_for(task.places.size(), pilot_sensors)), begun_(step_, task.places.size())
    {
    }
    double shared_error() { return error_with(pilot_paths / same_paths_share, true); }
    /// What samples_for() has followed, to be gone on with.
    BegunSensors& begun() noexcept { return begun_; }
    /// Samples of each of its sensors.
    int looked_at() const noexcept { return looked_at_; }
    /// Far beyond what was looked at, a further look tells how errors really fall.
    int samples_for(double shared, double accuracy)
    {
        constexpr int times = 4;
        double with_fewer = error_with(pilot_paths / times, false);
        for (looked_at_ = pilot_paths;; looked_at_ *= times) {
            const double found = error_with(looked_at_, false);
            const PilotErrors pilot = pilot_errors(found, looked_at_, shared, with_fewer, looked_at_ / times);
            const int samples = lightwell::samples_for(pilot, accuracy, most_samples);
            if (samples <= times * looked_at_)
                return samples;
            with_fewer = found;
        }
    }

private:
    double error_with(int samples, bool same_paths)
    {
        const MeasuredSensors some = measure_sensors(task_, samples, every_of(step_, task_.places.size()), threads_,
                                                     teller_, same_paths ? nullptr : &begun_, same_paths);
        return median_relative(some.values, some.errors);
    }
    const SensorTask& task_;
    int threads_;
    Teller teller_;
    std::size_t step_;
    BegunSensors begun_;
    int looked_at_ = 0;
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

/// One grid, from ambient light to the check.
class GridRun {
public:
    GridRun(const SimulationParts& parts, const SensorGrid& grid, const GridSettings& settings,
            const Progress& progress)
        : parts_(parts), grid_(grid), settings_(settings), progress_(progress)
    {
        for (const Sensor& sensor : grid.sensors)
            receivers_.push_back(receiver_of(sensor, parts.box.diagonal()));
        techniques_.cache = techniques_.cache && receivers_.size() >= many_sensors;
    }
    GridResult run();

private:
    bool limited() const { return parts_.preparation.ambient_limit.has_value(); }
    bool only_direct() const
    {
        const std::optional<AmbientLimit>& limit = parts_.preparation.ambient_limit;
        return !settings_.unbiased && (limit ? limit->bounces == 0 : parts_.plan.needs.only_direct());
    }
    bool plain() const
    {
        return settings_.unbiased || !techniques_.deep_field || limited() || parts_.plan.needs.only_direct();
    }
    /// The deep field serves this grid alone, so that its work can follow what it shows.
    bool own_field() const { return !plain() && !techniques_.cache && settings_.ambient_file.file.empty(); }
    AmbientEffort effort() const
    {
        AmbientEffort effort = effort_of(settings_);
        if (own_field())
            effort.set_deep(std::min(first_deep * settings_.accuracy, coarsest_deep));
        return effort;
    }
    SensorTask task_with(const AmbientBuild& ambient) const
    {
        SensorTask task{plain() ? parts_.tracer : ambient.tracer(), receivers_, settings_.seed,
                        plain() || techniques_.cache ? nullptr : &ambient.deep()};
        if (only_direct())
            task.only_direct = limited() ? parts_.preparation.ambient_limit->radiance * pi : Spectrum{};
        return task;
    }
    void build(AmbientBuild& ambient);
    double refine(AmbientBuild& ambient, PilotRun& pilot, double work);
    void measure(const SensorTask& task, PilotRun& pilot);
    void check();

    const SimulationParts& parts_;
    const SensorGrid& grid_;
    const GridSettings& settings_;
    const Progress& progress_;
    std::vector<SurfacePlace> receivers_;
    Techniques techniques_ = settings_.techniques;
    RayLaps rays_;
    RayCounts ambient_rays_, fixed_rays_;
    GridResult result_;
};

void GridRun::build(AmbientBuild& ambient)
{
    progress_.tell("ambient light, grid " + grid_.name, 0);
    ambient.build_deep(receivers_.size(), from_sensors(receivers_));
    if (techniques_.cache)
        add_records(ambient, receivers_);
    ambient_rays_ += rays_.next();
}

/// @return  the error that more samples would not lower
double GridRun::refine(AmbientBuild& ambient, PilotRun& pilot, double work)
{
    if (plain() || (!own_field() && settings_.samples > 0))
        return 0;
    double shared = pilot.shared_error();
    while (own_field() && shared > most_shared * settings_.accuracy && work < most_work) {
        work = more_work(work, shared, settings_.accuracy);
        fixed_rays_ += rays_.next();
        ambient.refine_deep(work);
        ambient_rays_ += rays_.next();
        shared = pilot.shared_error();
    }
    return shared;
}

void GridRun::measure(const SensorTask& task, PilotRun& pilot)
{
    Teller teller(progress_, "grid " + grid_.name, receivers_.size());
    MeasuredSensors all = measure_sensors(task, result_.samples, every_of(1, receivers_.size()), settings_.threads,
                                          teller, &pilot.begun());
    for (std::size_t i = 0; i < receivers_.size(); ++i) {
        result_.values.push_back(Illuminance{all.values[i]});
        result_.standard_errors.push_back(Illuminance{all.errors[i]});
    }
    result_.mean_standard_error = Illuminance{all.mean_error()};
    result_.median_relative_error = median_relative(all.values, all.errors);
}

void GridRun::check()
{
    Teller teller(progress_, "check, grid " + grid_.name, checked_sensors);
    add_bias(result_, {parts_.tracer, receivers_, mix_bits(settings_.seed), nullptr}, settings_.threads, teller);
    fixed_rays_ += rays_.next();
}

GridResult GridRun::run()
{
    if (receivers_.empty())
        return {};
    const AmbientEffort effort = this->effort();
    AmbientBuild ambient(parts_, effort, techniques_, stop_when_asked(progress_),
                         plain() ? "" : settings_.ambient_file.file);
    if (!plain())
        build(ambient);
    const SensorTask task = task_with(ambient);
    PilotRun pilot(task, settings_.threads, progress_, grid_.name);
    const double shared = refine(ambient, pilot, effort.deep.work);
    fixed_rays_ += rays_.next();
    result_.samples =
        settings_.samples > 0 ? whole_replicates(settings_.samples) : pilot.samples_for(shared, settings_.accuracy);
    RayCounts value_rays;
    // A first look that the values go on from is no extra work.
    (pilot.looked_at() <= result_.samples ? value_rays : fixed_rays_) += rays_.next();
    measure(task, pilot);
    value_rays += rays_.next();
    if (!plain() || task.only_direct)
        check();
    result_.work = ambient.work();
    result_.work.ambient_rays = ambient_rays_;
    result_.work.fixed_rays = fixed_rays_;
    result_.work.value_rays = value_rays;
    result_.report = ambient.report();
    return std::move(result_);
}

} // namespace

GridResult Simulation::illuminance(const SensorGrid& grid, const GridSettings& settings, const Progress& progress) const
{
    const auto start = std::chrono::steady_clock::now();
    check_accuracy(settings.accuracy, "grid " + grid.name);
    GridResult result = GridRun(*parts_, grid, settings, progress).run();
    result.seconds = seconds_since(start);
    return result;
}

} // namespace lightwell
