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

/// Sector of a direction about the normal, counted from frame_about(normal).x.
std::size_t horizon_sector(const Frame& frame, const Vec3& way) noexcept
{
    const double turn = std::atan2(dot(way, frame.y), dot(way, frame.x)) / (2 * pi) + 0.5;
    return static_cast<std::size_t>(std::min(horizon_sectors - 1, static_cast<int>(turn * horizon_sectors)));
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
    if (std::fabs(offset) > most_offset * flat + rounding * longest)
        return infinity;
    if (flat > site.least_horizon_m && flat > site.horizon_m[horizon_sector(frame_about(site.normal), way)])
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
