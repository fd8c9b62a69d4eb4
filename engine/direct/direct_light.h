#pragma once

#include "engine/direct/settings.h"
#include "engine/direct/vertex.h"
#include "engine/direct/visibility_history.h"
#include "engine/sampling/path_random.h"
#include "engine/sources/source_list.h"

namespace lightwell {

/// How shadow rays were shared out at a vertex: what it takes to weigh a scattered ray that meets a source against
/// the shadow rays that could have.
struct SourceShares {
    Point from;
    Direction normal;
    bool transmits = false;
    bool tested = false;   ///< by gather_tested()
    double lamp_total = 0; ///< sum of the lamps' potentials, when they are few
    int lamp_rays = 0;
    int sky_rays = 0;
    double portal_share = 0; ///< of the sky's rays
    Guide::Shares portals;
};

/// What a vertex sends to its viewer, and what falls on it.
struct Gathered {
    Spectrum radiance;   ///< W/(m^2 sr)
    Spectrum irradiance; ///< W/m^2, on the viewer's side
    double lamp_share =
        0; ///< of the viewer's side of the hemisphere, cosine-weighted, that shows lamps; by gather_tested()
    int shadow_rays = 0;
    int tested = 0, untested = 0; ///< sources, by gather_tested()
    double doubt = 0;             ///< photopic radiance by which the untested sources may be wrong, at most
};

/// Share of a source's light that shadow rays answer for; scattered rays that meet the source answer for the rest.
/// Source  Veach 1997, balance heuristic with cutoff
double shadow_ray_weight(double shadow_density, double scattered_density) noexcept;
/// What a shadow ray has brought to a vertex.
struct Brought {
    Direction local;       ///< to the light, in the vertex's frame
    Spectrum value_per_sr; ///< of the BSDF, all lobes
    Spectrum radiance;     ///< that arrives
    double density_per_sr; ///< with which such rays are aimed, times their number
};
/// Which scattered rays find the same light.
struct FoundToo {
    LobeSet lobes = LobeSet::all;
    bool by_scattering = true; ///< else none does
};
/// Adds the light with its weight against scattered rays.
void add_light(Gathered& sum, const Vertex& vertex, const Brought& brought, const FoundToo& too) noexcept;
/// The ray that tests whether a vertex sees a sample of a source.
Ray shadow_ray(const Hit& from, const SourceSample& sample) noexcept;

/// What gather_tested() knows of earlier generations, and what it notes for later ones.
struct TestedGeneration {
    const VisibilityHistory* history = nullptr; ///< null: nothing is known
    VisibilityCounts* counts = nullptr;         ///< of the calling thread; sized sources(); null: nothing is noted
};

/// What is wanted of the sources.
struct SourceKinds {
    bool lamps = true, suns = true, sky = true;
};
/// How a few shadow rays are shared out at a vertex.
struct GatherWish {
    int rays = 1; ///< to lamps, shared out by potential, and to the sky
    SourceKinds kinds = {};
    /// Lobes whose scattered rays find sources too; the light of the others comes by shadow rays alone.
    LobeSet scattered = LobeSet::all;
    bool alone = false; ///< scattered rays leave out what these find
};

/// Light straight from the sources, by shadow rays.
/// Source  Ward 1994, Section 3.1 (direct component)
class DirectLight {
public:
    DirectLight(const SourceList& sources, const RayQueries& rays, const DirectSettings& settings = {})
        : sources_(sources), rays_(rays), settings_(settings)
    {
    }
    /// Few shadow rays to sources chosen at random: for vertices deep in a path.
    /// Error: unbiased together with scattered rays that carry 1 - shadow_ray_weight().
    Gathered gather(const Vertex& vertex, const GatherWish& wish, PathRandom& random, SourceShares& shares) const;

    /// Lamps and suns one by one, the most promising first: for vertices that are seen. The sky is left out.
    /// All of what they send to the diffuse lobes is in the result: scattered diffuse rays that meet a lamp or a sun
    /// count 0. Scattered glossy rays carry 1 - shadow_ray_weight() of lamp_density().
    /// Error: biased by untested sources (at most doubt(), none with a threshold of 0 or a sampled remainder), and in
    ///        penumbrae by the ratio of sums with which closed forms are scaled (falls with the number of rays;
    ///        tests/unit/direct/tested_light_test.cpp)
    /// Source  Ward 1994, Section 3.3
    Gathered gather_tested(const Vertex& vertex, const SourceKinds& kinds, const TestedGeneration& generation,
                           PathRandom& random, SourceShares& shares) const;

    /// Density with which a gather would have aimed a shadow ray in the direction of a lamp that a ray has met; after
    /// gather_tested() a nominal one that does not depend on which lamps were tested.
    double lamp_density(const SourceShares& shares, int lamp, const Direction& direction,
                        const Hit& hit) const noexcept;
    double sky_density(const SourceShares& shares, const Direction& direction) const noexcept;

    /// Lamps, then suns: what histories count.
    std::size_t sources() const noexcept { return sources_.lamps().size() + sources_.suns().size(); }
    const DirectSettings& settings() const noexcept { return settings_; }

private:
    struct Task;
    bool few_lamps() const noexcept;
    /// What else is known of a sample.
    struct Finding {
        bool scattering;          ///< scattered rays find the source too
        bool passes_illum_fronts; ///< materials/emission.h
    };
    void add(const Task& task, const SourceSample& sample, double density_per_sr, const Finding& by) const;
    void lamp(const Task& task, std::size_t at, double probability, UnitSquare u, const SourceShares& shares) const;
    void lamps(const Task& task, PathRandom& random, SourceShares& shares) const;
    void sky(const Task& task, PathRandom& random, SourceShares& shares) const;
    SourceSample sky_sample(const SourceShares& shares, double choice, UnitSquare u) const;

    const SourceList& sources_;
    const RayQueries& rays_;
    DirectSettings settings_;
};

} // namespace lightwell
