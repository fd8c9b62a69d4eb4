#pragma once

#include "engine/direct/vertex.h"
#include "engine/sampling/path_random.h"
#include "engine/sources/source_list.h"

namespace lightwell {

/// How shadow rays were shared out at a vertex: what it takes to weigh a scattered ray that meets a source against
/// the shadow rays that could have.
struct SourceShares {
    Point from;
    Direction normal;
    bool transmits = false;
    double lamp_total = 0; ///< sum of the lamps' potentials
    int lamp_rays = 0;
    int sky_rays = 0;
    double portal_share = 0; ///< of the sky's rays
    Guide::Shares portals;
};

/// What a vertex sends to its viewer, and what falls on it.
struct Gathered {
    Spectrum radiance;   ///< W/(m^2 sr)
    Spectrum irradiance; ///< W/m^2, on the viewer's side
};

/// Share of a source's light that shadow rays answer for; scattered rays that meet the source answer for the rest.
/// Source  Veach 1997, balance heuristic with cutoff
double shadow_ray_weight(double shadow_density, double scattered_density) noexcept;

/// What is wanted of the sources at a vertex.
struct GatherWish {
    int rays = 1; ///< shadow rays to lamps, shared out by potential, and to the sky
    bool lamps = true, suns = true, sky = true;
    /// Lobes whose scattered rays find sources too; the light of the others comes by shadow rays alone.
    LobeSet scattered = LobeSet::all;
};

/// Light straight from the sources, by shadow rays.
/// Error: unbiased together with scattered rays that carry 1 - shadow_ray_weight().
/// Source  Ward 1994, Section 3.1 (direct component)
class DirectLight {
public:
    DirectLight(const SourceList& sources, const RayQueries& rays) : sources_(sources), rays_(rays) {}

    Gathered gather(const Vertex& vertex, const GatherWish& wish, PathRandom& random, SourceShares& shares) const;

    /// Density with which gather() would have aimed a shadow ray in the direction of a lamp that a ray has met.
    double lamp_density(const SourceShares& shares, int lamp, const Direction& direction,
                        const Hit& hit) const noexcept;
    double sky_density(const SourceShares& shares, const Direction& direction) const noexcept;

private:
    struct Task;
    void add(const Task& task, const SourceSample& sample, double density_per_sr, bool found_by_scattering) const;
    void lamps(const Task& task, PathRandom& random, SourceShares& shares) const;
    void sky(const Task& task, PathRandom& random, SourceShares& shares) const;
    SourceSample sky_sample(const SourceShares& shares, double choice, UnitSquare u) const;

    const SourceList& sources_;
    const RayQueries& rays_;
};

} // namespace lightwell
