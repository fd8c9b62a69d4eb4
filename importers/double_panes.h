#pragma once

#include "engine/scene/surface.h"

#include <utility>
#include <vector>

namespace lightwell {

/// Pairs of polygons that are the two panes, or the two faces, of one glazing unit: parallel, at most 60 mm apart, of
/// the same area within 2 %, one behind the other. Each polygon is in one pair at most.
/// @param candidates  indices into part.surfaces; what is no polygon is passed over
std::vector<std::pair<std::size_t, std::size_t>> double_panes(const Part& part,
                                                              const std::vector<std::size_t>& candidates);

} // namespace lightwell
