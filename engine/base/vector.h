#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace lightwell {

/// Three Cartesian components in double precision; metres where it is a place.
struct Vec3 {
    double x = 0, y = 0, z = 0;

    constexpr double operator[](int axis) const noexcept { return axis == 0 ? x : axis == 1 ? y : z; }
    constexpr double& operator[](int axis) noexcept { return axis == 0 ? x : axis == 1 ? y : z; }
    constexpr bool operator==(const Vec3&) const noexcept = default;
};

/// A place, in metres, right-handed, z up.
using Point = Vec3;
/// A unit vector. Directions at a surface leave the surface: `to_viewer`, `to_light`.
using Direction = Vec3;

constexpr Vec3 operator+(const Vec3& a, const Vec3& b) noexcept
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Vec3 operator-(const Vec3& a, const Vec3& b) noexcept
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Vec3 operator-(const Vec3& a) noexcept
{
    return {-a.x, -a.y, -a.z};
}
constexpr Vec3 operator*(const Vec3& a, double s) noexcept
{
    return {a.x * s, a.y * s, a.z * s};
}
constexpr Vec3 operator*(double s, const Vec3& a) noexcept
{
    return a * s;
}
constexpr Vec3 operator/(const Vec3& a, double s) noexcept
{
    return {a.x / s, a.y / s, a.z / s};
}
constexpr Vec3& operator+=(Vec3& a, const Vec3& b) noexcept
{
    return a = a + b;
}
constexpr double dot(const Vec3& a, const Vec3& b) noexcept
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Vec3 cross(const Vec3& a, const Vec3& b) noexcept
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double max_abs(const Vec3& a) noexcept
{
    return std::max(std::fabs(a.x), std::max(std::fabs(a.y), std::fabs(a.z)));
}
/// Scaled first, so that neither tiny nor huge vectors lose their length to underflow or overflow.
inline double length(const Vec3& a) noexcept
{
    const double squared = dot(a, a);
    if (squared > 1e-200 && squared < 1e200)
        return std::sqrt(squared);
    const double scale = max_abs(a);
    if (!(scale > 0) || !std::isfinite(scale))
        return scale;
    const Vec3 unit = a / scale;
    return scale * std::sqrt(dot(unit, unit));
}
/// @return a / |a|; the zero vector stays zero
inline Vec3 normalized(const Vec3& a) noexcept
{
    const double size = length(a);
    if (!(size > 0))
        return {};
    return {a.x / size, a.y / size, a.z / size};
}
inline bool is_finite(const Vec3& a) noexcept
{
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}
/// Component by component.
inline Vec3 min(const Vec3& a, const Vec3& b) noexcept
{
    return {std::fmin(a.x, b.x), std::fmin(a.y, b.y), std::fmin(a.z, b.z)};
}
inline Vec3 max(const Vec3& a, const Vec3& b) noexcept
{
    return {std::fmax(a.x, b.x), std::fmax(a.y, b.y), std::fmax(a.z, b.z)};
}

/// A point of the unit square, each coordinate in [0, 1).
struct UnitSquare {
    double u = 0, v = 0;
};

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double radians_per_degree = pi / 180;
inline constexpr double infinity = std::numeric_limits<double>::infinity();

} // namespace lightwell
