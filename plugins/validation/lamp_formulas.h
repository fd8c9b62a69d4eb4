#pragma once

#include "engine/base/vector.h"

#include <vector>

namespace lightwell {

// Closed forms for light that comes straight from a lamp. Illuminance in lx for luminances in cd/m^2; form factors
// are fractions of the exitance. Nothing here uses the engine's transport.

/// The part of a polygon in front of the plane through the origin with this normal.
/// Source  Sutherland, Hodgman 1974
std::vector<Vec3> front_part(const std::vector<Vec3>& corners, const Vec3& normal);
/// Uniform polygon, clipped at the receiver's horizon; seams to holes cancel.
/// Error: 1e-14 / form factor
/// Source  Lambert 1760: E = L/2 sum Theta_i n . (v_i x v_i+1) / |v_i x v_i+1|
double polygon_illuminance(const std::vector<Point>& corners, double luminance, const Point& at,
                           const Direction& normal);
/// Uniform disc that faces a parallel plane at height `height`, at distance `aside` from its axis.
/// Source  Howell catalogue B-15: F = (1 - (a^2 + h^2 - R^2) / sqrt((a^2 + h^2 + R^2)^2 - 4 a^2 R^2)) / 2
double disc_illuminance(double radius, double height, double aside, double luminance);
/// Uniform sphere, its centre `distance` away and `tilt_rad` off the receiver's normal, cut by its horizon.
/// Source  Howell catalogue B-43
double sphere_illuminance(double radius, double distance, double tilt_rad, double luminance);
/// Lambertian line parallel to the receiver, its ends at -half and half along the axis, above the plane by `height`.
/// @param strength  luminous intensity per metre across the line, cd/m: luminance times the tube's diameter
/// Source  E = I' / (2 h) [beta + sin beta cos beta], beta seen from the receiver between the ends
double line_illuminance(double half_length, double height, double along, double strength);
/// Sun of a given half angle, its direction on the receiver's normal: E = pi L sin^2(half angle).
double sun_illuminance(double half_angle_rad, double luminance);
/// Part of a flat disc that a straight edge leaves free, by the edge's distance from the centre in radii.
double free_part_of_disc(double edge);

/// Opposite equal rectangles x by y at distance z.  Source  Howell catalogue C-11
double parallel_rectangles(double x, double y, double z);
/// From a rectangle of depth w to a perpendicular one of height h with the common edge l.  Source  Howell C-14
double perpendicular_rectangles(double l, double w, double h);
/// From a disc of radius r1 to a coaxial one of radius r2 at distance h.  Source  Howell catalogue C-41
double coaxial_discs(double r1, double r2, double h);

} // namespace lightwell
