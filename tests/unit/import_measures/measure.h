#pragma once

#include "importers/importer.h"

#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>

namespace lightwell {

/// Surfaces, triangles (an N-gon counts N - 2) and area of what shares a name.
struct Share {
    std::size_t surfaces = 0, triangles = 0;
    double area_m2 = 0;
};

/// What the truth beside a file speaks of, with instances expanded.
struct MeasuredModel {
    std::map<std::string, Share> layers, materials, groups, blocks;
    Share total;
    Box bounds;
};

inline void measure_surface(const Part& part, const Surface& surface, const Affine& to_world, Share& share, Box& bounds)
{
    share.surfaces += 1;
    if (surface.shape == Shape::polygon) {
        const Polygon& polygon = part.polygons[surface.index];
        std::vector<Point> corners;
        for (std::uint32_t i = 0; i < polygon.count; ++i)
            bounds.extend(corners.emplace_back(to_world.point(part.points[polygon.first + i])));
        share.triangles += polygon.count - 2;
        share.area_m2 += length(polygon_area_vector(corners.data(), corners.size()));
    } else if (surface.shape == Shape::mesh) {
        const Mesh& mesh = *part.meshes[surface.index];
        for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
            Point corners[3];
            for (std::size_t k = 0; k < 3; ++k)
                bounds.extend(corners[k] = to_world.point(mesh.points[mesh.triangles[i + k]]));
            share.area_m2 += length(polygon_area_vector(corners, 3));
        }
        share.triangles += mesh.triangles.size() / 3;
    }
}

inline MeasuredModel measure(const Imported& imported)
{
    MeasuredModel measured;
    visit_expanded(imported.scene,
                   [&](const Part& part, const Surface& surface, const Affine& to_world, ModifierId modifier) {
                       const SurfaceKey& key = imported.keys.at(static_cast<std::size_t>(modifier));
                       Share share;
                       measure_surface(part, surface, to_world, share, measured.bounds);
                       for (Share* sum : {&measured.layers[key.layer], &measured.materials[key.material],
                                          &measured.groups[key.group], &measured.blocks[key.block], &measured.total}) {
                           sum->surfaces += share.surfaces;
                           sum->triangles += share.triangles;
                           sum->area_m2 += share.area_m2;
                       }
                   });
    return measured;
}

inline std::size_t skipped_for(const Imported& imported, const std::string& reason)
{
    std::size_t count = 0;
    for (const Ledger::Skipped& entry : imported.ledger.skipped_list())
        if (entry.reason == reason)
            count += entry.count;
    return count;
}

inline std::size_t skipped_of_type(const Imported& imported, const std::string& type)
{
    std::size_t count = 0;
    for (const Ledger::Skipped& entry : imported.ledger.skipped_list())
        if (entry.type == type)
            count += entry.count;
    return count;
}

/// Number of times a note holds this text.
inline std::size_t noted(const Report& report, const std::string& text)
{
    std::size_t count = 0;
    for (const Note& note : report.notes())
        if (note.text.find(text) != std::string::npos)
            count += note.count;
    return count;
}

/// Real files from elsewhere, where they are at hand.
inline std::filesystem::path shared_fixtures()
{
    const char* set = std::getenv("LIGHTWELL_SHARED");
    return std::filesystem::path(set ? set : LIGHTWELL_ROOT "/../shared") / "fixtures";
}

} // namespace lightwell
