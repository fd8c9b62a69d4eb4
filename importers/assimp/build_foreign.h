#pragma once

#include "importers/assimp/foreign_scene.h"
#include "importers/assimp/ifc_text.h"
#include "importers/importer.h"

namespace lightwell {

/// What a file of the long tail is, besides its content.
struct ForeignFile {
    std::string name;             ///< for places in notes
    const IfcText* ifc = nullptr; ///< only for IFC
};

/// Meshes become polygons and meshes, nodes that repeat a mesh become instances, cameras views.
/// @param to_metres  from the frame of the root node's parent
void build_foreign(const ForeignScene& scene, const ForeignFile& file, const Affine& to_metres, Imported& imported);

} // namespace lightwell
