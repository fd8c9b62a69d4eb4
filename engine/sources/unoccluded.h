#pragma once

#include "engine/base/vector.h"

namespace lightwell {

/// Irradiance that a surface of uniform radiance gives at the origin when nothing is in the way, for a radiance of 1:
/// the projected solid angle above the horizon, sr. Shapes are given relative to the receiver.

/// A flat polygon, seen from either side; concave outlines are right as a sum over their triangles.
/// @param corners  in order, at most most_clipped_corners - 1
/// Error: relative 1e-6 down to 1e-9 sr and sources that reach the horizon (tests/unit/sources)
/// Source  Lambert 1760; clipped to the horizon edge by edge
double polygon_irradiance(const Vec3* corners, int count, const Direction& normal) noexcept;
inline constexpr int most_clipped_corners = 8;

/// A sphere, the receiver outside of it.
/// Source  Howell, catalogue of configuration factors, B-43 (element to sphere, any tilt)
double sphere_irradiance(const Vec3& to_centre, double radius_m, const Direction& normal) noexcept;

/// A disc that lies wholly above the horizon.
/// @param axis  of the disc, unit, towards the receiver's side
/// Source  Howell, catalogue of configuration factors, B-12 and B-13 (element to disc), added as the two components of
///         the vector irradiance
double disc_irradiance(const Vec3& to_centre, const Direction& axis, double radius_m, const Direction& normal) noexcept;

} // namespace lightwell
