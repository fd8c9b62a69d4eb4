#pragma once

#include "engine/base/errors.h"
#include "engine/simulate/path_tracer.h"
#include "engine/simulate/simulate.h"

#include <chrono>
#include <functional>
#include <mutex>

/// \file What the drivers for pictures and grids share; nothing outside engine/simulate includes it.
namespace lightwell {

struct SimulationParts {
    Scene scene;
    Plan plan;
    RayQueries rays;
    SourceList sources;
    VirtualSources virtual_sources;
    SecondarySources secondary; ///< whose light is not known yet
    PathTracer tracer;          ///< plain
    Box box;
    Preparation preparation;

    SimulationParts(Scene&& s, const Preparation& p)
        : scene(with_open_sheets(std::move(s), p.secondary)),
          plan(plan_for(needs_of(scene), {PlanWish{}.accuracy, p.virtual_sources ? p.virtual_depth : 0})),
          rays(scene, p.backs_unseen ? BackFaces::unseen : BackFaces::seen), sources(scene, rays),
          virtual_sources(scene, sources, virtual_settings()), secondary(scene, p.secondary),
          tracer(scene, rays, sources, virtual_sources, {nullptr, nullptr, nullptr, p.ambient_limit},
                 direct_settings(p)),
          box(bounds(scene)), preparation(p)
    {
    }

private:
    static DirectSettings direct_settings(const Preparation& preparation)
    {
        DirectSettings settings = preparation.direct;
        settings.glow_radii = preparation.ambient_limit.has_value();
        return settings;
    }
    /// Bent meshes may have flat parts; a depth out of range is left for VirtualSources to refuse.
    VirtualSettings virtual_settings() const
    {
        const int depth = plan.wish.virtual_depth;
        const bool wanted = plan.uses(StageKind::virtual_sources) || plan.needs.curved_mirrors || depth < 0 ||
                            depth > Reflections::most;
        return {wanted ? depth : 0};
    }
};

/// A sensor as rays see it. One that lies in a surface is lifted off it by a billionth of the scene's size.
inline SurfacePlace receiver_of(const Sensor& sensor, double size_m)
{
    constexpr double sensor_lift = 1e-9;
    const double error = sensor_lift * size_m + 64 * std::numeric_limits<double>::epsilon() * max_abs(sensor.position);
    return {sensor.position, normalized(sensor.normal), error};
}

/// Throws Cancelled when progress says stop.
inline std::function<void()> stop_when_asked(const Progress& progress)
{
    return [&progress] {
        if (progress.stop())
            throw Cancelled{};
    };
}

/// Tells how far the work has come, from one thread at a time, and stops it when asked.
class Teller {
public:
    Teller(const Progress& progress, std::string stage, std::size_t total)
        : progress_(progress), stage_(std::move(stage)), total_(total)
    {
    }
    void check() const
    {
        if (progress_.stop())
            throw Cancelled{};
    }
    void done_one()
    {
        const std::lock_guard lock(mutex_);
        progress_.tell(stage_, std::min(1.0, static_cast<double>(++done_) / static_cast<double>(total_)));
    }

private:
    const Progress& progress_;
    std::string stage_;
    std::size_t total_, done_ = 0;
    std::mutex mutex_;
};

/// Paths of the pilot runs, and the most that are ever chosen.
inline constexpr int pilot_samples = 4 * replicates;
inline constexpr int most_samples = 1 << 20;

double seconds_since(std::chrono::steady_clock::time_point start);
/// Median of errors / values over the items that are not dark.
double median_relative(const std::vector<double>& values, const std::vector<double>& errors);
/// Rounded up to a multiple of the replicates, at least one each.
int whole_replicates(int samples);
/// @throws InputError unless between 0 and 1
void check_accuracy(double accuracy, const std::string& place);

/// One value of a result beside its estimate by plain path tracing.
struct Checked {
    double value = 0, plain = 0, plain_error = 0;
    Point place = {}; ///< of the sensor, m, or the pixel, in pixels
};
BiasEstimate bias_of(const std::vector<Checked>& points);

struct BiasCheck {
    std::vector<Checked> points;
    BiasEstimate whole;
};
/// What a result took before it was checked.
struct AllWork {
    double paths = 0; ///< of the values
    RayCounts rays;   ///< of all stages
};
/// Four times the paths, from 16 in each replicate, until the mean bias is known as well as `wanted` (relative), or
/// until the next step would take more than a share of all the work.
/// @param  measure  the checked values, each by so many plain paths
BiasCheck check_bias(const std::function<std::vector<Checked>(int paths)>& measure, double wanted, const AllWork& all);

/// The bias to expect of each value: the mean one, and what the checked values nearby show beyond it, both less the
/// part that noise of the check explains. 0 where the check cannot tell a bias from noise.
class LocalBias {
public:
    LocalBias(const BiasEstimate& whole, const std::vector<Checked>& points);
    /// @return  estimate of value - truth, in the unit of the value
    double at(const Point& place, double value) const noexcept;

private:
    std::vector<Checked> points_;
    std::vector<double> rest_; ///< relative to the value
    double mean_ = 0, least_ = 0;
};

} // namespace lightwell
