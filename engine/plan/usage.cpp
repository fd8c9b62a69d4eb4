#include "engine/plan/usage.h"

#include "engine/scene/expansion.h"

#include <cmath>

namespace lightwell {
namespace {

/// Triangles whose normals differ by less than this (1 - cosine) lie in one plane.
constexpr double flat_slack = 1e-9;

bool is_flat(const Mesh& mesh)
{
    if (!mesh.normals.empty())
        for (const Direction& n : mesh.normals)
            if (dot(n, mesh.normals.front()) < 1 - flat_slack)
                return false;
    Vec3 first{};
    for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
        const Point corners[3] = {mesh.points[mesh.triangles[i]], mesh.points[mesh.triangles[i + 1]],
                                  mesh.points[mesh.triangles[i + 2]]};
        const Vec3 area = polygon_area_vector(corners, 3);
        if (length(area) == 0)
            continue;
        const Direction normal = normalized(area);
        if (length(first) == 0)
            first = normal;
        else if (std::fabs(dot(normal, first)) < 1 - flat_slack)
            return false;
    }
    return true;
}

bool is_curved(const Part& part, const Surface& surface)
{
    if (surface.shape == Shape::mesh)
        return !is_flat(*part.meshes[surface.index]);
    return surface.shape != Shape::polygon && surface.shape != Shape::ring && surface.shape != Shape::source;
}

Usage usage_of(const Part& part, const Surface& surface)
{
    const double area = surface_area_m2(part, surface);
    return is_curved(part, surface) ? Usage{1, area, 1, area} : Usage{1, area, 0, 0};
}

std::map<ModifierId, Usage> part_usage(const Scene& scene, const Part& part,
                                       const std::vector<std::map<ModifierId, Usage>>& prototypes)
{
    std::map<ModifierId, Usage> usage;
    for (const Surface& surface : part.surfaces)
        if (surface.shape != Shape::instance)
            usage[surface.modifier] += usage_of(part, surface);
    for (const Instance& instance : part.instances) {
        const double scale = std::cbrt(std::fabs(instance.to_parent.determinant())), area = scale * scale;
        for (const auto& [modifier, u] : prototypes[instance.prototype])
            usage[bound_modifier(scene, modifier, instance.bindings)] +=
                Usage{u.surfaces, u.area_m2 * area, u.curved_surfaces, u.curved_m2 * area};
    }
    return usage;
}

} // namespace

Usage& Usage::operator+=(const Usage& other) noexcept
{
    surfaces += other.surfaces;
    area_m2 += other.area_m2;
    curved_surfaces += other.curved_surfaces;
    curved_m2 += other.curved_m2;
    return *this;
}

std::map<ModifierId, Usage> usage_by_modifier(const Scene& scene)
{
    std::vector<std::map<ModifierId, Usage>> prototypes; // refer only to earlier ones
    for (const Part& part : scene.prototypes)
        prototypes.push_back(part_usage(scene, part, prototypes));
    return part_usage(scene, scene.root, prototypes);
}

} // namespace lightwell
