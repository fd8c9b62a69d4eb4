#pragma once

#include "engine/base/transform.h"
#include "engine/scene/surface.h"

namespace lightwell {

/// Moves a mesh into its place. A mirrored map turns the corners round, so that the front stays the front; one that
/// flattens leaves no normals.
void transform(Mesh& mesh, const Affine& map);
/// True when every point is at a finite place.
bool all_finite(const Mesh& mesh);
/// True when the map is finite and can be turned back, as an instance's must.
bool invertible(const Affine& map);

} // namespace lightwell
