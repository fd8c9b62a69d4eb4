#pragma once

#include "engine/base/box.h"
#include "engine/scene/scene.h"
#include "importers/radiance/radiance.h"

#include <functional>
#include <string>
#include <vector>

namespace lightwell::serve {

/// One face of an object, in its place: a surface of the scene, or of a mesh the triangles of one face of its file.
struct PlacedFace {
    const Part* part = nullptr;
    const Surface* surface = nullptr;
    Affine to_world;
    ModifierId modifier = void_modifier;
    std::string id;                       ///< names of the instances and of the surface, with '/' between
    std::int64_t number = -1;             ///< in the mesh file; -1: not from one
    std::uint32_t corners = 0;            ///< in the file; 0: a round shape, or a mesh of unknown faces
    std::vector<std::uint32_t> triangles; ///< of a mesh that holds other faces too

    double area_m2() const;
    Box bounds() const;
};

/// Calls visit(index of the root's surface, face) for every face of the scene, instances expanded. Void surfaces and
/// distant sources are left out.
void visit_faces(const Scene& scene, const SceneOrigins& origins,
                 const std::function<void(std::size_t root_surface, const PlacedFace& face)>& visit);

/// The object that a surface of the root comes from: what `#@from` names, else its own name.
const std::string& object_of(const Scene& scene, const SceneOrigins& origins, std::size_t root_surface);

} // namespace lightwell::serve
