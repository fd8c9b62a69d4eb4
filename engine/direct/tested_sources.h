#pragma once

#include "engine/direct/adaptive.h"
#include "engine/direct/direct_light.h"

#include <vector>

namespace lightwell {

/// Shadow rays that a lamp is taken to get at a tested vertex when glossy rays that meet it are weighed: does not
/// depend on what was tested.
double nominal_rays(std::size_t lamps, const DirectSettings& settings) noexcept;

/// One DirectLight::gather_tested(): the sources that matter at a vertex, tested in the order of what they promise.
class TestedSources {
public:
    struct Context {
        const SourceList& sources;
        const RayQueries& rays;
        const DirectSettings& settings;
        const TestedGeneration& generation;
        const SourceKinds& kinds;
    };
    TestedSources(const Context& context, const Vertex& vertex, const SourceShares& shares, PathRandom& random);
    Gathered gather();

private:
    /// Light on the two sides of the surface: the viewer's, and the other.
    enum Side { near_side, far_side };
    /// A source that may matter here.
    struct Candidate {
        std::size_t source;                ///< lamps first, then suns
        double weight;                     ///< 1, or for a lamp that stands for a group, one over its probability
        double projected_sr[2] = {0, 0};   ///< unoccluded irradiance for a radiance of 1
        bool closed_form = false;          ///< projected_sr is exact
        bool rough = false;                ///< projected_sr is that of the middle
        double mis = 1;                    ///< nominal rays; for Illum infinite: no scattered ray finds it
        bool passes_fronts = true;         ///< of an Illum
        double size = 0;                   ///< over distance
        Spectrum radiance{}, irradiance{}; ///< of the vertex by this source when nothing is in the way, times weight
        double potential = 0;
    };
    /// Sums over the shadow rays to one source.
    struct Tested {
        Spectrum reflected[2], arriving; ///< diffusely to the viewer by side of the source; on the near side
        Spectrum highlight;
        double cosines[2] = {0, 0};             ///< of all samples, visible or not, over density
        double visible = 0, clear = 0, all = 0; ///< clear: nothing is in the way, not even a pane
        int rays = 0, blocked = 0, samples = 0;
    };
    struct Light {
        Spectrum radiance, irradiance;
        double visible_share;
        double hemisphere_share; ///< of the near side, cosine-weighted, in which a lamp is seen
    };
    bool is_lamp(const Candidate& c) const noexcept { return c.source < lamps_; }
    Spectrum diffuse_value(const Direction& local) const noexcept;
    void find_candidates();
    void add_lamp(std::size_t lamp, double weight);
    void add_sun(std::size_t sun);
    void find_projected(Candidate& candidate) const noexcept;
    void finish(Candidate& candidate, const Direction& to_middle, Spectrum source_radiance);
    int pieces(const Candidate& candidate) const noexcept;
    int rays_for(const Candidate& candidate) const noexcept;
    double mis_weight(const Candidate& candidate, double density_per_sr, const Direction& local) const noexcept;
    double highlight_potential(const Candidate& candidate, const Direction& to_middle, Side side) const noexcept;
    void test_sample(const Candidate& candidate, const SourceSample& sample, Tested& tested);
    Tested probe(const Candidate& candidate, int probes);
    Tested trace(const Candidate& candidate, int count);
    Tested trace(const Candidate& candidate, const UnitSquare* points, int count);
    Light test(Candidate& candidate);
    void add(const Light& light, double share);
    void add_untested(const AdaptiveOutcome& outcome);
    double hemisphere_share(const Candidate& candidate) const noexcept;
    double history(std::size_t i) const noexcept;

    Context context_;
    const Vertex& vertex_;
    const SourceShares& shares_;
    PathRandom& random_;
    std::size_t lamps_;
    bool even_ = false;      ///< the diffuse lobes do not depend on the direction of the light
    Spectrum even_value_[2]; ///< 1/sr, by side
    std::vector<Candidate>& candidates_;
    double expected_ = 0; ///< what tested sources gave and the others could give
    Gathered sum_;
};

} // namespace lightwell
