#include "engine/ambient/ambient_cache.h"

#include "engine/base/threads.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

/// A candidate nearer to a record than this share of its reach needs none of its own.
constexpr double covered_share = 0.7;
/// Reach stays within these multiples of accuracy * harmonic mean distance, whatever the Hessian says: it is noisy.
constexpr double least_multiple = 0.5, most_multiple = 5;
/// ... and of the larger of the two, across.
constexpr double most_stretch = 3;
/// ... and in footprints.
constexpr double least_footprints = 6;
/// How much farther than its reach a record still answers where no other does.
constexpr double widening = 3;
/// Predicted change within the reach, relative.
constexpr double most_change = 0.5;
/// Keep random numbers of rays and of shadow rays apart.
constexpr std::uint64_t record_salt = 0x7265636f, direct_salt = 0x64697265;

/// Rows and columns for about `cells` cells, powers of two, so that a stratified run has one ray in each.
void shape(int cells, int& rows, int& columns)
{
    rows = 2;
    columns = 4;
    while (2 * rows * columns <= cells) {
        if (columns <= 2 * rows)
            columns *= 2;
        else
            rows *= 2;
    }
}

int cell_of(UnitSquare u, const Hemisphere& h)
{
    return static_cast<int>(u.u * h.rows) * h.columns + static_cast<int>(u.v * h.columns);
}

void set_reach(AmbientRecord& record, const Hemisphere& mean, double footprint_m, double size_m,
               const CacheSettings& settings)
{
    AmbientSite& site = record.site;
    site.harmonic_m = std::min(harmonic_distance_m(mean), open_share * size_m);
    const double base = settings.accuracy * site.harmonic_m;
    site.reach_m[0] = site.reach_m[1] = base;
    const double level = photopic(record.irradiance);
    if (settings.hessian && level > 0) {
        const IrradianceHessian hessian = hessian_of(mean);
        site.axis = hessian.axis;
        for (int k = 0; k < 2; ++k) {
            const double reach = std::sqrt(2 * settings.accuracy * level / std::fabs(hessian.value[k]));
            site.reach_m[k] = std::clamp(reach, least_multiple * base, most_multiple * base);
        }
        site.reach_m[1] = std::min(site.reach_m[1], most_stretch * site.reach_m[0]);
    }
    if (settings.gradients && level > 0) {
        const double slope = length(record.gradient.translation[1]);
        for (double& reach : site.reach_m)
            reach = slope > 0 ? std::min(reach, most_change * level / slope) : reach;
    }
    for (double& reach : site.reach_m)
        reach = std::max(reach, least_footprints * footprint_m);
}

double lamp_share_at(const SurfacePlace& place, std::uint64_t key, const HemisphereRays& rays, std::uint64_t seed)
{
    constexpr std::uint32_t tests = 4;
    double share = 0;
    for (std::uint32_t n = 0; n < tests; ++n) {
        PathRandom random(mix_bits(seed, direct_salt), key, n);
        share += rays.direct(place, random).lamp_share / tests;
    }
    return share;
}

/// Within its reach a record never tells of more change than its own value: near corners gradients are noisy, and the
/// least reach may be longer than they hold.
void limit_gradient(AmbientRecord& record)
{
    const double reach = std::max(record.site.reach_m[0], record.site.reach_m[1]);
    for (int c = 0; c < 3; ++c) {
        Vec3& slope = record.gradient.translation[c];
        const double change = length(slope) * reach, most = most_change * record.irradiance[c];
        if (change > most)
            slope = slope * (most / change);
    }
}

} // namespace

bool AmbientCache::covers(const SurfacePlace& place) const noexcept
{
    bool covered = false;
    tree_.near(place.position, [&](std::uint32_t i) {
        covered = covered || site_distance(sites_[i], place.position, place.normal) < covered_share;
    });
    return covered;
}

AmbientRecord AmbientCache::trace(const AmbientCandidate& candidate, std::uint64_t key, const HemisphereRays& rays,
                                  double size_m, const CacheSettings& settings) const
{
    const SurfacePlace& place = candidate.place;
    AmbientRecord record;
    record.site.position = place.position;
    record.site.normal = place.normal;
    const Frame frame = frame_about(place.normal);
    record.site.axis = frame.x;
    look_around(record.site, place, rays);
    int rows = 0, columns = 0;
    shape(std::max(8, settings.rays / replicates), rows, columns);
    const int each = rows * columns;
    Hemisphere mean(frame, rows, columns);
    std::array<double, replicates> photopic_of{};
    std::vector<Dependence> dependences;
    const double other_share = 1 - std::min(1.0, lamp_share_at(place, key, rays, settings.seed));
    for (int r = 0; r < replicates; ++r) {
        Spectrum sum;
        int others = 0;
        for (std::uint32_t n = 0; n < static_cast<std::uint32_t>(each); ++n) {
            PathRandom random(mix_bits(mix_bits(settings.seed, record_salt), static_cast<std::uint64_t>(r)), key, n);
            const UnitSquare u = random.pair();
            const Direction direction = hemisphere_direction(frame, u);
            dependences.clear();
            const Arrival arrival = rays.arrive(place, direction, random, dependences);
            const Spectrum later = deep_.sum(dependences, r);
            sum += arrival.irradiance + later;
            others += arrival.met_lamp ? 0 : 1;
            const auto cell = static_cast<std::size_t>(cell_of(u, mean));
            mean.radiance[cell] += (arrival.radiance + later / pi) / replicates;
            mean.closeness_per_m[cell] += 1 / (arrival.met.distance_m * replicates);
            add_horizon(record.site, direction, arrival.met);
        }
        // How much of the hemisphere shows lamps is known better from shadow rays than from these.
        sum = others > 0 ? sum * (other_share / others) : Spectrum{};
        record.irradiance += sum / replicates;
        photopic_of[static_cast<std::size_t>(r)] = photopic(sum);
    }
    for (std::size_t r = 0; r < replicates; ++r)
        record.deviation[r] = static_cast<float>(photopic_of[r] - photopic(record.irradiance));
    if (settings.gradients)
        record.gradient = gradient_of(mean);
    set_reach(record, mean, candidate.footprint_m, size_m, settings);
    limit_gradient(record);
    return record;
}

