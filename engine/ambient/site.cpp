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

/// Azimuth about the normal in sectors, counted from -frame_about(normal).x.
double sector_turn(const Frame& frame, const Vec3& way) noexcept
{
    return (std::atan2(dot(way, frame.y), dot(way, frame.x)) / (2 * pi) + 0.5) * horizon_sectors;
}

std::size_t horizon_sector(const Frame& frame, const Vec3& way) noexcept
{
    return static_cast<std::size_t>(std::min(horizon_sectors - 1, static_cast<int>(sector_turn(frame, way))));
}

/// Whether something that stands on the surface may lie between the site and a place this far away. Rays go out at a
/// quarter and at three quarters of each sector. A straight wall is met nearer by the next ray towards its foot, which
/// is in the sector of the place or in the one nearest to it, than at the place's own azimuth; next to the foot it is
/// met farther away by the cosine of half the angle between two rays.
bool beyond_horizon(const AmbientSite& site, const Vec3& way, double flat_m) noexcept
{
    constexpr double next_to_foot = 0.995; // cosine of 5.625 degrees
    if (!(flat_m > next_to_foot * site.least_horizon_m))
        return false;
    const Frame frame = frame_about(site.normal);
    const std::size_t sector = horizon_sector(frame, way);
    const bool upper_half = std::fmod(sector_turn(frame, way), 1.0) > 0.5;
    const std::size_t beside = (sector + (upper_half ? 1 : horizon_sectors - 1)) % horizon_sectors;
    const auto nearest = static_cast<double>(std::min(site.horizon_m[sector], site.horizon_m[beside]));
    return flat_m > next_to_foot * nearest;
}

double length_across(const Vec3& way, const Direction& normal) noexcept
{
    const double off = dot(way, normal);
    return std::sqrt(std::fmax(0, dot(way, way) - off * off));
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
    float& horizon = site.horizon_m[horizon_sector(frame_about(site.normal), direction)];
    horizon = std::min(horizon, static_cast<float>(met.distance_m * length_across(direction, site.normal)));
    site.least_horizon_m = std::min(site.least_horizon_m, static_cast<double>(horizon));
}

} // namespace lightwell
