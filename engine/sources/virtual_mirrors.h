#pragma once

#include "engine/accel/ray_queries.h"
#include "engine/base/frame.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace lightwell {

/// The outline of a flat surface in coordinates of its plane: edges with holes by the even-odd rule, or a disc, or part
/// of one, with a concentric hole that any affine map may have turned into an ellipse.
struct FlatOutline {
    struct Edge {
        double ax, ay, bx, by;
    };
    std::vector<Edge> edges;
    std::array<double, 4> to_disc{}; ///< rows of the map to the frame in which the disc is round
    double inner_squared = 0, outer_squared = 0;
    double sweep_rad = 2 * pi; ///< of the disc, from its x axis on

    bool holds(double x, double y) const noexcept;
};

/// A flat mirror in the world frame. It reflects on both sides.
struct PlanarMirror {
    Frame frame;  ///< z = normal
    Point centre; ///< a point of the plane; origin of the outline's coordinates
    FlatOutline outline;
    double radius_m = 0; ///< of a ball about the centre that holds it
    double area_m2 = 0;
    double error_m = 0; ///< bound on how far rays may find it off its plane
    Spectrum reflectance;
    bool hidden = false; ///< only shadow rays see it; others see what its material names in its place

    /// Signed height above the plane.
    double height_m(const Point& p) const noexcept { return dot(frame.z, p - centre); }
    Point reflect(const Point& p) const noexcept { return p - frame.z * (2 * height_m(p)); }
    Vec3 reflect_vector(const Vec3& v) const noexcept { return v - frame.z * (2 * dot(frame.z, v)); }
    /// @param p  a point of the plane
    bool holds(const Point& p) const noexcept
    {
        const Vec3 local = frame.to_local(p - centre);
        return outline.holds(local.x, local.y);
    }
};

/// A surface of material Mirror that gives no virtual sources: its light is found by scattered rays alone.
struct UnreachableMirror {
    std::string name; ///< of the surface
    ModifierId modifier = void_modifier;
    double area_m2 = 0; ///< of all copies
    Spectrum reflectance;
    std::size_t count = 1; ///< copies in instances, or planes of a mesh
    bool curved = false;   ///< else it is flat, but beyond the number that is followed
};

/// The flat mirrors of a scene, those inside instances too: polygons, rings, and the flat parts of meshes.
/// Where two of them lie on one another the first in the order of path, surface and triangle is the one that reflects,
/// as for rays.
class MirrorSet {
public:
    MirrorSet() = default;
    explicit MirrorSet(const Scene& scene);

    const std::vector<PlanarMirror>& mirrors() const noexcept { return mirrors_; }
    const std::vector<UnreachableMirror>& unreachable() const noexcept { return unreachable_; }
    /// False when there were so many mirrors that not all were looked at.
    bool complete() const noexcept { return complete_; }
    /// The mirror that a ray has met; -1 when it is none of them.
    int mirror_at(const Hit& hit) const noexcept;
    /// Whether one of these is seen by shadow rays alone.
    bool hidden(const std::int16_t* which, int count) const noexcept
    {
        return std::any_of(which, which + count,
                           [this](int i) { return mirrors_[static_cast<std::size_t>(i)].hidden; });
    }
    /// @param p  a point of the mirror's plane
    bool holds(std::size_t mirror, const Point& p) const noexcept;

private:
    struct Builder;
    struct Place {
        int mirror = -1;
        std::vector<int> by_triangle = {}; ///< of a mesh
    };
    std::vector<PlanarMirror> mirrors_;
    std::vector<std::vector<std::uint32_t>> before_; ///< by mirror: those on the same plane that come first
    std::unordered_map<std::uint64_t, Place> by_place_;
    std::vector<UnreachableMirror> unreachable_;
    bool complete_ = true;
};

/// Mirrors without virtual sources, for the plan: what they reflect onto other surfaces costs more samples.
std::vector<UnreachableMirror> unreachable_mirrors(const Scene& scene);

} // namespace lightwell
