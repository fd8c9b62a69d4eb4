#pragma once

#include "engine/scene/surface.h"

#include <filesystem>
#include <map>
#include <string>

namespace lightwell::scene_text {

/// The triangles of a Wavefront file: `v`, `vn`, `vt` and `f` lines; faces with more corners are cut from their first
/// corner when they are convex. Groups, materials and smoothing are skipped: a mesh has one modifier.
/// @throws InputError with file and line: NaN, indices out of range, concave faces
Mesh read_mesh_text(const std::filesystem::path& file);
/// The same, its faces apart by the materials that `usemtl` names.
std::map<std::string, Mesh> read_meshes_by_material(const std::filesystem::path& file);

/// The mesh as a Wavefront file, from which read_mesh_text() makes the same triangles, bit for bit.
std::string mesh_text(const Mesh& mesh);

} // namespace lightwell::scene_text
