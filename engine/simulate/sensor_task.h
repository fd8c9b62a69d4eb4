#pragma once

#include "engine/sampling/statistics.h"
#include "engine/simulate/parts.h"
#include "engine/simulate/replicates.h"

namespace lightwell {

/// What paths have brought to one sensor, in one replicate.
struct SensorSums {
    Spectrum tested, arrived;                            ///< W/m^2, by shadow rays from the sensor and by rays
    double lamp_share = 0;                               ///< of the hemisphere, cosine-weighted
    std::uint32_t tests = 0, paths = 0, other_paths = 0; ///< other: those that met no lamp
};
using ReplicateSums = std::array<SensorSums, replicates>;

/// How the light at a grid's sensors is found.
struct SensorTask {
    const PathTracer& tracer;
    const std::vector<SurfacePlace>& places;
    std::uint64_t seed;
    const DeepField* deep; ///< null: plain paths, or records of the cache
    /// Irradiance beside that of lamps and suns, W/m^2, where no other is wanted.
    std::optional<Spectrum> only_direct = {};

    /// Goes on to so many samples of all replicates together.
    /// @param same_paths  all replicates follow the same paths, so that only their ambient light differs
    void extend(ReplicateSums& sums, std::size_t i, int samples, bool same_paths) const;
    /// Whether the sums stand for no more than so many samples.
    static bool within(const ReplicateSums& sums, int samples) noexcept;
    /// Illuminance, lx, by replicate. @pre  sums of one sample of each at least
    std::array<double, replicates> illuminance(const ReplicateSums& sums) const;

private:
    struct Which {
        std::size_t sensor;
        int replicate;
        std::uint64_t key; ///< of its random numbers
    };
    void test(SensorSums& sums, const Which& which, std::uint32_t tests) const;
    void follow(SensorSums& sums, const Which& which, std::uint32_t paths) const;
    Spectrum irradiance(const SensorSums& sums) const;
};

/// Illuminance of some of a grid's sensors, lx.
struct MeasuredSensors {
    std::vector<std::size_t> sensors;
    std::vector<std::array<double, replicates>> found;
    std::vector<double> values, errors; ///< means and standard errors of the replicates

    void set(std::size_t k, const std::array<double, replicates>& by_replicate);
    /// Standard error of the mean over the sensors, which share their ambient light.
    double mean_error() const;
};

/// Every step-th sensor of a grid with what its paths have brought so far: a first look is no lost work.
class BegunSensors {
public:
    BegunSensors(std::size_t step, std::size_t sensors) : step_(step), sums_((sensors + step - 1) / step) {}
    /// Null: none is kept of this one.
    ReplicateSums* of(std::size_t sensor) noexcept { return sensor % step_ == 0 ? &sums_[sensor / step_] : nullptr; }

private:
    std::size_t step_;
    std::vector<ReplicateSums> sums_;
};

/// @param begun  gone on with, where these samples are more, and kept up; null: all begin anew
MeasuredSensors measure_sensors(const SensorTask& task, int samples, std::vector<std::size_t> sensors, int threads,
                                Teller& teller, BegunSensors* begun = nullptr, bool same_paths = false);
/// Every step-th of so many, from the first.
std::vector<std::size_t> every_of(std::size_t step, std::size_t sensors);

} // namespace lightwell
