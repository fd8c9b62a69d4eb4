#pragma once

#include "engine/ambient/bright_discs.h"
#include "engine/ambient/fixed_point.h"
#include "engine/ambient/site_tree.h"
#include "engine/base/spectrum.h"
#include "engine/sampling/replicates.h"
#include "engine/transport/hemisphere_rays.h"

#include <array>
#include <functional>
#include <vector>

namespace lightwell {

struct DeepSettings {
    double reach_share = 0.5; ///< reach of a site over its harmonic mean distance
    int rays = 64;            ///< a site at least, shared out among the replicates
    double work = 1;          ///< rays in the mean of all sites over `rays`: more go where they tell most
    std::size_t most_sites = 4000;
    std::uint64_t seed = 1;
    int threads = 0;
    std::function<void()> check = [] {}; ///< called often, from all threads: throws to stop
};

/// A solved deep field, to be kept and taken up again: as long as `sites`, all of it.
struct DeepSolution {
    std::vector<AmbientSite> sites;
    std::array<std::vector<Spectrum>, replicates> ambient; ///< irradiance, W/m^2
    std::vector<Spectrum> direct;                          ///< irradiance, W/m^2
    std::vector<double> tested_share;
    std::vector<double> lit_W_per_m2; ///< photopic irradiance by lamps and suns
    std::vector<double> visits;       ///< how often paths from where light is wanted met the site
};

/// Ambient irradiance everywhere, coarsely: all bounces but the first are read from it. Sites spread over the
/// surfaces that light reaches; the ambient irradiance of each is a sum over its rays of what they met and of the
/// ambient irradiance there, interpolated between sites. That is a linear system, solved as a whole: no bounce is cut
/// off. Each replicate has its own rays and its own solution. Error: biased by interpolation, once per bounce beyond
/// the first; rows of a closed scene sum exactly to the
///        reflectance, so that a uniform enclosure is exact at any reflectance below 1
/// Source  Galerkin's method with the interpolation weights as test functions (Zatz 1993); Ward 1994, Section 3.2,
/// whose cache of each further bounce is coarser: here one level for all of them
class DeepField {
public:
    /// Adds a site for each candidate that no earlier one covers, in order.
    /// @param size_m  of the scene: the reach where nothing is near
    void place(const std::vector<SurfacePlace>& candidates, const HemisphereRays& rays, double size_m,
               const DeepSettings& settings);
    /// Traces the rays of all sites and solves. No site may be added afterwards. With more work than 1 that is a first
    /// look: it tells which sites' rays differ most, and those that paths meet often and whose rays differ get most of
    /// a second set of rays.
    void solve_with(const HemisphereRays& rays, const DeepSettings& settings);

    /// Solves again on the same sites, with as much work as the settings say. @pre  solve_with()
    void refine(const HemisphereRays& rays, const DeepSettings& settings);

    /// What solve_with() has found; restore() takes it up in place of place() and solve_with(), with the same bits.
    DeepSolution solution() const { return {sites_, ambient_, direct_, tested_share_, lit_W_per_m2_, visits_}; }
    void restore(DeepSolution&& solution);

    struct Weight {
        std::uint32_t site;
        double weight;
    };
    static constexpr std::size_t most_weights = 12;
    /// The sites that answer for a place, their weights summing to 1.
    /// @return their number; 0 where none is near
    std::size_t weights(const Point& at, const Direction& normal, Weight* found) const noexcept;

