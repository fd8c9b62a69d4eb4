#pragma once

#include "materials/measured/tree_table.h"

#include <string_view>

namespace lightwell {

/// The text of a tree: `{` branches or values `}`.
/// @param coordinates  3 or 4
/// @param place        of the text, for messages
/// @throws InputError for braces that do not match, values that are no numbers >= 0, and grids of odd sizes
ValueTree parse_tree(std::string_view text, int coordinates, const std::string& place);

} // namespace lightwell
