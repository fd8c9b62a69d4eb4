#pragma once

#include "engine/base/vector.h"

namespace lightwell {

/// What a smooth boundary between two clear media does to unpolarized light.
struct Fresnel {
    double senkrecht = 1;     ///< reflectance, electric field across the plane of incidence
    double parallel = 1;      ///< reflectance, field within it
    double cos_refracted = 0; ///< on the far side; 0 at total reflection
    bool total = true;        ///< nothing passes

    double reflectance() const noexcept { return 0.5 * (senkrecht + parallel); }
};
/// @param cosine          of the angle of incidence, [0, 1]
/// @param relative_index  far side over near side, > 0
/// Source  Born, Wolf, Principles of Optics, 1.5.2
Fresnel fresnel(double cosine, double relative_index) noexcept;

/// Boundary of a solid transparent body: one mirror ray, one refracted ray. Absorption on the way through the body
/// belongs to the path, not to the boundary.
/// Radiance is scaled by (near index / far index)^2 when it passes, since the same flux fills another solid angle; a
/// full pass in and out restores it.
class DielectricBoundary {
public:
    /// @param index       of the body against its surroundings
    /// @param from_front  the viewer is outside
    DielectricBoundary(double index, bool from_front) noexcept : relative_index_(from_front ? index : 1 / index) {}
    double reflectance(double cos_viewer) const noexcept { return fresnel(cos_viewer, relative_index_).reflectance(); }
    /// What the radiance from the far side is multiplied with, Fresnel and solid angle together.
    double radiance_transmittance(double cos_viewer) const noexcept;
    /// Where the refracted ray goes (z < 0).
    Direction refracted(Direction to_viewer) const noexcept;
    /// Equal indices: the ray does not bend.
    bool straight() const noexcept { return relative_index_ == 1; }

private:
    double relative_index_;
};

} // namespace lightwell
