#pragma once

#include "engine/ambient/deep_field.h"
#include "engine/ambient/hemisphere.h"

#include <functional>

namespace lightwell {

/// Ambient irradiance at one place, with what is needed to use it around there.
struct AmbientRecord {
    AmbientSite site;
    Spectrum irradiance; ///< W/m^2
    IrradianceGradient gradient;
    /// Photopic irradiance of each replicate minus the mean: the spread is the statistical error.
    std::array<float, replicates> deviation{};
};

struct CacheSettings {
    /// Error of irradiance allowed at the edge of a record's reach, relative: distances follow from it.
    double accuracy = 0.1;
    int rays = 512; ///< a record, shared out among the replicates
    std::size_t most_records = 200000;
    std::uint64_t seed = 1;
    int threads = 0;
    std::function<void()> check = [] {}; ///< called often, from all threads: throws to stop
    bool gradients = true;               ///< false: records are averaged as they are
    bool hessian = true;                 ///< false: reach follows the harmonic mean distance alone
};

/// A place where the cache will be asked.
struct AmbientCandidate {
    SurfacePlace place;
    double footprint_m = 0; ///< between neighbouring pixels: no record needs a smaller reach; 0: none is too small
};

/// Ambient irradiance by interpolation between records.
struct CachedAmbient {
    Spectrum irradiance;
    std::array<double, replicates> deviation{}; ///< photopic, of each replicate
};

/// Records of ambient irradiance on the surfaces that are looked at, far apart where it changes little.
/// Grows in generations: candidates that no record covers are traced, and all of a generation's records are added at
/// once, so that the result does not depend on the order of work.
/// Error: biased by interpolation, about `accuracy` or less; the statistical error is in the deviations
/// Source  Ward, Rubinstein, Clear 1988; Ward, Heckbert 1992; Krivanek et al. 2006 (neighbour clamping);
///         Schwarzhaupt et al. 2012 (reach)
class AmbientCache {
public:
    explicit AmbientCache(const DeepField& deep) : deep_(deep) {}

    /// One generation. @return records added
    std::size_t grow(const std::vector<AmbientCandidate>& candidates, const HemisphereRays& rays, double size_m,
                     const CacheSettings& settings);
    /// Adds records that were made before, by an earlier run or another process, as they are.
    void add(std::vector<AmbientRecord> records);
    /// After the last generation. From then on, where no record reaches, as in the last pixels before a corner, those
    /// nearby answer if nothing stands between.
    void complete();
    /// @return false where no record answers
    bool irradiance(const Point& at, const Direction& normal, CachedAmbient& found) const noexcept;

    const std::vector<AmbientRecord>& records() const noexcept { return records_; }

private:
    bool covers(const SurfacePlace& place) const noexcept;
    bool mean_around(const SiteTree& tree, const std::vector<AmbientSite>& sites, double widened, const Point& at,
                     const Direction& normal, CachedAmbient& found) const noexcept;
    /// @param key  of its random numbers: its place in the order of records, which no shift or scale changes
    AmbientRecord trace(const AmbientCandidate& candidate, std::uint64_t key, const HemisphereRays& rays, double size_m,
                        const CacheSettings& settings) const;
    void clamp_to_neighbours(AmbientRecord& record);
    void insert(std::vector<AmbientRecord>&& records);

    const DeepField& deep_;
    std::vector<AmbientRecord> records_;
    std::vector<AmbientSite> sites_; ///< of the records, close together for the search
    std::vector<AmbientSite> wide_;  ///< the same with a longer reach
    SiteTree tree_, wide_tree_;
};

} // namespace lightwell
