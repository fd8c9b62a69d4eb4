#pragma once

#include "engine/base/report.h"
#include "importers/gltf/gltf_document.h"

namespace lightwell {

/// Colours of vertices (COLOR_0) as materials: a primitive that has some wears a material of its own, whose base colour
/// is multiplied with their mean over the area. The mean is taken to 8 bits of sRGB, so that primitives of equal
/// looks share a material, which is named `NAME #rrggbb`.
/// @param document  receives the materials, after its own
void take_vertex_colours(GltfDocument& document, Report& report);

} // namespace lightwell
