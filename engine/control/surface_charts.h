#pragma once

#include "engine/scene/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace lightwell {

/// A surface laid out as a texture: texels with a sensor each, where the surface covers them.
struct SurfaceChart {
    enum class Kind {
        plane,    ///< corner + across * u + up * v, u and v from 0 to 1
        round,    ///< across: round the axis, counter-clockwise, as far as it goes; up: along it (a sphere: by angle)
        triangles ///< one texel for each triangle of a mesh that is not flat, in their order, row by row from below
    } kind = Kind::plane;
    std::string id;    ///< names of the instances and of the surface, with '/' between
    std::string layer; ///< name of the modifier
    int columns = 0, rows = 0;
    Point corner;                 ///< of a plane
    Vec3 across, up;              ///< of a plane: its whole width and height, m
    std::vector<int> cells;       ///< rows * columns indices into sensors, row 0 the lowest; -1: not covered
    std::vector<Sensor> sensors;  ///< in the surface, facing its front
    std::vector<double> areas_m2; ///< of the surface within each texel; they sum to its area
};

/// The chart of one surface in its place; id and layer are not set.
/// @param triangles  of a mesh: only these; empty: all
SurfaceChart surface_chart(const Part& part, const Surface& surface, const Affine& to_world, double spacing_m,
                           const std::vector<std::uint32_t>& triangles = {});

/// Charts of all surfaces whose layer matches, instances expanded, in the order of the scene.
/// @param layer      glob for the modifier's name; a layer split by material (`A/oak`) matches as `A`
/// @param spacing_m  largest distance between texels, > 0
/// @throws InputError when nothing matches, or there would be more than a few million texels
std::vector<SurfaceChart> surface_charts(const Scene& scene, const std::string& layer, double spacing_m);

} // namespace lightwell
