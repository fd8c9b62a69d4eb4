#pragma once

#include "engine/scene/surface.h"

namespace lightwell {

/// Area in m^2 of the image of a surface (no instance) under any affine map, as exact as the shape allows.
/// Error: rounding for polygons, meshes, rings and spheres (ellipsoids by Carlson's integral); 1e-9 relative for the
///        side of a cone (periodic quadrature) down to images flattened 1:1000
double mapped_area_m2(const Part& part, const Surface& surface, const Affine& map);

} // namespace lightwell
