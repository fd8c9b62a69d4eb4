#pragma once

#include "engine/geometry/limit_surface.h"

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace lightwell::scene_text {

/// Faces of any number of corners from a PLY file, checked: indices, finite numbers, counts that agree.
struct PlyMesh {
    SubdivisionCage cage; ///< points, faces, creases, tips; of a mesh the faces are meant as they are

    /// One for each corner; empty: none.
    std::vector<Direction> normals;
    /// Two for each corner; empty: none.
    std::vector<double> texture;

    std::vector<std::string> modifiers; ///< names of the header; empty where a number has no name
    /// For each face an index into `modifiers`, or -1: what the scene text says. Empty: all -1.
    std::vector<std::int32_t> face_modifiers;
};

/// @param name  of the file, for messages
/// @throws InputError with face or vertex: what read_ply() refuses; no `vertex` or `face`; an index without a vertex;
///         faces of less than three corners; numbers that are not finite; lists of other lengths than the faces have
PlyMesh read_ply_mesh(std::string_view bytes, const std::string& name);

} // namespace lightwell::scene_text
