#include "engine/simulate/rays.h"

#include "engine/base/threads.h"
#include "engine/sampling/statistics.h"
#include "engine/sampling/warps.h"
#include "engine/simulate/ambient_build.h"
#include "engine/simulate/replicates.h"

#include <algorithm>
#include <array>
#include <limits>

namespace lightwell {
namespace {

/// Paths that each ray gets at least, and at most when it keeps being noisy.
constexpr int first_paths = 8 * replicates, most_paths = 1024 * replicates;
/// As of sensors in grids: lifted off a surface they lie in by this share of the scene's size.
constexpr double sensor_lift = 1e-9;

class RayTask {
public:
    RayTask(const SimulationParts& parts, const PathTracer& tracer, const RaySettings& settings)
        : parts_(parts), tracer_(tracer), settings_(settings)
    {
    }

    RayAnswer answer(const RayRequest& request, std::size_t index) const
    {
        RayAnswer answer;
        if (!request.sensor)
            look(request, answer);
        std::array<Sums, replicates> sums;
        int paths = settings_.samples > 0 ? whole_replicates(settings_.samples) : first_paths;
        int done = 0;
        for (;;) {
            follow(request, index, done / replicates, paths / replicates, sums);
            done = paths;
            summarize(sums, done / replicates, answer);
            const double level = request.sensor ? illuminance_of(answer.value).value : luminance_of(answer.value).value;
            if (settings_.samples > 0 || answer.standard_error <= settings_.accuracy * level || done >= most_paths)
                return answer;
            paths = 2 * done;
        }
    }

private:
    struct Sums {
        Spectrum value, irradiance;
    };

    void follow(const RayRequest& request, std::size_t index, int from, int to,
                std::array<Sums, replicates>& sums) const
    {
        for (int r = 0; r < replicates; ++r) {
            const std::uint64_t key = mix_bits(settings_.seed, static_cast<std::uint64_t>(r));
            for (int n = from; n < to; ++n) {
                PathRandom random(key, index, static_cast<std::uint32_t>(n));
                Sums& sum = sums[static_cast<std::size_t>(r)];
                if (request.sensor && settings_.constant_ambient) {
                    const DirectIrradiance direct = tracer_.sensor_direct(place_of(request), random);
                    sum.value += direct.lamps + direct.suns + *settings_.constant_ambient * pi;
                    continue;
                }
                if (request.sensor) {
                    sum.value += tracer_.irradiance(place_of(request), r, random);
                    continue;
                }
                const PathSample sample =
                    tracer_.sample({request.origin, request.direction, request.reach_m}, r, random);
                sum.value += sample.radiance;
                sum.irradiance += sample.irradiance;
            }
        }
    }

    static void summarize(const std::array<Sums, replicates>& sums, int each, RayAnswer& answer)
    {
        RunningStatistics statistics;
        answer.value = answer.irradiance = {};
        for (const Sums& sum : sums) {
            statistics.add(luminance_of(sum.value / each).value);
            answer.value += sum.value / (static_cast<double>(each) * replicates);
            answer.irradiance += sum.irradiance / (static_cast<double>(each) * replicates);
        }
        answer.standard_error = statistics.standard_error();
    }

    void look(const RayRequest& request, RayAnswer& answer) const
    {
        Hit hit;
        if (!parts_.rays.closest({request.origin, request.direction, request.reach_m}, hit))
            return;
        answer.met_surface = true;
        answer.distance_m = hit.t;
        answer.position = hit.position;
        answer.normal = facing(hit.normal, request.direction);
        answer.modifier = hit.modifier;
        if (hit.part != nullptr)
            answer.surface = hit.part->surfaces[hit.surface].name;
    }

    SurfacePlace place_of(const RayRequest& request) const
    {
        const double error =
            sensor_lift * parts_.box.diagonal() + 64 * std::numeric_limits<double>::epsilon() * max_abs(request.origin);
        return {request.origin, request.direction, error};
    }

    const SimulationParts& parts_;
    const PathTracer& tracer_;
    const RaySettings& settings_;
};

/// Paths that look for ambient light start as the rays do; those of sensors with the cosine.
AmbientBuild::Start starts_of(const std::vector<RayRequest>& rays)
{
    return [&rays](std::size_t i, PathRandom& random, Ray& ray) {
        const RayRequest& request = rays[i];
        ray = {request.origin, request.direction, request.reach_m};
        if (request.sensor)
            ray.direction = frame_about(request.direction).to_world(cosine_hemisphere(random.pair()));
        return true;
    };
}

} // namespace

RayTracer::RayTracer(Scene scene, const Preparation& preparation)
{
    validate(scene);
    parts_ = std::make_unique<SimulationParts>(std::move(scene), preparation);
}

RayTracer::~RayTracer() = default;

const Scene& RayTracer::scene() const noexcept
{
    return parts_->scene;
}

std::vector<RayAnswer> RayTracer::trace(const std::vector<RayRequest>& rays, const RaySettings& settings,
                                        const Progress& progress) const
{
    check_accuracy(settings.accuracy, "rays");
    std::vector<RayAnswer> answers(rays.size());
    if (rays.empty())
        return answers;
    for (const RayRequest& ray : rays)
        if (!is_finite(ray.origin) || !(std::fabs(length(ray.direction) - 1) < 1e-6))
            throw InputError{"ray", "origin or direction is not finite, or the direction not a unit vector"};
    const bool any_indirect = std::any_of(
        rays.begin(), rays.end(), [&](const RayRequest& ray) { return !ray.sensor || !settings.constant_ambient; });
    const bool plain =
        !any_indirect || settings.unbiased || !settings.techniques.deep_field || parts_->preparation.ambient_limit;
    Techniques techniques = settings.techniques;
    techniques.cache = false; // rays say nothing about their neighbours
    AmbientBuild ambient(*parts_, effort_of(settings), techniques, stop_when_asked(progress),
                         plain ? "" : settings.ambient_file.file);
    if (!plain)
        ambient.build_deep(rays.size(), starts_of(rays));
    const RayTask task(*parts_, plain ? parts_->tracer : ambient.tracer(), settings);
    Teller teller(progress, "rays", rays.size());
    parallel_for(rays.size(), settings.threads, [&](std::size_t i) {
        teller.check();
        answers[i] = task.answer(rays[i], i);
        teller.done_one();
    });
    return answers;
}

} // namespace lightwell
