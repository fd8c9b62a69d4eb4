#include "engine/ambient/deep_field.h"

#include "engine/ambient/fixed_point.h"
#include "engine/ambient/hemisphere.h"
#include "engine/base/threads.h"
#include "engine/sampling/statistics.h"
#include "engine/sampling/warps.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

/// Rays that tell a site's surroundings before its light is asked for.
constexpr int survey_rays = 32;
/// A candidate nearer to a site than this share of its reach needs no site of its own: the rest is overlap, for
/// smoothness.
constexpr double covered_share = 0.65;
/// Candidates looked at together; sites among them are surveyed in parallel.
constexpr std::size_t first_batch = 64, largest_batch = 1024;
/// Keeps random numbers of surveys and of looks for peaks apart.
constexpr std::uint64_t survey_salt = 0x73757276, peak_salt = 0x7065616b;

AmbientSite surveyed(const SurfacePlace& place, std::uint64_t key, const HemisphereRays& rays, double size_m,
                     const DeepSettings& settings)
{
    AmbientSite site;
    site.position = place.position;
    site.normal = place.normal;
    const Frame frame = frame_about(place.normal);
    site.axis = frame.x;
    double closeness = 0;
    for (std::uint32_t i = 0; i < survey_rays; ++i) {
        PathRandom random(mix_bits(settings.seed, survey_salt), key, i);
        const Direction direction = hemisphere_direction(frame, random.pair());
        const Met met = rays.meet(place, direction);
        closeness += 1 / met.distance_m;
        add_horizon(site, direction, met);
    }
    look_around(site, place, rays);
    site.harmonic_m = std::min(closeness > 0 ? survey_rays / closeness : infinity, open_share * size_m);
    site.reach_m[0] = site.reach_m[1] = settings.reach_share * site.harmonic_m;
    return site;
}

/// Makes a site's reach smaller where lamps light it as unevenly as nothing else: the light that comes back from
/// things nearby is as uneven, and a mean over more than that would put it where it is not.
/// @param bright_W_per_m2  photopic; darker places are left as they are
/// @return  whether it was too wide
bool narrow_to_peak(AmbientSite& site, const SurfacePlace& centre, std::uint64_t key, double bright_W_per_m2,
                    const HemisphereRays& rays, std::uint64_t seed)
{
    constexpr int most_halvings = 5;
    constexpr std::uint32_t looks = 8;
    constexpr double most_ratio = 6; // of the brightest to the dimmest
    for (int n = 0; n < most_halvings; ++n) {
        double brightest = 0, dimmest = infinity;
        for (std::uint32_t k = 0; k < looks; ++k) {
            PathRandom random(mix_bits(seed, peak_salt), key, looks * static_cast<std::uint32_t>(n) + k);
            SurfacePlace there = centre;
            if (k > 0 && !place_around(site, centre, rays, random, there))
                continue;
            const double lit = photopic(rays.direct(there, random).lamps);
            brightest = std::max(brightest, lit);
            dimmest = std::min(dimmest, lit);
        }
        if (!(brightest > bright_W_per_m2 && brightest > most_ratio * dimmest))
            return n > 0;
        site.reach_m[0] *= 0.5;
        site.reach_m[1] *= 0.5;
    }
    return true;
}

void limit_reach(AmbientSite& site, double most_m)
{
    site.reach_m[0] = std::min(site.reach_m[0], most_m);
    site.reach_m[1] = std::min(site.reach_m[1], most_m);
}

/// Tilts the weights so that values which change linearly over the surface are met exactly, as far as that leaves no
/// weight below -most_negative of what it was: beyond the last site a line may be followed a little, not far.
/// @param ways  to the sites
/// Source  Lancaster, Salkauskas 1981 (moving least squares)
void make_linear(const Direction& normal, const Vec3* ways, std::size_t count, DeepField::Weight* weights)
{
    constexpr double most_negative = 0.5;
    constexpr double damping = 0.01; // of the mean square distance: two sites or a row of them leave a direction open
    const Frame frame = frame_about(normal);
    double sum = 0, a = 0, b = 0, aa = 0, ab = 0, bb = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double w = weights[i].weight, x = dot(ways[i], frame.x), y = dot(ways[i], frame.y);
        sum += w;
        a += w * x;
        b += w * y;
        aa += w * x * x;
        ab += w * x * y;
        bb += w * y * y;
    }
    a /= sum, b /= sum, aa /= sum, ab /= sum, bb /= sum;
    // Weights w (1 - tilt . (way - mean)): the mean way becomes mean - covariance tilt, which is to be zero.
    const double xx = aa - a * a, xy = ab - a * b, yy = bb - b * b, slack = damping * (aa + bb);
    const double determinant = (xx + slack) * (yy + slack) - xy * xy;
    const double tilt_x = determinant > 0 ? (a * (yy + slack) - b * xy) / determinant : 0;
    const double tilt_y = determinant > 0 ? (b * (xx + slack) - a * xy) / determinant : 0;
    double steepest = 0;
    for (std::size_t i = 0; i < count; ++i)
        steepest = std::max(steepest, tilt_x * (dot(ways[i], frame.x) - a) + tilt_y * (dot(ways[i], frame.y) - b));
    const double share = steepest > 1 + most_negative ? (1 + most_negative) / steepest : 1;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = dot(ways[i], frame.x) - a, y = dot(ways[i], frame.y) - b;
        weights[i].weight *= (1 - share * (tilt_x * x + tilt_y * y)) / sum;
    }
}

} // namespace

