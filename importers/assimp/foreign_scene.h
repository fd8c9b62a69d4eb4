#pragma once

#include "engine/base/transform.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lightwell {

/// What the child program found in a file, as plain data: single precision where the reader has no more.
struct ForeignMaterial {
    std::string name;
    std::array<float, 3> diffuse{}, emission{}; ///< linear Rec.709 as the file has them
    bool diffuse_stated = false;
    double opacity = 1;
    std::uint32_t textures = 0;
    bool shiny = false; ///< the file describes a highlight
};

/// Faces of any number of corners. Corners are counted one by one: each has its own point.
struct ForeignMesh {
    std::string name;
    std::uint32_t material = 0;            ///< into materials
    std::vector<float> points;             ///< x, y, z of each point
    std::vector<float> normals;            ///< empty, or one for each point
    std::vector<std::uint32_t> face_sizes; ///< 1: a dot, 2: a line, else corners of a face
    std::vector<std::uint32_t> corners;    ///< into points, face after face
};

struct ForeignNode {
    std::string name;
    std::int32_t parent = -1; ///< into nodes, always an earlier one; -1 for the root
    Affine to_parent;
    std::vector<std::uint32_t> meshes;
};

/// In the frame of the node of the same name.
struct ForeignCamera {
    std::string name;
    std::array<float, 3> position{}, direction{}, up{};
    double horizontal_rad = 0, aspect = 0;
};

struct ForeignScene {
    std::vector<ForeignMaterial> materials;
    std::vector<ForeignMesh> meshes;
    std::vector<ForeignNode> nodes;
    std::vector<ForeignCamera> cameras;
    std::vector<std::string> lights; ///< names of lamps
    double centimetres_per_unit = 0; ///< as an FBX file states it; 0: not stated
    std::int32_t up_axis = -1;       ///< 0 x, 1 y, 2 z as an FBX file states it; -1: not stated
    std::int32_t up_sign = 1;
    std::uint32_t animations = 0;
};

/// The answer of the child: bytes of this machine, since both run on it.
std::string scene_to_bytes(const ForeignScene& scene);
std::string refusal_to_bytes(const std::string& reason);

/// Believes nothing: lengths, indices and the order of nodes are checked, an index out of range ends in an error.
/// @throws InputError  `place`: the child's own words, or what is wrong with its answer
ForeignScene scene_from_bytes(std::string_view bytes, const std::string& place);

} // namespace lightwell
