#pragma once

#include "engine/simulate/path_listener.h"
#include "engine/simulate/simulate.h"

namespace lightwell {

/// Plain paths from a sensor, of which a listener is told; the mean of what they bring is the sensor's illuminance.
/// For questions about where light comes from.
class PathFollower {
public:
    /// @throws InputError as Simulation
    explicit PathFollower(Scene scene, const Preparation& preparation = {});
    ~PathFollower();
    PathFollower(PathFollower&&) noexcept;

    const Scene& scene() const noexcept;
    /// @param key    of the random numbers: replicates have keys of their own
    /// @param first  number of the first path; paths of other numbers are others
    void follow(const Sensor& sensor, std::uint64_t key, std::uint32_t first, std::uint32_t count,
                PathListener& listener) const;

private:
    std::unique_ptr<SimulationParts> parts_;
};

} // namespace lightwell
