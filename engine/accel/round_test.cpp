#include "engine/accel/round_test.h"

namespace lightwell {
namespace {

/// Roots of a t^2 + 2 b t + c, nearer first, without cancellation.
Crossings roots(double a, double half_b, double c, double discriminant) noexcept
{
    Crossings found;
    if (!(discriminant >= 0))
        return found;
    const double q = -(half_b + std::copysign(std::sqrt(discriminant), half_b));
    double t0 = q / a, t1 = q != 0 ? c / q : t0;
    if (a == 0) { // a ray parallel to the side of a cone meets it once
        found.t[0] = -c / (2 * half_b);
        return found;
    }
    if (t0 > t1)
        std::swap(t0, t1);
    found.t[0] = t0;
    found.t[1] = t1;
    return found;
}

} // namespace

Crossings sphere_hit(const Sphere& sphere, const Point& origin, const Vec3& direction, double inverse_square) noexcept
{
    // From the point of the ray nearest to the centre: far-away rays keep their digits.
    const Vec3 to_centre = sphere.centre - origin;
    const double shift = dot(to_centre, direction) * inverse_square;
    const Vec3 foot = direction * shift - to_centre;
    const double room = sphere.radius * sphere.radius - dot(foot, foot);
    Crossings found;
    if (room >= 0) {
        const double half = std::sqrt(room * inverse_square);
        found.t[0] = shift - half;
        found.t[1] = shift + half;
    }
    return found;
}

Crossings cone_hit(const Cone& cone, const Point& origin, const Vec3& direction) noexcept
{
    const Vec3 axis = cone.ends[1] - cone.ends[0];
    const double height = length(axis);
    const Vec3 unit = axis / height;
    const double slope = (cone.radii[1] - cone.radii[0]) / height;
    // Start near the middle of the cone, as for the sphere.
    const Vec3 to_middle = (cone.ends[0] + cone.ends[1]) * 0.5 - origin;
    const double shift = dot(to_middle, direction) / dot(direction, direction);
    const Vec3 start = origin + direction * shift - cone.ends[0];
    const double z = dot(start, unit), dz = dot(direction, unit);
    const Vec3 across = start - unit * z, dacross = direction - unit * dz;
    const double radius = cone.radii[0] + slope * z, dradius = slope * dz;
    const double a = dot(dacross, dacross) - dradius * dradius;
    const double half_b = dot(across, dacross) - radius * dradius;
    const double c = dot(across, across) - radius * radius;
    const Crossings all = roots(a, half_b, c, half_b * half_b - a * c);
    Crossings found;
    int count = 0;
    for (const double t : all.t) {
        const double at = z + t * dz;
        if (at >= 0 && at <= height && cone.radii[0] + slope * at >= 0 && cone.sector.holds(unit, across + dacross * t))
            found.t[count++] = t + shift;
    }
    return found;
}

double ring_hit(const Ring& ring, const Point& origin, const Vec3& direction) noexcept
{
    const double t = dot(ring.normal, ring.centre - origin) / dot(ring.normal, direction);
    const Vec3 across = origin + direction * t - ring.centre;
    const double squared = dot(across, across);
    const bool inside = squared <= ring.outer_radius * ring.outer_radius &&
                        squared >= ring.inner_radius * ring.inner_radius && ring.sector.holds(ring.normal, across);
    return inside ? t : std::numeric_limits<double>::quiet_NaN();
}

Direction sphere_normal(const Sphere& sphere, const Point& at) noexcept
{
    return normalized(at - sphere.centre);
}

Direction cone_normal(const Cone& cone, const Point& at) noexcept
{
    const Vec3 axis = cone.ends[1] - cone.ends[0];
    const double height = length(axis);
    const Vec3 unit = axis / height;
    const Vec3 from = at - cone.ends[0];
    const Direction across = normalized(from - unit * dot(from, unit));
    return normalized(across * height - unit * (cone.radii[1] - cone.radii[0]));
}

} // namespace lightwell
