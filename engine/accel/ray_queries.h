#pragma once

#include "engine/base/spectrum.h"
#include "engine/base/transform.h"
#include "engine/scene/varied_materials.h"

#include <cstdint>
#include <memory>

namespace lightwell {

/// Which volumes a ray is in: those of antimatter, whose surfaces it does not see, and haze.
struct InVolumes {
    std::uint32_t inside = 0; ///< one bit for each volume of the scene (engine/accel/volumes.h)
    std::int32_t bodies = 0;  ///< erased bodies that it is in
};

/// A half-line or segment: origin + t * direction, 0 < t < t_max. The direction need not have unit length.
struct Ray {
    Point origin;
    Vec3 direction;
    double t_max = infinity;
    InVolumes in = {};
};

/// Where a ray meets a surface.
struct Hit {
    double t = infinity;
    Point position;
    Direction normal;                    ///< geometric, unit, front side of the surface (world frame)
    Direction shading_normal;            ///< interpolated where the surface has normals; same side as `normal`
    ModifierId modifier = void_modifier; ///< instance bindings applied
    std::uint64_t path = 0;              ///< hash of the instances passed; 0 in the root
    const Part* part = nullptr;
    std::uint32_t surface = 0;  ///< index into part->surfaces
    std::uint32_t triangle = 0; ///< of a mesh
    double error_m = 0;         ///< bound on how far `position` may lie off the surface
    Affine to_part;             ///< into the frame of the part that is instanced, where the modifier varies
    InVolumes in = {};          ///< of the ray, before it met the surface

    /// `position` moved off the surface to the side of `direction`, beyond its error: where scattered rays start.
    Point leave(const Vec3& direction) const noexcept
    {
        return position + normal * (dot(normal, direction) >= 0 ? error_m : -error_m);
    }
};

class Volumes; // engine/accel/volumes.h

/// Whether a surface is there for a ray that comes from behind it. `unseen`: not for rays that look; shadow rays are
/// stopped by what is opaque all the same, and pass the backs of what transmits without loss. Bodies of glass, mist,
/// antimatter, prisms and what scatters by functions or measurements on both sides are always seen from both sides.
/// Source  recorded behaviour of `-bv-` (tests/unit/accel)
enum class BackFaces { seen, unseen };

/// What patterns may ask about a hit.
/// @param direction  of the ray, unit; the place refers to the hit
PatternPlace pattern_place(const Hit& hit, const Direction& direction, double distance_m) noexcept;

/// The path hash of an instance's surfaces; outer is the hash around it.
std::uint64_t instance_path(std::uint64_t outer, std::uint32_t instance_surface) noexcept;

/// Ray queries over a scene: single-precision boxes find candidates, every surface is decided in double.
/// Polygons and triangles that share an edge (the same corner coordinates) never let a ray through between them.
/// Thread-safe. The scene must outlive it.
/// Error: exact up to rounding; no constant in scene units (tests/unit/accel).
/// Source  Woop, Benthin, Wald 2013 (shared corners in a ray-aligned frame), extended to polygons of any outline
class RayQueries {
public:
    explicit RayQueries(const Scene& scene, BackFaces backs = BackFaces::seen);
    ~RayQueries();
    RayQueries(RayQueries&&) noexcept;
    RayQueries& operator=(RayQueries&&) noexcept;

    /// @return false when nothing is met; distant sources are not surfaces in this sense
    bool closest(const Ray& ray, Hit& hit) const noexcept;
    /// What is left of light along the ray: 1 when free, 0 when an opaque surface stands in the way, else the product
    /// of the straight transmittances of what it passes. An Illum passes light as its alternate does.
    /// @param illum_front  null: the front of an Illum, which no scattered ray passes, is the end of the way; else it
    /// is
    ///                     passed, and this becomes true
    Spectrum transmittance(const Ray& ray, bool* illum_front = nullptr) const noexcept;

    const Volumes& volumes() const noexcept;
    /// The volumes around a point, told by what a ray from there meets on its way out; {} where the scene has none.
    InVolumes volumes_at(const Point& point) const noexcept;

    /// Bytes that the acceleration structures hold.
    std::size_t bytes() const noexcept;

private:
    struct State;
    bool nearest(const Ray& ray, Hit& hit, BackFaces backs) const noexcept;
    Spectrum through_volumes(Ray ray, bool* illum_front) const noexcept;
    std::unique_ptr<State> state_;
};

} // namespace lightwell
