#pragma once

#include "engine/sampling/statistics.h"
#include "engine/simulate/parts.h"
#include "engine/simulate/replicates.h"

namespace lightwell {

/// How the light at a grid's sensors is found.
struct SensorTask {
    const PathTracer& tracer;
    const std::vector<SurfacePlace>& places;
    std::uint64_t seed;
    const DeepField* deep; ///< null: plain paths, or records of the cache
    /// Irradiance beside that of lamps and suns, W/m^2, where no other is wanted.
    std::optional<Spectrum> only_direct = {};

    /// Illuminance of a sensor, lx, by replicate.
    /// @param same_paths  all replicates follow the same paths, so that only their ambient light differs
    std::array<double, replicates> operator()(std::size_t i, int samples, bool same_paths) const;

private:
    struct Direct {
        Spectrum irradiance;
        double lamp_share = 0; ///< of the hemisphere, cosine-weighted
    };
    Direct direct(std::size_t i, std::uint64_t key, std::uint32_t count) const;
    Spectrum by_paths(std::size_t i, int replicate, std::uint64_t key, std::uint32_t count) const;
    Spectrum by_hemisphere(std::size_t i, int replicate, std::uint64_t key, std::uint32_t count) const;
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
MeasuredSensors measure_sensors(const SensorTask& task, int samples, std::vector<std::size_t> sensors, int threads,
                                Teller& teller, bool same_paths = false);
/// Every step-th of so many, from the first.
std::vector<std::size_t> every_of(std::size_t step, std::size_t sensors);

} // namespace lightwell
