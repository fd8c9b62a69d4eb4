#pragma once

#include "engine/control/surface_charts.h"

namespace lightwell {

/// Most texels of one run: more is a slip of the spacing, not a wish.
inline constexpr double most_texels = 4e6;

/// Texels over flat outlines in one plane, each outline a loop of corners (holes joined by seams); empty when they
/// have no area. The axes follow the longest edge. Kind, cells, sensors and areas are set; id and layer are not.
/// @param normal  of the front
/// @throws InputError naming the count when there are more than most_texels
SurfaceChart flat_chart(const std::vector<std::vector<Point>>& outlines, const Direction& normal, double spacing_m);

/// Number of texels along a length; at least 1.
/// @throws InputError as above
int texels_along(double length_m, double spacing_m);

} // namespace lightwell
