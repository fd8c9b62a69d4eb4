#pragma once

#include "engine/scene/surface.h"

#include <memory>

namespace lightwell {

/// A mesh cut into what is flat and what is curved, when edges bent less than an angle are meant to be round.
struct SplitMesh {
    std::shared_ptr<const Mesh> flat;   ///< without normals; null when nothing is flat
    std::shared_ptr<const Mesh> curved; ///< with normals; null when nothing is curved
};
SplitMesh split_creases(const Mesh& mesh, double crease_angle_deg);

} // namespace lightwell
