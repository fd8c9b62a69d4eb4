#pragma once

#include "engine/direct/path_random.h"
#include "engine/direct/vertex.h"
#include "engine/sources/guide.h"

#include <optional>

namespace lightwell {

/// How a path goes on from a vertex: by the surface's own lobes, or, from diffuse surfaces, towards places that are
/// known to be bright. One density covers them all.
class Scattering {
public:
    Scattering(const Vertex& vertex, const Guide& guide);

    /// Density of sample() per solid angle; single directions excluded.
    double density_per_sr(const Direction& world, const Direction& local) const noexcept;
    /// Local frame; the weight includes the choice between the ways.
    std::optional<BsdfSample> sample(PathRandom& random) const;

private:
    const Vertex& vertex_;
    const Guide& guide_;
    double guided_density_per_sr(const Direction& world) const noexcept;

    Guide::Shares patches_, outlooks_;
    double patch_share_ = 0, outlook_share_ = 0, own_share_ = 1;
};

} // namespace lightwell
