#include "engine/ambient/deep_field.h"

#include "engine/ambient/fixed_point.h"
#include "engine/ambient/hemisphere.h"
#include "engine/base/frame.h"
#include "engine/base/threads.h"
#include "engine/sampling/statistics.h"
#include "engine/sampling/warps.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace lightwell {
namespace {

/// Keeps random numbers of rays, direct light and starts apart.
constexpr std::uint64_t ray_salt = 0x72617973, second_ray_salt = 0x72617932, direct_salt = 0x64697265,
                        start_salt = 0x73746172;

} // namespace

std::vector<SurfacePlace> DeepField::starts(std::size_t site, const HemisphereRays& rays, std::size_t count,
                                            std::uint64_t seed) const
{
    constexpr std::size_t most_tries =
        16; // a start: a site between many others has a small share of its own surroundings
    const AmbientSite& s = sites_[site];
    std::vector<SurfacePlace> found;
    for (std::uint32_t n = 0; n < most_tries * count && found.size() < count; ++n) {
        PathRandom random(mix_bits(seed, start_salt), site, n);
        SurfacePlace there;
        if (!place_around(s, places_[site], rays, random, there))
            continue;
        Weight around[most_weights];
        const std::size_t sites = weights(there.position, there.normal, around);
        const double taken = random.one();
        for (std::size_t k = 0; k < sites; ++k)
            if (around[k].site == site && taken < around[k].weight)
                found.push_back(there);
    }
    if (found.empty())
        found.push_back(places_[site]);
    return found;
}

void DeepField::trace_row(std::size_t site, const std::vector<SurfacePlace>& from, const HemisphereRays& rays,
                          double other_share, const RowRays& which, FixedPoint& system) const
{
    std::vector<Dependence>& row = system.rows[site];
    std::vector<Dependence> arrived;
    Spectrum known;
    double other = 0;
    for (std::uint32_t n = 0; n < which.count; ++n) {
        // Each start gets an equal share of the rays, to one.
        const std::size_t at = n % from.size();
        const double weight =
            1 / static_cast<double>(from.size() * ((which.count - at + from.size() - 1) / from.size()));
        PathRandom random(mix_bits(which.seed, which.replicate), site, n);
        const Direction direction = hemisphere_direction(frame_about(from[at].normal), random.pair());
        arrived.clear();
        const Arrival arrival = rays.arrive(from[at], direction, random, arrived);
        known += arrival.irradiance * weight;
        other += arrival.met_lamp ? 0 : weight;
        for (const Dependence& d : arrived)
            row.push_back({d.unknown, d.weight * weight});
    }
    // How much of the hemisphere shows lamps is known better from the shadow rays than from these.
    const double scale = other > 0 ? other_share / other : 1;
    system.known[site] = known * scale;
    for (Dependence& d : row)
        d.weight = d.weight * scale;
    merge_dependences(row);
}

void DeepField::find_direct(const std::vector<std::vector<SurfacePlace>>& from, const HemisphereRays& rays,
                            const DeepSettings& settings, std::vector<double>& other_share)
{
    const std::size_t count = sites_.size();
    direct_.assign(count, {});
    std::vector<double> unevenness(count);
    lit_W_per_m2_.assign(count, 0);
    brightest_.assign(count, 0);
    tested_share_.clear();
    parallel_for(count, settings.threads, [&](std::size_t i) {
        settings.check();
        double squares = 0;
        const double weight = 1 / static_cast<double>(from[i].size());
        for (std::uint32_t k = 0; k < from[i].size(); ++k) {
            PathRandom random(mix_bits(settings.seed, direct_salt), i, k);
            const DirectIrradiance direct = rays.direct(from[i][k], random);
            brightest_[i] = std::max(brightest_[i], photopic(direct.lamps));
            direct_[i] += direct.lamps * weight;
            squares += photopic(direct.lamps) * photopic(direct.lamps) * weight;
            lit_W_per_m2_[i] += photopic(direct.lamps + direct.suns) * weight;
            other_share[i] -= std::min(1.0, direct.lamp_share) * weight;
        }
        const double mean = photopic(direct_[i]);
        unevenness[i] = std::sqrt(std::max(0.0, squares - mean * mean));
    });
    find_bright();
    double mean = 0;
    for (const Spectrum& direct : direct_)
        mean += photopic(direct) / static_cast<double>(count);
    constexpr double least_tested = 1.0 / 16, tests_per_unevenness = 0.5;
    for (const double u : unevenness)
        tested_share_.push_back(mean > 0 ? std::clamp(tests_per_unevenness * u / mean, least_tested, 1.0)
                                         : least_tested);
}

DeepField::RowStarts DeepField::find_starts(const HemisphereRays& rays, const DeepSettings& settings,
                                            const RayNumbers& each)
{
    constexpr std::size_t most_starts = 64; // each with a look around and shadow rays of its own
    RowStarts rows{std::vector<std::vector<SurfacePlace>>(sites_.size()), std::vector<double>(sites_.size(), 1.0)};
    parallel_for(sites_.size(), settings.threads, [&](std::size_t i) {
        settings.check();
        rows.from[i] = starts(i, rays, std::min(each[i], most_starts), settings.seed);
    });
    find_direct(rows.from, rays, settings, rows.other_share);
    return rows;
}

