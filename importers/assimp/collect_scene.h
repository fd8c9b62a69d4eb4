#pragma once

#include "importers/assimp/foreign_scene.h"

#include <string>

namespace lightwell {

/// Reads a file with Assimp, by the reader of one format only; runs in the child program, since damaged files can
/// crash it. Faces keep their corners, nodes their maps; nothing is cut, joined or turned.
/// @param extension  "fbx", "dae", "3ds", "ply", "stl", "x3d", "off", "ifc": the reader, whatever the file is called
/// @throws std::runtime_error with the reader's words
ForeignScene collect_scene(const std::string& file, const std::string& extension);

} // namespace lightwell
