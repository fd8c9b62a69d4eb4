#pragma once

#include "engine/base/vector.h"

namespace lightwell {

/// Right-handed orthonormal frame; z is usually the surface normal.
struct Frame {
    Direction x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

    Vec3 to_local(const Vec3& world) const noexcept { return {dot(world, x), dot(world, y), dot(world, z)}; }
    Vec3 to_world(const Vec3& local) const noexcept { return x * local.x + y * local.y + z * local.z; }
};

/// A frame about a unit z axis, continuous except at z = -1.
/// Source  Duff et al. 2017, "Building an Orthonormal Basis, Revisited"
inline Frame frame_about(const Direction& z) noexcept
{
    const double sign = std::copysign(1.0, z.z);
    const double a = -1.0 / (sign + z.z);
    const double b = z.x * z.y * a;
    return {{1 + sign * z.x * z.x * a, sign * b, -sign * z.x}, {b, sign + z.y * z.y * a, -z.y}, z};
}

} // namespace lightwell
