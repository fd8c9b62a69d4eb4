#pragma once

#include "engine/scene/surface.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lightwell {

/// Sharpness from which an edge or a point stays sharp at every level, i.e. a true crease or tip.
inline constexpr double fully_sharp = 10;

/// The control cage of a Catmull-Clark surface: faces of any number of corners, closed or open.
struct SubdivisionCage {
    /// An edge of the cage that is rounded only after `sharpness` levels; fully_sharp and more: never.
    struct Crease {
        std::uint32_t from, to; ///< into points
        double sharpness;       ///< >= 0
    };
    /// A point of the cage that is rounded only after `sharpness` levels.
    struct Tip {
        std::uint32_t point;
        double sharpness; ///< >= 0
    };
    std::vector<Point> points;
    std::vector<std::uint32_t> face_sizes; ///< corners of each face, >= 3
    std::vector<std::uint32_t> corners;    ///< into points, face after face, counter-clockwise seen from the front
    std::vector<Crease> creases;
    std::vector<Tip> tips;
    std::vector<std::uint32_t> holes;   ///< faces that shape the surface but are not part of it
    bool keep_boundary_corners = false; ///< corners of one face on the boundary stay where they are; else rounded
};

/// A limit surface as triangles, and what was done to get there.
struct LimitSurface {
    Mesh mesh;                        ///< with normals; corners on creases stand twice, at the same place
    std::vector<std::uint32_t> faces; ///< for each triangle, the face of the cage that it is a part of
    double largest_deviation_m = 0;   ///< of triangles from the surface, at the places tried
    bool reached_tolerance = true;    ///< false: the bound on the number of triangles came first
    std::size_t faces_left_out = 0;   ///< without three different corners
    std::size_t creases_left_out = 0; ///< not along an edge of the cage, or from a point that does not exist
};

/// The surface that endless subdivision of the cage tends to, as triangles with its normals. Each edge is halved as
/// often as its own curve needs; faces that share an edge share its points to the bit, so there are no cracks.
/// @param cage               checked here: indices, finite numbers, sizes
/// @param chord_tolerance_m  > 0; greatest distance of the triangles from the surface
/// @param place              file, line and entity, for errors
/// Error   corners lie on the surface within 1e-4 of the size of a cage face, exactly where all points have four
///         edges; triangles within chord_tolerance_m of it (tests/unit/geometry/limit_surface_test.cpp)
/// @throws InputError  an index without a point, a face of less than three corners, numbers that are not finite
/// Source  Catmull, Clark 1978; DeRose, Kass, Truong 1998 (creases); evaluation by OpenSubdiv
LimitSurface limit_surface(const SubdivisionCage& cage, double chord_tolerance_m, const std::string& place);

} // namespace lightwell