void DeepField::solve_rows(const RowStarts& rows, const HemisphereRays& rays, const DeepSettings& settings,
                           const RayNumbers& each)
{
    const std::size_t count = sites_.size();
    std::array<FixedPoint, replicates> systems;
    for (FixedPoint& system : systems) {
        system.known.resize(count);
        system.rows.resize(count);
    }
    // Shared out by what a first set has shown, rays are not to be that set again.
    const std::uint64_t seed = mix_bits(settings.seed, spread_.empty() ? ray_salt : second_ray_salt);
    // The rays use the direct light of all sites.
    parallel_for(count, settings.threads, [&](std::size_t i) {
        settings.check();
        for (std::size_t r = 0; r < replicates; ++r)
            trace_row(i, rows.from[i], rays, rows.other_share[i], {seed, r, each[i]}, systems[r]);
    });
    parallel_for(replicates, settings.threads, [&](std::size_t r) { ambient_[r] = solve(systems[r]); });
    find_spread(systems, each);
}

void DeepField::find_spread(const std::array<FixedPoint, replicates>& systems, const RayNumbers& each)
{
    std::vector<Spectrum> mean(sites_.size());
    for (std::size_t i = 0; i < mean.size(); ++i)
        for (const std::vector<Spectrum>& ambient : ambient_)
            mean[i] += ambient[i] / replicates;
    spread_.assign(sites_.size(), 0);
    for (std::size_t i = 0; i < mean.size(); ++i) {
        RunningStatistics brought;
        for (const FixedPoint& system : systems) {
            Spectrum sum = system.known[i];
            for (const Dependence& d : system.rows[i])
                sum += d.weight * mean[d.unknown];
            brought.add(photopic(sum));
        }
        spread_[i] = brought.standard_error() * std::sqrt(static_cast<double>(replicates * each[i]));
    }
}

DeepField::RayNumbers DeepField::same_number(const DeepSettings& settings) const
{
    return RayNumbers(sites_.size(), static_cast<std::size_t>(std::max(1, settings.rays / replicates)));
}

DeepField::RayNumbers DeepField::shared_out(const DeepSettings& settings) const
{
    constexpr double usual_share = 0.25;    // of the mean spread: none may rest on a few rays that happened to agree
    constexpr std::size_t most_rays = 4096; // a replicate: what a site's own extent leaves uncertain is not less
    double visits = 0, spread = 0, sum = 0;
    for (std::size_t i = 0; i < sites_.size(); ++i) {
        visits += visits_[i];
        spread += visits_[i] * spread_[i];
    }
    if (!(spread > 0))
        return same_number(settings);
    std::vector<double> wish(sites_.size());
    for (std::size_t i = 0; i < sites_.size(); ++i) {
        wish[i] = visits_[i] * (spread_[i] + usual_share * spread / visits);
        sum += wish[i];
    }
    RayNumbers each = same_number(settings);
    const double all = settings.work * static_cast<double>(each[0] * sites_.size());
    for (std::size_t i = 0; i < sites_.size(); ++i) {
        // Whole powers of two are spread most evenly.
        const std::size_t wished = std::bit_floor(static_cast<std::size_t>(std::sqrt(2.0) * all * wish[i] / sum) | 1);
        each[i] = std::clamp(wished, each[i], std::max(each[i], most_rays));
    }
    return each;
}

void DeepField::count_visits()
{
    visits_.assign(sites_.size(), 0);
    Weight around[most_weights];
    for (const SurfacePlace& place : candidates_) {
        const std::size_t count = weights(place.position, place.normal, around);
        for (std::size_t k = 0; k < count; ++k)
            visits_[around[k].site] += std::max(0.0, around[k].weight);
    }
}

void DeepField::solve_with(const HemisphereRays& rays, const DeepSettings& settings)
{
    constexpr int most_halvings = 2;
    const auto look = [&] {
        count_visits();
        return find_starts(rays, settings, same_number(settings));
    };
    RowStarts rows = look();
    if (narrow_peaks(rays, settings)) {
        place_uncovered(rays, settings);
        rows = look();
    }
    solve_rows(rows, rays, settings, same_number(settings));
    for (int n = 0; n < most_halvings && narrow_steep(); ++n) {
        place_uncovered(rays, settings);
        spread_.clear();
        rows = look();
        solve_rows(rows, rays, settings, same_number(settings));
    }
    candidates_ = {};
    if (settings.work > 1)
        refine(rays, settings);
}

void DeepField::refine(const HemisphereRays& rays, const DeepSettings& settings)
{
    const RayNumbers each = shared_out(settings);
    solve_rows(find_starts(rays, settings, each), rays, settings, each);
}

} // namespace lightwell
