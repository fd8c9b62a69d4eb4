#pragma once

#include "engine/accel/ray_queries.h"
#include "engine/sources/guide.h"
#include "engine/sources/lamp_tree.h"
#include "engine/sources/local_source.h"
#include "engine/sources/sky_source.h"

#include <unordered_map>
#include <vector>

namespace lightwell {

/// A narrow distant source: sampled as its disc.
struct SunSource {
    DistantSource disc;
    Spectrum radiance;
    SourceSample sample(UnitSquare u) const noexcept;
    double density_per_sr(const Direction& direction) const noexcept; ///< 0 outside the disc
};

/// Everything that sends light: lamps at finite distance (inside instances too), suns, and the sky.
class SourceList {
public:
    SourceList(const Scene& scene, const RayQueries& rays);

    const std::vector<LocalSource>& lamps() const noexcept { return lamps_; }
    const LampTree& lamp_tree() const noexcept { return *lamp_tree_; }
    const std::vector<SunSource>& suns() const noexcept { return suns_; }
    const SkySource& sky() const noexcept { return sky_; }
    const Guide& guide() const noexcept { return *guide_; }

    /// The lamp that a ray has met; -1 when it is none that shadow rays aim at.
    int lamp_at(const Hit& hit) const noexcept;

private:
    struct Finder;
    std::unique_ptr<VariedMaterials> varied_;
    std::vector<LocalSource> lamps_;
    std::unique_ptr<LampTree> lamp_tree_;
    std::vector<SunSource> suns_;
    SkySource sky_;
    std::unique_ptr<Guide> guide_;
    std::unordered_map<std::uint64_t, int> lamp_by_place_;
};

} // namespace lightwell
