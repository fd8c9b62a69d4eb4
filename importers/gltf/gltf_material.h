#pragma once

#include "importers/gltf/gltf_document.h"
#include "materials/material.h"

namespace lightwell {

/// The rule of importers/gltf/README.md: emitter, glass, metal or plastic; always a valid material.
/// @param from_blender  emission is in W/(m^2 sr); otherwise in cd/m^2, as the format says
Material material_of(const GltfMaterial& from, bool from_blender, const std::string& place, Report& report);

} // namespace lightwell
