#include "engine/ambient/site.h"

#include "engine/base/frame.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

/// Normals that differ by more are too far apart whatever the distance.
constexpr double least_cosine = 0.94; // 20 degrees
/// Offset out of the mean plane of site and place, as a share of the distance between them, that still is the same
/// surface: two places of a sphere have none. The floor of a room above open ground must not take the ground's light.
constexpr double most_offset = 0.01;
/// ... and, for places close to the site, as a share of the reach.
constexpr double rounding = 1e-6;

/// Where a level direction lies among the sectors: rises as its azimuth does, by a quarter of the sectors in each
/// quadrant, without the cost of an angle. Sectors next to the axes are a little narrower than those between.
double sector_turn(double x, double y) noexcept
{
    const double sum = std::fabs(x) + std::fabs(y);
    if (!(sum > 0))
        return 0;
    const double quadrants = x > 0 ? (y >= 0 ? y : 4 * sum + y) / sum : (2 * sum - y) / sum;
    return quadrants * (horizon_sectors / 4);
}

std::size_t sector_at(double turn) noexcept
{
    return static_cast<std::size_t>(std::min(horizon_sectors - 1, static_cast<int>(turn)));
}

/// Whether something that stands on the surface may lie between the site and a place this far away. Rays go out at a
/// quarter and at three quarters of each sector; what they met stands on a line, whose course beyond them is known
/// from the normal there. The ray nearest to the place is in its own sector or in the one beside it.
bool beyond_horizon(const AmbientSite& site, const Vec3& way, double flat_m) noexcept
{
    constexpr double nearly = 0.999; // of the distance: rounding of what was kept
    if (!(flat_m > nearly * site.least_horizon_m))
        return false;
    const Frame frame = frame_about(site.normal);
    const double x = dot(way, frame.x), y = dot(way, frame.y);
    const double turn = sector_turn(x, y);
    const std::size_t sector = sector_at(turn);
    const bool upper_half = turn - static_cast<double>(sector) > 0.5;
    const std::size_t beside = (sector + (upper_half ? 1 : horizon_sectors - 1)) % horizon_sectors;
    const auto behind = [&](const Horizon& h) {
        return x * double{h.into_x} + y * double{h.into_y} > nearly * double{h.distance_m};
    };
    return behind(site.horizon[sector]) || behind(site.horizon[beside]);
}

double length_across(const Vec3& way, const Direction& normal) noexcept
{
    const double off = dot(way, normal);
    return std::sqrt(std::fmax(0, dot(way, way) - off * off));
}

/// What was met is taken as a plane that goes down to the site's surface; what hangs over it, as a wall square to the
/// ray.
Horizon foot_of(const Frame& frame, const Vec3& offset, const Direction& normal) noexcept
{
    constexpr double least_upright = 0.5; // of the normal's length, level
    const double up = dot(normal, frame.z);
    Vec3 into{-dot(normal, frame.x), -dot(normal, frame.y), 0};
    const double upright = length(into);
    Horizon foot;
    double distance_m = 0;
    if (upright > least_upright && up > -least_upright) {
        into = into / upright;
        distance_m = -dot(offset, normal) / upright;
    } else {
        into = {dot(offset, frame.x), dot(offset, frame.y), 0};
        distance_m = length(into);
        into = into / distance_m;
    }
    foot.distance_m = static_cast<float>(std::fmax(0, distance_m));
    foot.into_x = static_cast<float>(into.x);
    foot.into_y = static_cast<float>(into.y);
    return foot;
}

} // namespace

double site_distance(const AmbientSite& site, const Point& at, const Direction& normal) noexcept
{
    const Vec3 way = at - site.position;
    const double longest = std::max(site.reach_m[0], site.reach_m[1]);
    if (!(dot(way, way) < 1.01 * longest * longest))
        return infinity;
    const double cosine = dot(normal, site.normal);
    if (!(cosine > least_cosine))
        return infinity;
    const double along = dot(way, site.axis) / site.reach_m[0];
    const double across = dot(way, cross(site.normal, site.axis)) / site.reach_m[1];
    const double turn = (1 - cosine) / (1 - least_cosine);
    const double squared = along * along + across * across + turn;
    if (!(squared < 1))
        return infinity;
    const double offset = 0.5 * (dot(way, normal) + dot(way, site.normal));
    const double flat = length_across(way, site.normal);
    if (std::fabs(offset) > most_offset * flat + rounding * longest || beyond_horizon(site, way, flat))
        return infinity;
    return std::sqrt(squared);
}

void add_horizon(AmbientSite& site, const Direction& direction, const Met& met) noexcept
{
    constexpr double steepest = 0.70710678118654752; // sine of 45 degrees: what stands higher hides nothing here
    if (!std::isfinite(met.distance_m) || dot(direction, site.normal) > steepest ||
        dot(met.normal, site.normal) > least_cosine)
        return;
    const Frame frame = frame_about(site.normal);
    Horizon& horizon = site.horizon[sector_at(sector_turn(dot(direction, frame.x), dot(direction, frame.y)))];
    const double met_m = met.distance_m * length_across(direction, site.normal);
    if (met_m >= double{horizon.met_m})
        return;
    horizon = foot_of(frame, direction * met.distance_m, met.normal);
    horizon.met_m = static_cast<float>(met_m);
    site.least_horizon_m = std::min(site.least_horizon_m, static_cast<double>(horizon.distance_m));
}

} // namespace lightwell
