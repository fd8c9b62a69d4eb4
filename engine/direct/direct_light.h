#pragma once

#include "engine/direct/vertex.h"
#include "engine/sampling/sobol.h"
#include "engine/sources/source_list.h"

namespace lightwell {

/// The random numbers of one path, in the order in which they are asked for.
class PathRandom {
public:
    PathRandom(std::uint64_t seed, std::uint64_t item, std::uint32_t index) noexcept
        : sequence_(seed, item), index_(index)
    {
    }
    UnitSquare pair() noexcept { return sequence_.pair(index_, dimension_++); }
    double one() noexcept { return sequence_.one(index_, dimension_++); }

private:
    SampleSequence sequence_;
    std::uint32_t index_;
    std::uint32_t dimension_ = 0;
};

/// How shadow rays were shared out at a vertex: what it takes to weigh a scattered ray that meets a source against
/// the shadow rays that could have.
struct SourceShares {
    Point from;
    Direction normal;
    bool transmits = false;
    double lamp_total = 0; ///< sum of the lamps' potentials
    int lamp_rays = 0;
    double portal_share = 0; ///< of the sky's rays
    Portals::Shares portals;
};

/// What a vertex sends to its viewer, and what falls on it.
struct Gathered {
    Spectrum radiance;   ///< W/(m^2 sr)
    Spectrum irradiance; ///< W/m^2, on the viewer's side
};

/// Share of a source's light that shadow rays answer for; scattered rays that meet the source answer for the rest.
/// Source  Veach 1997, balance heuristic with cutoff
double shadow_ray_weight(double shadow_density, double scattered_density) noexcept;

/// Light straight from the sources, by shadow rays.
/// Error: unbiased together with scattered rays that carry 1 - shadow_ray_weight().
/// Source  Ward 1994, Section 3.1 (direct component)
class DirectLight {
public:
    DirectLight(const SourceList& sources, const RayQueries& rays) : sources_(sources), rays_(rays) {}

    /// @param lamp_rays  shadow rays to lamps; shared out by potential, stratified
    Gathered gather(const Vertex& vertex, int lamp_rays, PathRandom& random, SourceShares& shares) const;

    /// Density with which gather() would have aimed a shadow ray in the direction of a lamp that a ray has met.
    double lamp_density(const SourceShares& shares, int lamp, const Direction& direction,
                        const Hit& hit) const noexcept;
    double sky_density(const SourceShares& shares, const Direction& direction) const noexcept;

private:
    struct Aim;
    void add(const Vertex& vertex, const SourceSample& sample, double density_per_sr, bool found_by_scattering,
             Gathered& sum) const;
    void lamps(const Vertex& vertex, PathRandom& random, SourceShares& shares, Gathered& sum) const;
    void sky(const Vertex& vertex, PathRandom& random, SourceShares& shares, Gathered& sum) const;

    const SourceList& sources_;
    const RayQueries& rays_;
};

} // namespace lightwell
