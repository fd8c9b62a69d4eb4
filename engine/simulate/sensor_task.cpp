#include "engine/simulate/sensor_task.h"

#include "engine/base/threads.h"
#include "engine/sampling/warps.h"

#include <algorithm>

namespace lightwell {
namespace {

/// Keeps the random numbers of direct light and of rays apart.
constexpr std::uint64_t direct_salt = 0x64697265;
/// Rays of ambient light to one test of the lamps: their light is found exactly where nothing is half hidden.
constexpr std::uint32_t rays_a_test = 16;

std::uint32_t each_of(int samples) noexcept
{
    return static_cast<std::uint32_t>(samples / replicates);
}

std::uint32_t tests_of(int samples) noexcept
{
    return std::max(1u, each_of(samples) / rays_a_test);
}

} // namespace

void SensorTask::extend(ReplicateSums& sums, std::size_t i, int samples, bool same_paths) const
{
    for (int r = 0; r < replicates; ++r) {
        SensorSums& own = sums[static_cast<std::size_t>(r)];
        const Which which{i, r, mix_bits(seed, static_cast<std::uint64_t>(same_paths ? 0 : r))};
        if (deep != nullptr || only_direct)
            test(own, which, tests_of(samples));
        if (!only_direct)
            follow(own, which, each_of(samples));
    }
}

bool SensorTask::within(const ReplicateSums& sums, int samples) noexcept
{
    return sums.front().paths <= each_of(samples) && sums.front().tests <= tests_of(samples);
}

void SensorTask::test(SensorSums& sums, const Which& which, std::uint32_t tests) const
{
    for (; sums.tests < tests; ++sums.tests) {
        PathRandom random(mix_bits(which.key, direct_salt), which.sensor, sums.tests);
        const DirectIrradiance found = tracer.sensor_direct(places[which.sensor], random);
        sums.tested += found.lamps + found.suns;
        sums.lamp_share += found.lamp_share;
    }
}

void SensorTask::follow(SensorSums& sums, const Which& which, std::uint32_t paths) const
{
    const SurfacePlace& place = places[which.sensor];
    const Frame frame = frame_about(place.normal);
    std::vector<Dependence> dependences;
    for (; sums.paths < paths; ++sums.paths) {
        PathRandom random(which.key, which.sensor, sums.paths);
        if (deep == nullptr) {
            sums.arrived += tracer.irradiance(place, which.replicate, random);
            continue;
        }
        const Direction direction = hemisphere_direction(frame, random.pair());
        dependences.clear();
        const Arrival arrival = tracer.arrive(place, direction, random, dependences);
        sums.arrived += arrival.irradiance + deep->sum(dependences, which.replicate);
        sums.other_paths += arrival.met_lamp ? 0 : 1;
    }
}

Spectrum SensorTask::irradiance(const SensorSums& sums) const
{
    if (only_direct)
        return sums.tested / sums.tests + *only_direct;
    if (deep == nullptr)
        return sums.arrived / sums.paths;
    // How much of the hemisphere shows lamps is known better from the shadow rays than from the others.
    const double other_share = 1 - std::min(1.0, sums.lamp_share / sums.tests);
    const Spectrum ambient = sums.other_paths > 0 ? sums.arrived * (other_share / sums.other_paths) : Spectrum{};
    return sums.tested / sums.tests + ambient;
}

std::array<double, replicates> SensorTask::illuminance(const ReplicateSums& sums) const
{
    std::array<double, replicates> found{};
    for (std::size_t r = 0; r < replicates; ++r)
        found[r] = illuminance_of(irradiance(sums[r])).value;
    return found;
}

void MeasuredSensors::set(std::size_t k, const std::array<double, replicates>& by_replicate)
{
    RunningStatistics statistics;
    for (const double value : by_replicate)
        statistics.add(value);
    found[k] = by_replicate;
    values[k] = statistics.mean();
    errors[k] = statistics.standard_error();
}

double MeasuredSensors::mean_error() const
{
    std::array<double, replicates> means{};
    for (const auto& sensor : found)
        for (std::size_t r = 0; r < replicates; ++r)
            means[r] += sensor[r] / static_cast<double>(found.size());
    RunningStatistics statistics;
    for (const double mean : means)
        statistics.add(mean);
    return statistics.standard_error();
}

MeasuredSensors measure_sensors(const SensorTask& task, int samples, std::vector<std::size_t> sensors, int threads,
                                Teller& teller, BegunSensors* begun, bool same_paths)
{
    const std::size_t count = sensors.size();
    MeasuredSensors measured{std::move(sensors), std::vector<std::array<double, replicates>>(count),
                             std::vector<double>(count), std::vector<double>(count)};
    parallel_for(count, threads, [&](std::size_t k) {
        teller.check();
        const std::size_t sensor = measured.sensors[k];
        ReplicateSums* kept = begun != nullptr ? begun->of(sensor) : nullptr;
        ReplicateSums sums;
        // What stands for more samples than are wanted would make one sensor finer than the same run without a first
        // look.
        if (kept != nullptr && SensorTask::within(*kept, samples))
            sums = *kept;
        task.extend(sums, sensor, samples, same_paths);
        measured.set(k, task.illuminance(sums));
        if (kept != nullptr)
            *kept = sums;
        teller.done_one();
    });
    return measured;
}

std::vector<std::size_t> every_of(std::size_t step, std::size_t sensors)
{
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < sensors; i += step)
        chosen.push_back(i);
    return chosen;
}

} // namespace lightwell
