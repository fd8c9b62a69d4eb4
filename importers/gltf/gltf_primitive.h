#pragma once

#include "engine/scene/surface.h"
#include "importers/gltf/gltf_document.h"
#include "importers/gltf/gltf_pose.h"

namespace lightwell {

/// The triangles of one primitive in the frame of its mesh.
struct GltfTriangles {
    Mesh mesh;                    ///< normals only where they bend the surface
    std::size_t without_area = 0; ///< triangles dropped for that
};

/// @throws InputError when an accessor, an index or packed data cannot be used: the reason names the accessor
GltfTriangles read_triangles(const GltfDocument& document, const GltfPrimitive& primitive, const GltfPose& pose);

/// True when each edge is walked once in each direction: the triangles enclose a body.
bool is_closed(const Mesh& mesh);

} // namespace lightwell
