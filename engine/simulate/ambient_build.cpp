#include "engine/simulate/ambient_build.h"

#include "engine/base/threads.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace lightwell {
namespace {

constexpr std::uint64_t walk_salt = 0x77616c6b;
/// Diffuse scatterings along a path that looks for sites: the third bounce reaches about every corner of a room.
constexpr int walk_scatterings = 3;
/// A kept deep field serves another view when it answers at this share of what that view's paths meet.
constexpr double answered_share = 0.8;

/// At this accuracy: 64 rays a site, 512 a record, records 0.1 of the harmonic mean distance apart.
constexpr double usual_accuracy = 0.05;

int power_of_two(double x, int least, int most)
{
    const int rounded = 1 << std::clamp(static_cast<int>(std::lround(std::log2(std::max(x, 1.0)))), 0, 20);
    return std::clamp(rounded, least, most);
}

} // namespace

void AmbientEffort::set_deep(double deep_accuracy)
{
    deep.work = std::clamp(0.4 * usual_accuracy / deep_accuracy, 1.0, 16.0);
    deep.reach_share = std::clamp(0.6 * std::pow(deep_accuracy / usual_accuracy, 0.25), 0.25, 0.6);
    deep_paths = static_cast<std::size_t>(power_of_two(1024 * usual_accuracy / deep_accuracy, 512, 8192));
}

AmbientEffort ambient_effort(double accuracy, const Techniques& techniques, std::uint64_t seed, int threads)
{
    AmbientEffort effort;
    effort.accuracy = accuracy;
    effort.set_deep(accuracy);
    effort.deep.seed = effort.cache.seed = seed;
    effort.deep.threads = effort.cache.threads = threads;
    effort.cache.accuracy = std::clamp(2 * accuracy, 0.01, 0.3);
    effort.cache.rays = power_of_two(512 * usual_accuracy / accuracy, 128, 8192);
    effort.cache.gradients = techniques.gradients;
    effort.cache.hessian = techniques.hessian;
    return effort;
}

AmbientBuild::AmbientBuild(const SimulationParts& parts, const AmbientEffort& effort, const Techniques& techniques,
                           const std::function<void()>& check, const std::filesystem::path& file)
    : parts_(parts), effort_(effort), cache_(deep_), secondary_(parts.secondary),
      tracer_(parts.scene, parts.rays, parts.sources, parts.virtual_sources,
              {techniques.cache ? &cache_ : nullptr, techniques.deep_field ? &deep_ : nullptr, &secondary_},
              parts.preparation.direct)
{
    effort_.deep.check = effort_.cache.check = check;
    if (!file.empty())
        kept_.emplace(file, ambient_identity(parts, effort, techniques));
}

bool AmbientBuild::answers(const std::vector<SurfacePlace>& places) const
{
    std::size_t answered = 0;
    for (const SurfacePlace& place : places) {
        DeepField::Weight weights[DeepField::most_weights];
        answered += deep_.weights(place.position, place.normal, weights) > 0 ? 1 : 0;
    }
    return static_cast<double>(answered) >= answered_share * static_cast<double>(places.size());
}

void AmbientBuild::build_deep(std::size_t count, const Start& start)
{
    const std::size_t paths = effort_.deep_paths;
    std::vector<std::vector<SurfacePlace>> found(paths);
    parallel_for(paths, effort_.deep.threads, [&](std::size_t i) {
        effort_.deep.check();
        // Spread evenly over the items, whatever their number.
        PathRandom random(mix_bits(effort_.deep.seed, walk_salt), 0, static_cast<std::uint32_t>(i));
        const double where = random.one();
        Ray ray;
        if (start(std::min(count - 1, static_cast<std::size_t>(where * static_cast<double>(count))), random, ray))
            parts_.tracer.receivers_along(ray, walk_scatterings, random, found[i]);
    });
    std::vector<SurfacePlace> candidates;
    for (const std::vector<SurfacePlace>& path : found)
        candidates.insert(candidates.end(), path.begin(), path.end());
    deep_kept_ = kept_ && kept_->take_deep([&](DeepSolution& deep) {
        deep_.restore(std::move(deep));
        return answers(candidates);
    });
    // By plain paths, and once: the same for every fineness of the field, and for light from a file.
    if (!std::exchange(collected_, true))
        secondary_.collect(parts_.tracer, effort_.deep.seed, effort_.deep.threads);
    if (!deep_kept_) {
        deep_.restore({});
        deep_.place(candidates, tracer_, parts_.box.diagonal(), effort_.deep);
        deep_.solve_with(tracer_, effort_.deep);
        if (kept_)
            kept_->keep(deep_.solution());
    }
}

std::size_t AmbientBuild::grow(const std::vector<AmbientCandidate>& candidates)
{
    if (kept_) {
        std::vector<AmbientRecord> others = kept_->new_records();
        records_kept_ += others.size();
        cache_.add(std::move(others));
    }
    const std::size_t made = cache_.grow(candidates, tracer_, parts_.box.diagonal(), effort_.cache);
    if (kept_)
        kept_->keep(std::span(cache_.records()).last(made));
    return made;
}

} // namespace lightwell