void AmbientCache::clamp_to_neighbours(AmbientRecord& record)
{
    // The triangle inequality: what is near a neighbour cannot be far from here.
    const auto shrink = [](AmbientSite& site, double harmonic_m) {
        const double ratio = harmonic_m / site.harmonic_m;
        site.harmonic_m = harmonic_m;
        site.reach_m[0] *= ratio;
        site.reach_m[1] *= ratio;
    };
    tree_.near(record.site.position, [&](std::uint32_t i) {
        const double apart = length(sites_[i].position - record.site.position);
        if (sites_[i].harmonic_m + apart < record.site.harmonic_m)
            shrink(record.site, sites_[i].harmonic_m + apart);
    });
}

void AmbientCache::insert(std::vector<AmbientRecord>&& records)
{
    if (records.empty())
        return;
    for (AmbientRecord& record : records) {
        sites_.push_back(record.site);
        records_.push_back(std::move(record));
    }
    tree_.build(sites_);
}

void AmbientCache::complete()
{
    wide_ = sites_;
    for (AmbientSite& site : wide_)
        for (double& reach : site.reach_m)
            reach *= widening;
    wide_tree_.build(wide_);
}

void AmbientCache::add(std::vector<AmbientRecord> records)
{
    insert(std::move(records)); // clamped when they were made: a run that takes up its own records has the same bits
}

std::size_t AmbientCache::grow(const std::vector<AmbientCandidate>& candidates, const HemisphereRays& rays,
                               double size_m, const CacheSettings& settings)
{
    std::vector<char> wanted(candidates.size());
    parallel_for(candidates.size(), settings.threads, [&](std::size_t i) { wanted[i] = !covers(candidates[i].place); });
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < candidates.size() && records_.size() + chosen.size() < settings.most_records; ++i)
        if (wanted[i])
            chosen.push_back(i);
    std::vector<AmbientRecord> made(chosen.size());
    parallel_for(chosen.size(), settings.threads, [&](std::size_t k) {
        settings.check();
        made[k] = trace(candidates[chosen[k]], records_.size() + k, rays, size_m, settings);
    });
    for (AmbientRecord& record : made)
        clamp_to_neighbours(record);
    insert(std::move(made));
    return chosen.size();
}

bool AmbientCache::mean_around(const SiteTree& tree, const std::vector<AmbientSite>& sites, double widened,
                               const Point& at, const Direction& normal, CachedAmbient& found) const noexcept
{
    double total = 0;
    Spectrum sum;
    found.deviation.fill(0);
    tree.near(at, [&](std::uint32_t i) {
        const double distance = site_distance(sites[i], at, normal);
        if (!(distance < 1))
            return;
        const AmbientRecord& record = records_[i];
        const double weight = (1 - distance) * (1 - distance);
        // Beyond the reach the gradient says no more than at its edge.
        const Vec3 way = (at - record.site.position) / std::fmax(1, widened * distance);
        const Vec3 turn = cross(record.site.normal, normal);
        const IrradianceGradient& g = record.gradient;
        Spectrum here = record.irradiance;
        const auto step = [&](int c) { return dot(way, g.translation[c]) + dot(turn, g.rotation[c]); };
        here += Spectrum{step(0), step(1), step(2)};
        sum += Spectrum{std::fmax(0, here.r), std::fmax(0, here.g), std::fmax(0, here.b)} * weight;
        for (std::size_t r = 0; r < replicates; ++r)
            found.deviation[r] += weight * static_cast<double>(record.deviation[r]);
        total += weight;
    });
    if (!(total > 0))
        return false;
    found.irradiance = sum / total;
    for (double& d : found.deviation)
        d /= total;
    return true;
}

bool AmbientCache::irradiance(const Point& at, const Direction& normal, CachedAmbient& found) const noexcept
{
    return mean_around(tree_, sites_, 1, at, normal, found) ||
           mean_around(wide_tree_, wide_, widening, at, normal, found);
}

} // namespace lightwell
