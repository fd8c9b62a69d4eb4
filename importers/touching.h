#pragma once

#include "engine/base/box.h"

#include <cstddef>
#include <vector>

namespace lightwell {

/// Boxes that touch each other, directly or through others: surfaces that make one thing.
/// @return  the indices of each group, ascending; groups in the order of their first box
std::vector<std::vector<std::size_t>> touching_groups(const std::vector<Box>& boxes);

} // namespace lightwell