bool place_around(const AmbientSite& site, const SurfacePlace& centre, const HemisphereRays& rays, PathRandom& random,
                  SurfacePlace& found)
{
    constexpr double lift_share = 0.1; // of the reach: as far as a site answers off its plane
    const Frame frame = frame_about(site.normal);
    const DiscPoint disc = uniform_disc(random.pair());
    const Vec3 offset = (frame.x * disc.x + frame.y * disc.y) * site.reach_m[0];
    return rays.beside(centre, offset, lift_share * site.reach_m[0], found);
}

void look_around(AmbientSite& site, const SurfacePlace& place, const HemisphereRays& rays)
{
    constexpr int rays_a_sector = 2;
    constexpr double rise = 0.03; // tangent of the rays' slope: over the unevenness of the ground, not over a wall
    const Frame frame = frame_about(site.normal);
    for (int i = 0; i < rays_a_sector * horizon_sectors; ++i) {
        const double turn = 2 * pi * (i + 0.5) / (rays_a_sector * horizon_sectors);
        const Direction direction = normalized(frame.to_world({std::cos(turn), std::sin(turn), rise}));
        add_horizon(site, direction, rays.meet(place, direction));
    }
}

bool DeepField::covers(const Point& at, const Direction& normal) const noexcept
{
    bool covered = false;
    tree_.near(at, [&](std::uint32_t i) { covered = covered || site_distance(sites_[i], at, normal) < covered_share; });
    return covered;
}

void DeepField::place(const std::vector<SurfacePlace>& candidates, const HemisphereRays& rays, double size_m,
                      const DeepSettings& settings)
{
    candidates_ = candidates;
    size_m_ = size_m;
    steep_.clear();
    steep_tree_.build(steep_);
    bright_W_per_m2_ = infinity;
    place_uncovered(rays, settings);
}

void DeepField::place_uncovered(const HemisphereRays& rays, const DeepSettings& settings)
{
    std::size_t batch = first_batch;
    for (std::size_t first = 0; first < candidates_.size() && sites_.size() < settings.most_sites; first += batch) {
        if (first > 0)
            batch = std::min(2 * batch, largest_batch);
        const std::size_t count = std::min(batch, candidates_.size() - first);
        std::vector<AmbientSite> surveys(count);
        parallel_for(count, settings.threads, [&](std::size_t i) {
            settings.check();
            const SurfacePlace& r = candidates_[first + i];
            if (covers(r.position, r.normal))
                return;
            surveys[i] = surveyed(r, first + i, rays, size_m_, settings);
            steep_tree_.near(r.position, [&](std::uint32_t k) {
                if (site_distance(steep_[k], r.position, r.normal) < 1)
                    limit_reach(surveys[i], 0.5 * steep_[k].reach_m[0]);
            });
            if (std::isfinite(bright_W_per_m2_))
                narrow_to_peak(surveys[i], r, first + i, bright_W_per_m2_, rays, settings.seed);
        });
        const std::size_t before = sites_.size();
        for (std::size_t i = 0; i < count && sites_.size() < settings.most_sites; ++i) {
            const AmbientSite& site = surveys[i];
            const bool usable = site.reach_m[0] > 0;
            const bool covered = std::any_of(
                sites_.begin() + static_cast<std::ptrdiff_t>(before), sites_.end(),
                [&](const AmbientSite& s) { return site_distance(s, site.position, site.normal) < covered_share; });
            if (!usable || covered)
                continue;
            sites_.push_back(site);
            places_.push_back(candidates_[first + i]);
        }
        tree_.build(sites_);
    }
}

