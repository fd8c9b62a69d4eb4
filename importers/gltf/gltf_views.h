#pragma once

#include "importers/gltf/gltf_document.h"
#include "importers/importer.h"

namespace lightwell {

/// A camera of the file as a view of the scene; one with impossible numbers is left out with a note.
/// @param name  of the node; the camera's own name stands in for an empty one
void add_view(const GltfCamera& camera, const std::string& name, const Affine& to_world, const std::string& place,
              Imported& imported);

} // namespace lightwell
