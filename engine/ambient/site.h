#pragma once

#include "engine/transport/hemisphere_rays.h"

#include <array>
#include <limits>

namespace lightwell {

/// Directions within a surface, by which a record knows what stands around it.
inline constexpr int horizon_sectors = 16;

/// The line along which something meets the site's surface, or would if it reached down to it.
struct Horizon {
    float distance_m = std::numeric_limits<float>::infinity(); ///< from the site, square to the line
    float into_x = 1, into_y = 0; ///< unit vector to the line, in the axes of frame_about(normal)
    float met_m = std::numeric_limits<float>::infinity(); ///< how far off, seen from above, it was met
};

/// Where a value of ambient irradiance is known, and how far it holds.
struct AmbientSite {
    Point position;
    Direction normal;                             ///< on the side that receives
    Direction axis;                               ///< in the surface, along reach_m[0]; reach_m[1] lies across
    double reach_m[2] = {0, 0};                   ///< distances at which the value stops being used
    double harmonic_m = 0;                        ///< harmonic mean distance to other surfaces, cosine-weighted
    double least_horizon_m = infinity;            ///< nearest of the lines
    std::array<Horizon, horizon_sectors> horizon; ///< of what was met nearest in each sector
};

/// How far a place is from a site in terms of the site's reach: below 1 its value may be used.
/// Distance in the surface over the reach and turn of the normal add up as squares. A place behind or before the
/// site's plane, or beyond something that stands on the surface between the two, is infinitely far: light must not
/// leak under doors or from one shelf to the next.
/// Source  Ward, Rubinstein, Clear 1988 (split-sphere error), with the ellipse of Schwarzhaupt et al. 2012 in
///         place of the circle
double site_distance(const AmbientSite& site, const Point& at, const Direction& normal) noexcept;

/// Notes what a ray from the site met: what it met below 45 degrees may stand between the site and a place, unless it
/// is the surface itself that bends up.
void add_horizon(AmbientSite& site, const Direction& direction, const Met& met) noexcept;

} // namespace lightwell