    std::size_t size() const noexcept { return sites_.size(); }
    const std::vector<AmbientSite>& sites() const noexcept { return sites_; }
    Spectrum ambient(std::uint32_t site, int replicate) const noexcept
    {
        return ambient_[static_cast<std::size_t>(replicate)][site];
    }
    Spectrum direct(std::uint32_t site) const noexcept { return direct_[site]; }
    /// How often the direct light near a site should be tested, [least, 1]: often where it is bright and uneven.
    double tested_share(std::uint32_t site) const noexcept { return tested_share_[site]; }
    const BrightDiscs& bright() const noexcept { return bright_; }
    /// What the dependences add up to in a replicate.
    Spectrum sum(const std::vector<Dependence>& dependences, int replicate) const noexcept;
    bool solved() const noexcept { return !ambient_[0].empty(); }

private:
    struct RowStarts {
        std::vector<std::vector<SurfacePlace>> from; ///< by site
        std::vector<double> other_share;             ///< of the hemisphere that shows no lamp
    };
    using RayNumbers = std::vector<std::size_t>; ///< of each site, a replicate
    /// One start for each of a site's rays.
    RowStarts find_starts(const HemisphereRays& rays, const DeepSettings& settings, const RayNumbers& each);
    struct RowRays {
        std::uint64_t seed;
        std::size_t replicate, count;
    };
    /// @param other_share  of the hemisphere that shows no lamp
    void trace_row(std::size_t site, const std::vector<SurfacePlace>& from, const HemisphereRays& rays,
                   double other_share, const RowRays& which, FixedPoint& system) const;
    void find_direct(const std::vector<std::vector<SurfacePlace>>& from, const HemisphereRays& rays,
                     const DeepSettings& settings, std::vector<double>& other_share);
    void find_bright();
    /// Adds a site for each candidate that none covers.
    void place_uncovered(const HemisphereRays& rays, const DeepSettings& settings);
    /// Makes the sites smaller on which lamps shine far more than elsewhere and unevenly. @return  whether there are
    /// any
    bool narrow_peaks(const HemisphereRays& rays, const DeepSettings& settings);
    /// Halves the sites on which the solution changes so much from one to the next that their mean would put light
    /// where it is not, where they are many. @return  whether it did
    bool narrow_steep();
    void solve_rows(const RowStarts& rows, const HemisphereRays& rays, const DeepSettings& settings,
                    const RayNumbers& each);
    /// How much single rays of each site differ in what they bring, from the replicates of a solved system.
    void find_spread(const std::array<FixedPoint, replicates>& systems, const RayNumbers& each);
    RayNumbers same_number(const DeepSettings& settings) const;
    /// As many as the settings say, shared out by visits and spread.
    RayNumbers shared_out(const DeepSettings& settings) const;
    void count_visits();
    bool covers(const Point& at, const Direction& normal) const noexcept;
    /// Places about a site, as often as it answers for them: means over few of them are right in the mean.
    std::vector<SurfacePlace> starts(std::size_t site, const HemisphereRays& rays, std::size_t count,
                                     std::uint64_t seed) const;

    std::vector<AmbientSite> sites_;
    std::vector<SurfacePlace> places_;
    SiteTree tree_;
    std::array<std::vector<Spectrum>, replicates> ambient_;
    std::vector<Spectrum> direct_;
    std::vector<double> tested_share_, lit_W_per_m2_;
    std::vector<double> visits_;
    std::vector<double> spread_;    ///< standard deviation of what one ray brings, W/m^2
    std::vector<double> brightest_; ///< photopic irradiance by lamps within each site's reach, W/m^2
    std::vector<SurfacePlace> candidates_;
    std::vector<AmbientSite> steep_; ///< as they were before they were halved
    SiteTree steep_tree_;
    double size_m_ = 0;
    double bright_W_per_m2_ = infinity; ///< above that, sites are no wider than the light is even
    BrightDiscs bright_;
};

/// Sends rays along the surface that tell a site's horizon.
void look_around(AmbientSite& site, const SurfacePlace& place, const HemisphereRays& rays);

/// A random place within a site's reach. @return  false when the surface does not go on there
bool place_around(const AmbientSite& site, const SurfacePlace& centre, const HemisphereRays& rays, PathRandom& random,
                  SurfacePlace& found);

/// Where nothing is near, a value holds over this share of the scene's size.
inline constexpr double open_share = 0.1;

} // namespace lightwell
