#pragma once

#include "engine/base/report.h"
#include "importers/radiance/ply_mesh.h"
#include "importers/radiance/radiance.h"

namespace lightwell::scene_text {

/// Surfaces of one mesh file. Their modifiers are not ids of a scene but numbers: 0 is what the scene text says, i + 1
/// the name i of the file.
struct PlyPart {
    Part part;
    std::vector<std::string> modifiers; ///< the names of the file
    std::vector<bool> used;             ///< by number of the modifier
    std::shared_ptr<MeshFile> file = std::make_shared<MeshFile>();
    Report report; ///< with the file as the place of each note
};

/// Polygons where faces are flat, named by the number of the face; triangles of one mesh for each modifier where they
/// are bent, have normals that say more than their plane, or texture places for a modifier that varies.
/// @param textured  by number of the modifier: whether places on the texture count
PlyPart faces_of(const PlyMesh& mesh, const std::vector<bool>& textured, const std::string& name);

/// The Catmull-Clark limit surface, one mesh for each modifier.
/// @throws InputError for a cage that limit_surface() refuses
PlyPart limit_surface_of(const PlyMesh& mesh, double chord_tolerance_m, const std::string& name);

} // namespace lightwell::scene_text
