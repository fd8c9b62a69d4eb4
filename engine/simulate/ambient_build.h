#pragma once

#include "engine/simulate/parts.h"

namespace lightwell {

/// How finely ambient light is found, from the accuracy wanted.
struct AmbientEffort {
    DeepSettings deep;
    CacheSettings cache;
    std::size_t deep_paths = 1024; ///< along which the deep field's sites are looked for
};
AmbientEffort ambient_effort(double accuracy, const Techniques& techniques, std::uint64_t seed, int threads);

/// Ambient light of one picture or grid, and the tracer that uses it.
class AmbientBuild {
public:
    /// @param check  called often, from all threads: throws to stop
    AmbientBuild(const SimulationParts& parts, const AmbientEffort& effort, const Techniques& techniques,
                 const std::function<void()>& check);
    AmbientBuild(const AmbientBuild&) = delete;
    AmbientBuild& operator=(const AmbientBuild&) = delete;

    /// A ray that starts at the i-th of `count` pixels or sensors; false: there is none.
    using Start = std::function<bool(std::size_t i, PathRandom& random, Ray& ray)>;
    void build_deep(std::size_t count, const Start& start);
    /// One generation of records at these places. @return records added
    std::size_t grow(const std::vector<AmbientCandidate>& candidates);

    /// Uses what has been built so far.
    const PathTracer& tracer() const noexcept { return tracer_; }
    WorkCounts work() const noexcept { return {deep_.size(), deep_.bright().size(), cache_.records().size()}; }
    const DeepField& deep() const noexcept { return deep_; }
    const AmbientCache& cache() const noexcept { return cache_; }

private:
    const SimulationParts& parts_;
    AmbientEffort effort_;
    DeepField deep_;
    AmbientCache cache_;
    PathTracer tracer_;
};

} // namespace lightwell
