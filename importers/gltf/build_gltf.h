#pragma once

#include "importers/gltf/gltf_document.h"
#include "importers/importer.h"

#include <set>

namespace lightwell {

/// Walks the nodes of the scene: meshes used once go into the scene, others become prototypes with instances.
/// @param to_metres  file coordinates to metres, z up
/// @return           numbers of the transparent bodies' materials that some mesh without an inside wears
/// @throws InputError when nodes form a circle or have two parents, or nothing of the geometry can be used
std::set<int> build_gltf(const GltfDocument& document, const Affine& to_metres, Imported& imported);

} // namespace lightwell