void DeepField::restore(DeepSolution&& solution)
{
    sites_ = std::move(solution.sites);
    ambient_ = std::move(solution.ambient);
    direct_ = std::move(solution.direct);
    visits_ = std::move(solution.visits);
    tested_share_ = std::move(solution.tested_share);
    lit_W_per_m2_ = std::move(solution.lit_W_per_m2);
    places_.clear();
    tree_.build(sites_);
    find_bright();
}

void DeepField::find_bright()
{
    std::vector<BrightDiscs::Lit> lit;
    for (std::size_t i = 0; i < sites_.size(); ++i)
        lit.push_back(
            {sites_[i].position, sites_[i].normal, covered_share * sites_[i].reach_m[0], lit_W_per_m2_[i], visits_[i]});
    bright_ = BrightDiscs(std::move(lit));
}

std::size_t DeepField::weights(const Point& at, const Direction& normal, Weight* found) const noexcept
{
    Vec3 ways[most_weights];
    std::size_t count = 0;
    tree_.near(at, [&](std::uint32_t i) {
        const double distance = site_distance(sites_[i], at, normal);
        if (distance < 1 && count < most_weights) {
            ways[count] = sites_[i].position - at;
            found[count++] = {i, 1 - distance};
        }
    });
    make_linear(normal, ways, count, found);
    return count;
}

bool DeepField::narrow_peaks(const HemisphereRays& rays, const DeepSettings& settings)
{
    constexpr double bright = 8; // times the mean: what is less of a peak moves too little light to matter
    double light = 0, area = 0;
    for (std::size_t i = 0; i < sites_.size(); ++i) {
        const double share = sites_[i].reach_m[0] * sites_[i].reach_m[0];
        light += photopic(direct_[i]) * share;
        area += share;
    }
    const double limit = bright * light / area;
    std::vector<char> narrowed(sites_.size());
    parallel_for(sites_.size(), settings.threads, [&](std::size_t i) {
        if (light > 0 && brightest_[i] > limit)
            narrowed[i] = narrow_to_peak(sites_[i], places_[i], i, limit, rays, settings.seed) ? 1 : 0;
    });
    const bool any = std::find(narrowed.begin(), narrowed.end(), 1) != narrowed.end();
    if (any) {
        bright_W_per_m2_ = limit;
        tree_.build(sites_);
    }
    return any;
}

bool DeepField::narrow_steep()
{
    constexpr double steep = 1.5;        // times dimmer at another site within reach
    constexpr double usual_noise = 3;    // in standard errors
    constexpr double least_light = 1e-3; // of the mean: darker places light nothing
    std::vector<RunningStatistics> light(sites_.size());
    double mean = 0;
    for (std::size_t i = 0; i < sites_.size(); ++i) {
        for (const std::vector<Spectrum>& ambient : ambient_)
            light[i].add(photopic(ambient[i]));
        mean += light[i].mean() / static_cast<double>(sites_.size());
    }
    constexpr double least_area = 0.02; // of all sites: the rays of the field are not traced again for less
    std::vector<std::size_t> found;
    double area = 0, found_area = 0;
    for (std::size_t i = 0; i < sites_.size(); ++i) {
        const double covered = sites_[i].reach_m[0] * sites_[i].reach_m[0];
        area += covered;
        bool changes = false;
        tree_.near(sites_[i].position, [&](std::uint32_t k) {
            const double bright = std::max(light[i].mean(), light[k].mean());
            const double dim = std::max(std::min(light[i].mean(), light[k].mean()), least_light * mean);
            const double noise = std::hypot(light[i].standard_error(), light[k].standard_error());
            changes = changes || (bright > steep * dim && bright - dim > usual_noise * noise &&
                                  site_distance(sites_[k], sites_[i].position, sites_[i].normal) < 1);
        });
        if (changes) {
            found.push_back(i);
            found_area += covered;
        }
    }
    if (found_area <= least_area * area)
        return false;
    for (const std::size_t i : found) {
        steep_.push_back(sites_[i]);
        limit_reach(sites_[i], 0.5 * sites_[i].reach_m[0]);
    }
    steep_tree_.build(steep_);
    tree_.build(sites_);
    return true;
}

Spectrum DeepField::sum(const std::vector<Dependence>& dependences, int replicate) const noexcept
{
    Spectrum sum;
    for (const Dependence& d : dependences)
        sum += d.weight * ambient(d.unknown, replicate);
    return sum;
}

} // namespace lightwell
