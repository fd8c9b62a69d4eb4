#pragma once

#include "importers/gltf/gltf_document.h"
#include "importers/importer.h"

#include <set>
#include <string>

namespace lightwell {

/// A lamp of the file as a source of the engine, by the rule of importers/gltf/README.md: a small ball, a small ball
/// with a beam, or a disc as large as the sun's in the sky.
/// @param number    of the lamp in the file
/// @param key       layer, group and entity; receives material and colour
/// @param names     of the lamps' materials so far; a lamp shown at many places has one, a beam one for each place
/// @return          why it was left out; empty when it was made
std::string add_light(const GltfDocument& document, int number, SurfaceKey key, const Affine& to_world,
                      std::set<std::string>& names, KeyTable& keys, Imported& imported);

} // namespace lightwell
