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

} // namespace

std::array<double, replicates> SensorTask::operator()(std::size_t i, int samples, bool same_paths) const
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

SensorTask::Direct SensorTask::direct(std::size_t i, std::uint64_t key, std::uint32_t count) const
{
    const std::uint32_t tests = std::max(1u, count / rays_a_test);
    Direct sum;
    for (std::uint32_t n = 0; n < tests; ++n) {
        PathRandom random(mix_bits(key, direct_salt), i, n);
        const DirectIrradiance found = tracer.sensor_direct(places[i], random);
        sum.irradiance += (found.lamps + found.suns) / tests;
        sum.lamp_share += found.lamp_share / tests;
    }
    return sum;
}

Spectrum SensorTask::by_paths(std::size_t i, int replicate, std::uint64_t key, std::uint32_t count) const
{
    Spectrum sum;
    for (std::uint32_t n = 0; n < count; ++n) {
        PathRandom random(key, i, n);
        sum += tracer.irradiance(places[i], replicate, random);
    }
    return sum / count;
}

Spectrum SensorTask::by_hemisphere(std::size_t i, int replicate, std::uint64_t key, std::uint32_t count) const
{
    const Direct tested = direct(i, key, count);
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
    return tested.irradiance + (others > 0 ? ambient * ((1 - std::min(1.0, tested.lamp_share)) / others) : Spectrum{});
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
                                Teller& teller, bool same_paths)
{
    const std::size_t count = sensors.size();
    MeasuredSensors measured{std::move(sensors), std::vector<std::array<double, replicates>>(count),
                             std::vector<double>(count), std::vector<double>(count)};
    parallel_for(count, threads, [&](std::size_t k) {
        teller.check();
        measured.set(k, task(measured.sensors[k], samples, same_paths));
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
