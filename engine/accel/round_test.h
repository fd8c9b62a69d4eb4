#pragma once

#include "engine/scene/surface.h"

namespace lightwell {

/// The crossings of a ray with a curved surface, nearer first; t is NaN where there is none.
struct Crossings {
    double t[2] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
};

/// @param inverse_square  1 / |direction|^2, the same for all surfaces along a ray
Crossings sphere_hit(const Sphere& sphere, const Point& origin, const Vec3& direction, double inverse_square) noexcept;
/// Crossings with the side between the two ends.
Crossings cone_hit(const Cone& cone, const Point& origin, const Vec3& direction) noexcept;
/// The one crossing with the disc, outside its hole.
double ring_hit(const Ring& ring, const Point& origin, const Vec3& direction) noexcept;

/// Unit outward normals at a point of the surface.
Direction sphere_normal(const Sphere& sphere, const Point& at) noexcept;
Direction cone_normal(const Cone& cone, const Point& at) noexcept;

} // namespace lightwell
