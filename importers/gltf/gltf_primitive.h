#pragma once

#include "engine/scene/surface.h"
#include "importers/gltf/gltf_document.h"
#include "importers/gltf/gltf_pose.h"

#include <optional>

namespace lightwell {

/// The triangles of one primitive in the frame of its mesh.
struct GltfTriangles {
    Mesh mesh;                    ///< normals only where they bend the surface
    std::size_t without_area = 0; ///< triangles dropped for that
};

/// @throws InputError when an accessor, an index or packed data cannot be used: the reason names the accessor
GltfTriangles read_triangles(const GltfDocument& document, const GltfPrimitive& primitive, const GltfPose& pose);

/// Mean of the vertex colours of a primitive that is not packed, weighed with area; linear Rec.709. Nothing when it has
/// no triangles with an area.
/// @throws InputError as read_triangles()
std::optional<Spectrum> mean_vertex_colour(const GltfDocument& document, const GltfPrimitive& primitive);

/// True when each edge is walked once in each direction: the triangles enclose a body.
bool is_closed(const Mesh& mesh);

} // namespace lightwell
