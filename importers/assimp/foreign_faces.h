#pragma once

#include "engine/base/report.h"
#include "engine/scene/surface.h"
#include "importers/assimp/foreign_scene.h"

#include <string>
#include <vector>

namespace lightwell {

struct FaceCounts {
    std::size_t faces = 0, lines = 0, dots = 0;
};
FaceCounts count_faces(const ForeignMesh& mesh);

/// Turns the faces of meshes into surfaces: flat ones of more than three corners into polygons, triangles and cut
/// ones into a mesh, those with bent normals into a mesh with normals.
class ForeignFaces {
public:
    ForeignFaces(const std::string& file, Report& report) : file_(file), report_(report) {}
    /// @return number of faces that have an area
    std::size_t add(const ForeignMesh& mesh, const Affine& map, ModifierId modifier, const std::string& name,
                    Part& part);
    /// Faces that were cut since they were not flat, of all meshes so far.
    std::size_t warped() const { return warped_; }
    /// Reports what was cut and left out, once for all meshes.
    void write_notes();

private:
    struct Outline;
    struct Target;
    void add_outline(const Outline& outline, Target& target);
    const std::string file_;
    Report& report_;
    std::size_t warped_ = 0, empty_ = 0, not_finite_ = 0;
    double worst_deviation_m_ = 0;
};

} // namespace lightwell
