#pragma once

#include "engine/scene/surface.h"

namespace lightwell {

/// The mesh with a normal at each corner: the mean of the triangles around the point, weighted by their angles there,
/// over those that hang together by edges bent less than the crease angle. Points on creases stand twice.
/// Points at the same place are joined, whether the file shares them or not; orientation must agree along an edge for
/// it to be smooth, so that a triangle drawn inside out keeps its own plane.
/// @param crease_angle_deg  (0, 180]: edges bent more stay sharp
Mesh crease_normals(const Mesh& mesh, double crease_angle_deg);

} // namespace lightwell
