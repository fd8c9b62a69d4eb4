#pragma once

#include "importers/gltf/gltf_document.h"

#include <vector>

namespace lightwell {

/// How a mesh stands at rest: the weights of its morph targets and, for a skinned one, where its bones bring it.
struct GltfPose {
    std::vector<double> weights;
    std::vector<Affine> joints; ///< empty: no skin; else mesh -> metres, for each joint
    bool bends() const noexcept { return !weights.empty() || !joints.empty(); }
};

/// Moves points (and normals, when there are any) by the morph targets, then by the skin.
/// Source  glTF 2.0 specification, 3.7.2.2 and 3.7.3.3
/// @throws InputError when accessors or joints cannot be used
void take_pose(const GltfDocument& document, const GltfPrimitive& primitive, const GltfPose& pose,
               std::vector<Point>& points, std::vector<Vec3>& normals);

} // namespace lightwell
