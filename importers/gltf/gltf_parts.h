#pragma once

#include "importers/gltf/gltf_document.h"

#include <string>

namespace lightwell {

/// Materials, skins, pictures, lamps and names of variants. Wrong types and missing members count as not written:
/// what has a meaning is checked where it is used.
/// @param json  an object with those members of a glTF file
void read_parts(const std::string& json, GltfDocument& document);

} // namespace lightwell
