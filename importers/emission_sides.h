#pragma once

#include "engine/scene/surface.h"
#include "importers/layers.h"

#include <vector>

namespace lightwell {

/// What becomes of an emitting surface, so that its light leaves on the wanted side: emitters send light to the
/// front only.
enum class Turn : std::uint8_t { as_is, reversed, both };

/// Ends the name of the copy that faces the other way; it counts as the same surface in summaries.
inline constexpr const char* back_suffix = "~back";

/// Turns for the surfaces of one part that share an emitter. Closed bodies emit outwards whatever `side` says: spheres,
/// cones and cylinders, rings that close one of those, and polygons, meshes and parts of round shapes that together
/// leave no open edge.
/// @param emitters  indices into part.surfaces
/// @param side      for what is not closed
std::vector<Turn> emission_turns(const Part& part, const std::vector<std::size_t>& emitters, EmissionSide side);

/// Appends a copy of a surface (no instance) to a part, with front and back exchanged when `reversed`.
void append_copy(Part& to, const Part& from, const Surface& surface, bool reversed, ModifierId modifier,
                 std::string name);

} // namespace lightwell
