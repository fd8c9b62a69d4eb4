#pragma once

#include "engine/scene/surface.h"

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace lightwell::scene_text {

/// The triangles of a Wavefront file: `v`, `vn`, `vt` and `f` lines; faces with more corners are cut from their first
/// corner when they are convex. Groups, materials and smoothing are skipped: a mesh has one modifier.
/// Also what mesh_file() writes.
/// @throws InputError with file and line: NaN, indices out of range, concave faces
Mesh read_mesh_text(const std::filesystem::path& file);
/// The same, its faces apart by the materials that `usemtl` names.
std::map<std::string, Mesh> read_meshes_by_material(const std::filesystem::path& file);

/// The mesh as a Wavefront file, from which read_mesh_text() makes the same triangles, bit for bit.
std::string mesh_text(const Mesh& mesh);

/// A mesh file as `obj2mesh` writes it: a header, materials as scene text, triangles as a Wavefront file.
/// @param command    the line of the header
/// @param materials  scene text, as it is
/// @param meshes     by the names of their materials; no name: the modifier of the surface
std::string mesh_file(const std::string& command, const std::string& materials,
                      const std::map<std::string, Mesh>& meshes);
/// Whether the bytes begin as such a file does.
bool is_mesh_file(std::string_view bytes) noexcept;
/// The materials of such a file; empty for a plain Wavefront file.
/// @throws InputError when the file is shorter or longer than it says
std::string_view materials_of_mesh_file(std::string_view bytes, const std::string& file);

} // namespace lightwell::scene_text
