#pragma once

#include "engine/simulate/kept_ambient.h"
#include "engine/simulate/parts.h"

namespace lightwell {

/// How finely ambient light is found, from the accuracy wanted.
struct AmbientEffort {
    DeepSettings deep;
    CacheSettings cache;
    std::size_t deep_paths = 1024; ///< along which the deep field's sites are looked for
    double accuracy = 0;           ///< that all of this follows from

    /// The deep field as fine as another accuracy would have it.
    void set_deep(double deep_accuracy);
};
AmbientEffort ambient_effort(double accuracy, const Techniques& techniques, std::uint64_t seed, int threads);

/// @param settings  of a picture or a grid
template <class Settings>
AmbientEffort effort_of(const Settings& settings)
{
    const double kept = settings.ambient_file.accuracy;
    return ambient_effort(kept > 0 ? kept : settings.accuracy, settings.techniques, settings.seed, settings.threads);
}

/// Ambient light of one picture or grid, and the tracer that uses it.
class AmbientBuild {
public:
    /// @param check  called often, from all threads: throws to stop
    /// @param file  of kept light: what fits is taken from there, what is made is added; empty: none
    /// @throws InputError when the file belongs to another scene or other settings
    AmbientBuild(const SimulationParts& parts, const AmbientEffort& effort, const Techniques& techniques,
                 const std::function<void()>& check, const std::filesystem::path& file);
    AmbientBuild(const AmbientBuild&) = delete;
    AmbientBuild& operator=(const AmbientBuild&) = delete;

    /// A ray that starts at the i-th of `count` pixels or sensors; false: there is none.
    using Start = std::function<bool(std::size_t i, PathRandom& random, Ray& ray)>;
    void build_deep(std::size_t count, const Start& start);
    /// Solves the deep field again, with so many times the rays of its first look.
    void refine_deep(double work)
    {
        effort_.deep.work = work;
        deep_.refine(tracer_, effort_.deep);
    }
    /// One generation of records at these places. @return records added
    std::size_t grow(const std::vector<AmbientCandidate>& candidates);
    /// After the last generation.
    void complete() { cache_.complete(); }

    /// Uses what has been built so far.
    const PathTracer& tracer() const noexcept { return tracer_; }
    /// What was built; rays are counted by the caller.
    WorkCounts work() const noexcept
    {
        WorkCounts work;
        work.deep_sites = deep_.size();
        work.bright_discs = deep_.bright().size();
        work.ambient_records = cache_.records().size();
        work.sites_kept = deep_kept_ ? deep_.size() : 0;
        work.records_kept = records_kept_;
        work.secondary_sources = secondary_.size();
        return work;
    }
    const DeepField& deep() const noexcept { return deep_; }
    const AmbientCache& cache() const noexcept { return cache_; }
    /// Damage found in the file.
    Report report() const { return kept_ ? kept_->report() : Report{}; }

private:
    bool answers(const std::vector<SurfacePlace>& places) const;

    const SimulationParts& parts_;
    AmbientEffort effort_;
    DeepField deep_;
    AmbientCache cache_;
    SecondarySources secondary_;
    PathTracer tracer_;
    std::optional<KeptAmbient> kept_;
    std::size_t records_kept_ = 0; ///< of others, taken from the file
    bool deep_kept_ = false, collected_ = false;
};

} // namespace lightwell
