#pragma once

#include "importers/obj/obj_file.h"
#include "plugins/commands/command.h"

#include <array>
#include <string>
#include <vector>

namespace lightwell::commands {

/// A Wavefront file by name, from standard input when the name is empty.
/// @throws Fatal when it cannot be opened
ObjFile read_obj_input(const std::string& name, const Streams& streams);
/// `NAME: warning - N statements unrecognized`, when there are any.
void warn_of_unknown_statements(const std::string& program, const ObjFile& file, std::ostream& err);

/// The corners of a face, cut into triangles: indices into ObjFile::corners.
std::vector<std::array<std::uint32_t, 3>> triangles_of(const ObjFile& file, const ObjFace& face);
/// The flat normal of a face, unit; 0 for a face without area.
Vec3 flat_normal(const ObjFile& file, const ObjFace& face);

} // namespace lightwell::commands
