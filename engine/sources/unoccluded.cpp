#include "engine/sources/unoccluded.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

/// One edge's part of Lambert's sum, with the receiver's normal.
double edge_part(const Vec3& a, const Vec3& b, const Direction& normal)
{
    const Vec3 across = cross(a, b);
    const double sine = length(across);
    if (!(sine > 0))
        return 0;
    return std::atan2(sine, dot(a, b)) * (dot(normal, across) / sine);
}

} // namespace

double polygon_irradiance(const Vec3* corners, int count, const Direction& normal) noexcept
{
    Vec3 kept[most_clipped_corners];
    int n = 0;
    for (int i = 0; i < count && n + 1 < most_clipped_corners; ++i) {
        const Vec3 &a = corners[i], &b = corners[(i + 1) % count];
        const double above_a = dot(normal, a), above_b = dot(normal, b);
        if (above_a >= 0)
            kept[n++] = a;
        if ((above_a < 0) != (above_b < 0) && above_a != above_b)
            kept[n++] = a + (b - a) * (above_a / (above_a - above_b));
    }
    double sum = 0;
    for (int i = 0; i < n; ++i)
        sum += edge_part(kept[i], kept[(i + 1) % n], normal);
    return 0.5 * std::fabs(sum);
}

double sphere_irradiance(const Vec3& to_centre, double radius_m, const Direction& normal) noexcept
{
    const double distance = length(to_centre);
    if (!(distance > radius_m))
        return pi;
    const double cosine = std::clamp(dot(normal, to_centre) / distance, -1.0, 1.0), ratio = radius_m / distance;
    const double whole = pi * ratio * ratio * cosine;
    if (cosine >= ratio)
        return whole;
    if (cosine <= -ratio)
        return 0;
    // The horizon cuts the sphere.
    const double h2 = 1 / (ratio * ratio), sine2 = 1 - cosine * cosine, k2 = std::fmax(0, 1 - h2 * cosine * cosine);
    const double beyond = std::sqrt(h2 - 1),
                 angle = std::acos(std::clamp(-cosine * beyond / std::sqrt(sine2), -1.0, 1.0));
    const double cut = (cosine * angle - std::sqrt(k2 * (h2 - 1))) / h2 + std::atan(std::sqrt(k2) / beyond);
    return std::fmax(0, cut);
}

double disc_irradiance(const Vec3& to_centre, const Direction& axis, double radius_m, const Direction& normal) noexcept
{
    const double height = -dot(axis, to_centre);
    const Vec3 along = to_centre + axis * height; // in the plane of the disc
    const double a2 = dot(along, along), h2 = height * height, r2 = radius_m * radius_m;
    const double sum = a2 + h2 + r2, root = std::sqrt(std::fmax(0, sum * sum - 4 * a2 * r2)), inner = h2 + a2 - r2;
    if (!(height > 0) || !(root > 0))
        return 0;
    // Both forms are written so that no digits are lost far away, where the plain ones subtract nearly equal numbers.
    const double facing = inner > 0 ? 2 * r2 * h2 / (root * (root + inner)) : 0.5 * (1 - inner / root);
    const double sideways = 2 * height * r2 / (root * (sum + root)); // times the distance along
    return pi * std::fmax(0, -facing * dot(normal, axis) + sideways * dot(normal, along));
}

} // namespace lightwell
