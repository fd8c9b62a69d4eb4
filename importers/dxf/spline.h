#pragma once

#include "importers/dxf/shapes.h"

#include <vector>

namespace lightwell::dxf {

/// A curve of polynomial pieces, rational where it has weights.
struct Spline {
    int degree = 3;
    std::vector<double> knots;   ///< control.size() + degree + 1, never falling
    std::vector<Point> control;  ///< more than degree
    std::vector<double> weights; ///< > 0, one for each control point; empty: all 1
};

/// True when the counts and the knots fit each other.
bool is_sound(const Spline& spline);

/// Points on the curve from its start to its end, so many that the chords between them stay within the tolerance as
/// far as three points between each two can tell.
std::vector<Point> points_on(const Spline& spline, double chord_tolerance, Deviations& deviations);

/// Points on an ellipse.
/// @param major, minor  half axes as vectors
/// @param sweep_rad     counter-clockwise when positive
std::vector<Point> points_on_ellipse(const Point& centre, const Vec3& major, const Vec3& minor, double start_rad,
                                     double sweep_rad, double chord_tolerance, Deviations& deviations);

/// From one angle on to the next, counter-clockwise: equal angles are a full turn.
/// @return (0, 2 pi]
double sweep_between(double start_rad, double end_rad);

} // namespace lightwell::dxf
