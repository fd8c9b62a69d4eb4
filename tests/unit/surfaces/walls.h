#pragma once

#include "importers/importer.h"

#include <functional>
#include <memory>

namespace lightwell {

/// Adds n x m cells of two triangles each on the parallelogram of two edges, without those that `open` says. Cells lie
/// on multiples of a step that is a power of two, so that neighbours share their corners to the bit.
inline void add_cells(
    Mesh& mesh, const Point& from, const Vec3& along, const Vec3& up, int n, int m,
    const std::function<bool(int, int)>& open = [](int, int) { return false; })
{
    const auto at = [&](int i, int j) { return from + along * i + up * j; };
    const auto add = [&](const Point& p) {
        mesh.triangles.push_back(static_cast<std::uint32_t>(mesh.points.size()));
        mesh.points.push_back(p);
    };
    for (int j = 0; j < m; ++j)
        for (int i = 0; i < n; ++i)
            if (!open(i, j))
                for (const Point& p :
                     {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)})
                    add(p);
}

/// A wall of 19 x 1 x 15 cells of 1/4 m with a window of 8 x 4 cells: 1196 triangles, front at y = 0 looking to -y.
inline Mesh wall_with_window()
{
    constexpr double c = 0.25;
    Mesh wall;
    const auto window = [](int i, int j) { return i >= 5 && i < 13 && j >= 4 && j < 8; };
    const Vec3 x{c, 0, 0}, y{0, c, 0}, z{0, 0, c};
    add_cells(wall, {0, 0, 0}, x, z, 19, 15, window);
    add_cells(wall, {19 * c, c, 0}, -x, z, 19, 15, [&](int i, int j) { return window(18 - i, j); });
    add_cells(wall, {19 * c, 0, 0}, y, z, 1, 15);
    add_cells(wall, {0, c, 0}, -y, z, 1, 15);
    add_cells(wall, {0, 0, 15 * c}, x, y, 19, 1);
    add_cells(wall, {0, c, 0}, x, -y, 19, 1);
    add_cells(wall, {5 * c, 0, 4 * c}, x, y, 8, 1);
    add_cells(wall, {5 * c, c, 8 * c}, x, -y, 8, 1);
    add_cells(wall, {5 * c, 0, 4 * c}, y, z, 1, 4);
    add_cells(wall, {13 * c, c, 4 * c}, -y, z, 1, 4);
    return wall;
}

/// The same with all fronts inwards.
inline Mesh inside_out(Mesh mesh)
{
    for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3)
        std::swap(mesh.triangles[i + 1], mesh.triangles[i + 2]);
    return mesh;
}

inline SurfaceKey key_of_layer(const std::string& layer)
{
    SurfaceKey key;
    key.layer = layer;
    key.entity = "mesh";
    return key;
}

} // namespace lightwell
