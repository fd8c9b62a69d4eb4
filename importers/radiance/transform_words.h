#pragma once

#include "engine/base/transform.h"

#include <optional>
#include <string>
#include <vector>

namespace lightwell::scene_text {

/// One placement that transform words ask for; arrays (`-a`) ask for many.
struct Placement {
    Affine map;
    std::string array_index; ///< "" without arrays, else "2" or "2.0": the indices of the arrays, outermost first
};

/// Reads `-t x y z`, `-rx -ry -rz degrees`, `-s factor`, `-mx -my -mz`, `-i count`, `-a count`, `-affine` and
/// three rows of four numbers from words[begin] until the first word that is none of these.
/// @param begin  moved past the words read
/// @throws InputError for a missing or bad number, a zero scale, or more than ten million placements
std::vector<Placement> read_placements(const std::vector<std::string>& words, std::size_t& begin,
                                       const std::string& place);

/// The words that give the map, when it is a similarity: mirror, scale, rotations, translation, in this order.
/// @return  nothing when read_placements() would not give the map back within 1e-12 of its scale
std::optional<std::vector<std::string>> words_of(const Affine& map);

} // namespace lightwell::scene_text
