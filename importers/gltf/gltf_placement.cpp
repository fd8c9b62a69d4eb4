#include "importers/gltf/gltf_placement.h"

#include <cmath>
#include <utility>

namespace lightwell {
namespace {

/// A map that flattens space below this share of its own size cannot be turned back, as an instance must be.
constexpr double singular_tolerance = 1e-12;

} // namespace

void transform(Mesh& mesh, const Affine& map)
{
    for (Point& point : mesh.points)
        point = map.point(point);
    const double determinant = map.determinant();
    const double size = std::fmax(max_abs(map.x), std::fmax(max_abs(map.y), max_abs(map.z)));
    const bool singular = !(std::fabs(determinant) > singular_tolerance * size * size * size);
    if (singular)
        mesh.normals.clear();
    for (Direction& normal : mesh.normals)
        normal = transform_normal(map, normal);
    if (determinant < 0)
        for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3)
            std::swap(mesh.triangles[i + 1], mesh.triangles[i + 2]);
}

bool all_finite(const Mesh& mesh)
{
    for (const Point& point : mesh.points)
        if (!is_finite(point))
            return false;
    return true;
}

bool invertible(const Affine& map)
{
    const double size = std::fmax(max_abs(map.x), std::fmax(max_abs(map.y), max_abs(map.z)));
    return is_finite(map.translation) && std::fabs(map.determinant()) > singular_tolerance * size * size * size;
}

} // namespace lightwell
