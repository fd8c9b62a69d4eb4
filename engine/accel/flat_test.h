#pragma once

#include "engine/base/vector.h"

#include <cstddef>

namespace lightwell {

/// A frame in which the ray is the third axis: corners become plane coordinates that depend on the corner and the
/// ray alone, so that surfaces sharing a corner see it in the same place, to the last bit.
struct RayFrame {
    Point origin;
    int kx, ky, kz;
    double shear_x, shear_y, inverse_z;

    RayFrame() = default;
    RayFrame(const Point& ray_origin, const Vec3& direction) noexcept : origin(ray_origin)
    {
        const double ax = std::fabs(direction.x), ay = std::fabs(direction.y), az = std::fabs(direction.z);
        kz = ax > ay ? (ax > az ? 0 : 2) : (ay > az ? 1 : 2);
        kx = kz == 2 ? 0 : kz + 1;
        ky = kx == 2 ? 0 : kx + 1;
        inverse_z = 1 / direction[kz];
        shear_x = direction[kx] * inverse_z;
        shear_y = direction[ky] * inverse_z;
    }
    struct Place {
        double x, y, depth; ///< depth / direction[kz] = t
    };
    Place place(const Point& corner) const noexcept
    {
        const double z = corner[kz] - origin[kz];
        return {(corner[kx] - origin[kx]) - shear_x * z, (corner[ky] - origin[ky]) - shear_y * z, z};
    }
};

/// Counts the crossings of an outline with the half-line from the ray to +x, edge by edge. The decision about an
/// edge is the same for both surfaces that share it, whichever way round they run.
class CrossingCount {
public:
    void edge(const RayFrame::Place& a, const RayFrame::Place& b) noexcept
    {
        if ((a.y > 0) == (b.y > 0))
            return;
        const double side = a.x * b.y - b.x * a.y; // swapping a and b negates it exactly
        if (b.y > a.y ? side > 0 : side < 0)
            inside_ = !inside_;
    }
    bool inside() const noexcept { return inside_; }

private:
    bool inside_ = false;
};

/// Ray against a planar outline of `count` corners given by corner(i).
/// @param normal  unit normal of the plane; @param on_plane a point of it
/// @return        t of the crossing, or NaN when the ray misses the outline
template <class Corner>
double flat_hit(const RayFrame& frame, const Vec3& direction, const Direction& normal, const Point& on_plane,
                std::size_t count, const Corner& corner) noexcept
{
    CrossingCount crossings;
    const RayFrame::Place first = frame.place(corner(0));
    RayFrame::Place before = first;
    double nearest = first.depth, farthest = first.depth;
    for (std::size_t i = 1; i < count; ++i) {
        const RayFrame::Place now = frame.place(corner(i));
        crossings.edge(before, now);
        nearest = std::fmin(nearest, now.depth);
        farthest = std::fmax(farthest, now.depth);
        before = now;
    }
    crossings.edge(before, first);
    if (!crossings.inside())
        return std::numeric_limits<double>::quiet_NaN();
    // Along a grazing ray the plane's equation loses its digits; the corners bound where the crossing can be.
    double t0 = nearest * frame.inverse_z, t1 = farthest * frame.inverse_z;
    if (t0 > t1)
        std::swap(t0, t1);
    const double t = dot(normal, on_plane - frame.origin) / dot(normal, direction);
    return t >= t0 ? (t <= t1 ? t : t1) : t0; // also for NaN, when the ray runs within the plane
}

} // namespace lightwell
