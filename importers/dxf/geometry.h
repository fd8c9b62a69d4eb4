#pragma once

#include "engine/base/transform.h"
#include "engine/base/vector.h"
#include "engine/scene/sector.h"

#include <span>

namespace lightwell::dxf {

/// The object coordinate system of an extrusion direction: turns object coordinates into world coordinates.
/// Source  Autodesk DXF reference, "Arbitrary axis algorithm"
/// @param extrusion  need not be a unit vector; zero counts as z
Affine object_axes(const Vec3& extrusion);

/// A circular arc in the plane, from start_rad by sweep_rad (counter-clockwise when positive).
struct Arc {
    Point centre;
    double radius;
    double start_rad;
    double sweep_rad;

    /// @param fraction  0 at the start, 1 at the end
    Point at(double fraction) const;
    /// Unit vector from the centre towards at(fraction).
    Vec3 outward(double fraction) const;
    /// About the z axis of `axes`, which turn the arc's plane into the model.
    Sector sector(const Affine& axes) const;
};

/// The arc between two different points with the bulge tan(sweep / 4).
Arc arc_of_bulge(const Point& from, const Point& to, double bulge);

/// Number of equal chords that stay within the tolerance of an arc, at most 4096 for a full turn.
/// @param tolerance  > 0, in the unit of the radius
int chord_count(double radius, double sweep_rad, double tolerance);
/// Largest distance between an arc and its chords: r (1 - cos(sweep / 2n)).
double chord_error(double radius, double sweep_rad, int chords);

/// Largest distance of the corners from their mean plane; 0 for three corners.
double distance_from_plane(std::span<const Point> corners);

} // namespace lightwell::dxf
