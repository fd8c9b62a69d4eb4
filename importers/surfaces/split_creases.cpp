#include "importers/surfaces/split_creases.h"

#include "engine/geometry/crease_normals.h"

#include <limits>

namespace lightwell {
namespace {

/// Normals this near to the triangle's own say nothing that its plane does not.
constexpr double same_normal_cosine = 1 - 1e-9;

Mesh picked(const Mesh& from, const std::vector<bool>& triangles, bool wanted)
{
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    Mesh mesh;
    std::vector<std::uint32_t> moved(from.points.size(), none);
    for (std::size_t i = 0; i < from.triangles.size(); ++i) {
        if (triangles[i / 3] != wanted)
            continue;
        std::uint32_t& to = moved[from.triangles[i]];
        if (to == none) {
            to = static_cast<std::uint32_t>(mesh.points.size());
            mesh.points.push_back(from.points[from.triangles[i]]);
            if (wanted)
                mesh.normals.push_back(from.normals[from.triangles[i]]);
        }
        mesh.triangles.push_back(to);
    }
    return mesh;
}

} // namespace

SplitMesh split_creases(const Mesh& mesh, double crease_angle_deg)
{
    const Mesh round = crease_normals(mesh, crease_angle_deg);
    std::vector<bool> curved;
    for (std::size_t i = 0; i + 2 < round.triangles.size(); i += 3) {
        const Point& a = round.points[round.triangles[i]];
        const Direction front =
            normalized(cross(round.points[round.triangles[i + 1]] - a, round.points[round.triangles[i + 2]] - a));
        bool bent = false;
        for (std::size_t k = 0; k < 3; ++k)
            bent = bent || dot(round.normals[round.triangles[i + k]], front) < same_normal_cosine;
        curved.push_back(bent);
    }
    SplitMesh split;
    for (const bool wanted : {false, true}) {
        Mesh mine = picked(round, curved, wanted);
        if (!mine.triangles.empty())
            (wanted ? split.curved : split.flat) = std::make_shared<const Mesh>(std::move(mine));
    }
    return split;
}

} // namespace lightwell
