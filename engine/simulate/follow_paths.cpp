#include "engine/simulate/follow_paths.h"

#include "engine/simulate/parts.h"

namespace lightwell {

PathFollower::PathFollower(Scene scene, const Preparation& preparation)
{
    validate(scene);
    parts_ = std::make_unique<SimulationParts>(std::move(scene), preparation);
}
PathFollower::~PathFollower() = default;
PathFollower::PathFollower(PathFollower&&) noexcept = default;

const Scene& PathFollower::scene() const noexcept
{
    return parts_->scene;
}

void PathFollower::follow(const Sensor& sensor, std::uint64_t key, std::uint32_t first, std::uint32_t count,
                          PathListener& listener) const
{
    const SurfacePlace receiver = receiver_of(sensor, parts_->box.diagonal());
    for (std::uint32_t n = first; n < first + count; ++n) {
        PathRandom random(key, 0, n);
        parts_->tracer.irradiance(receiver, 0, random, &listener);
    }
}

} // namespace lightwell
