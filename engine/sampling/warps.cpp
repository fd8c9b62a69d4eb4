#include "engine/sampling/warps.h"

#include "engine/base/frame.h"

#include <algorithm>

namespace lightwell {
namespace {

/// Direction about an axis from 1 - cos of the polar angle, which keeps its digits near the axis.
Direction about_axis(const Direction& axis, double one_minus_cos, double azimuth_rad)
{
    const double sine = std::sqrt(std::max(0.0, one_minus_cos * (2 - one_minus_cos)));
    const Vec3 local{sine * std::cos(azimuth_rad), sine * std::sin(azimuth_rad), 1 - one_minus_cos};
    return frame_about(axis).to_world(local);
}

SampledDirection in_cone(const Direction& axis, double one_minus_cos_half, UnitSquare u)
{
    return {about_axis(axis, u.u * one_minus_cos_half, 2 * pi * u.v), 1 / (2 * pi * one_minus_cos_half)};
}

/// 1 - cos of the half angle under which a sphere is seen, from the squared sine.
double one_minus_cos_from_sine(double sine_squared)
{
    return sine_squared / (1 + std::sqrt(std::max(0.0, 1 - sine_squared)));
}

double clamped_unit(double x)
{
    return std::clamp(x, -1.0, 1.0);
}

} // namespace

DiscPoint uniform_disc(UnitSquare u) noexcept
{
    const double x = 2 * u.u - 1, y = 2 * u.v - 1;
    if (x == 0 && y == 0)
        return {};
    const bool wide = std::fabs(x) > std::fabs(y);
    const double radius = wide ? x : y;
    const double angle = wide ? pi / 4 * (y / x) : pi / 2 - pi / 4 * (x / y);
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

Direction cosine_hemisphere(UnitSquare u) noexcept
{
    const DiscPoint p = uniform_disc(u);
    return {p.x, p.y, std::sqrt(std::max(0.0, 1 - p.x * p.x - p.y * p.y))};
}

Direction uniform_sphere(UnitSquare u) noexcept
{
    return about_axis({0, 0, 1}, 2 * u.u, 2 * pi * u.v);
}

double cone_solid_angle_sr(double half_angle_rad) noexcept
{
    const double sine = std::sin(half_angle_rad / 2);
    return 4 * pi * sine * sine;
}

SampledDirection uniform_cone(const Direction& axis, double half_angle_rad, UnitSquare u) noexcept
{
    const double sine = std::sin(half_angle_rad / 2);
    if (!(sine > 0))
        return {axis, 0};
    return in_cone(axis, 2 * sine * sine, u);
}

double sphere_solid_angle_sr(const Point& from, const Point& centre, double radius_m) noexcept
{
    const double distance = length(centre - from);
    if (!(distance > radius_m))
        return 4 * pi;
    const double sine = radius_m / distance;
    return 2 * pi * one_minus_cos_from_sine(sine * sine);
}

SampledDirection sphere_seen_from(const Point& from, const Point& centre, double radius_m, UnitSquare u) noexcept
{
    const Vec3 to_centre = centre - from;
    const double distance = length(to_centre);
    if (!(distance > radius_m))
        return {uniform_sphere(u), 1 / (4 * pi)};
    const double sine = radius_m / distance;
    if (!(sine > 0))
        return {normalized(to_centre), 0};
    return in_cone(to_centre / distance, one_minus_cos_from_sine(sine * sine), u);
}

double triangle_solid_angle_sr(const Vec3& a, const Vec3& ab, const Vec3& ac) noexcept
{
    const Vec3 b = a + ab, c = a + ac;
    const double la = length(a), lb = length(b), lc = length(c);
    if (!(la > 0 && lb > 0 && lc > 0))
        return 0;
    const Direction ua = a / la, ub = b / lb, uc = c / lc;
    const double volume = std::fabs(dot(ua, cross(ab / lb, ac / lc)));
    const double denominator = 1 + dot(ua, ub) + dot(ub, uc) + dot(uc, ua);
    return 2 * std::atan2(volume, denominator);
}

Point triangle_by_area(const Point& a, const Point& b, const Point& c, UnitSquare u) noexcept
{
    const double root = std::sqrt(u.u);
    return a + (b - a) * (root * (1 - u.v)) + (c - a) * (root * u.v);
}

double SeenPlane::density_per_sr(const Direction& direction, double area_m2) const noexcept
{
    const double size = length(normal);
    const double slope = dot(normal, direction); // cosine * size
    const double height = dot(normal, corner);   // distance of the plane * size
    if (!(size > 0 && area_m2 > 0) || slope == 0 || !(height / slope > 0))
        return 0;
    const double distance = height / slope;
    return distance * distance * size / (area_m2 * std::fabs(slope));
}

SphericalTriangle::SphericalTriangle(const Point& from, const Point& a, const Point& b, const Point& c) noexcept
    : plane_{a - from, cross(b - a, c - a)}, edge_b_(b - a), edge_c_(c - a), to_a_(normalized(a - from)),
      to_b_(normalized(b - from)), to_c_(normalized(c - from))
{
    solid_angle_sr_ = triangle_solid_angle_sr(a - from, edge_b_, edge_c_);
    area_m2_ = length(plane_.normal) / 2;
    // The angle at a lies between the planes that hold the two sides.
    const Vec3 side_b = cross(to_a_, to_b_), side_c = cross(to_a_, to_c_);
    alpha_rad_ = std::atan2(length(cross(side_b, side_c)), dot(side_b, side_c));
    cos_side_c_ = clamped_unit(dot(to_a_, to_b_));
    // The map divides by the square of this sine: below it, fewer than six digits would be left.
    constexpr double in_plane_sine = 1e-5;
    if (!(solid_angle_sr_ > smallest_spherical_sr))
        way_ = Way::by_area;
    else
        way_ = std::sin(alpha_rad_) > in_plane_sine ? Way::by_solid_angle : Way::by_hemisphere;
}

SampledDirection SphericalTriangle::sample(UnitSquare u) const noexcept
{
    if (!(solid_angle_sr_ > 0))
        return {};
    if (way_ == Way::by_area) {
        const Vec3& a = plane_.corner;
        const Direction direction = normalized(triangle_by_area(a, a + edge_b_, a + edge_c_, u));
        return {direction, density_per_sr(direction)};
    }
    return way_ == Way::by_hemisphere ? sample_hemisphere(u) : sample_solid_angle(u);
}

SampledDirection SphericalTriangle::sample_hemisphere(UnitSquare u) const noexcept
{
    const double side = dot(plane_.normal, plane_.corner) < 0 ? -1 : 1;
    const Direction direction = about_axis(normalized(plane_.normal * side), u.u, 2 * pi * u.v);
    const double ab = dot(cross(to_a_, to_b_), direction), bc = dot(cross(to_b_, to_c_), direction),
                 ca = dot(cross(to_c_, to_a_), direction);
    const bool inside = ab * side >= 0 && bc * side >= 0 && ca * side >= 0;
    return {direction, inside ? 1 / (2 * pi) : 0};
}

SampledDirection SphericalTriangle::sample_solid_angle(UnitSquare u) const noexcept
{
    const double area = u.u * solid_angle_sr_;
    const double s = std::sin(area - alpha_rad_), t = std::cos(area - alpha_rad_);
    const double sin_alpha = std::sin(alpha_rad_), cos_alpha = std::cos(alpha_rad_);
    const double p = t - cos_alpha, q = s + sin_alpha * cos_side_c_;
    const double below = (q * s + p * t) * sin_alpha;
    // The new vertex slides along the side a-c until the sub-triangle has the wanted area.
    const double cos_b = below == 0 ? 1 : clamped_unit(((q * t - p * s) * cos_alpha - q) / below);
    const Direction along = normalized(to_c_ - to_a_ * dot(to_c_, to_a_));
    const Direction to_new = to_a_ * cos_b + along * std::sqrt(1 - cos_b * cos_b);
    const double one_minus_z = u.v * (1 - dot(to_new, to_b_));
    const Direction across = normalized(to_new - to_b_ * dot(to_new, to_b_));
    const double sine = std::sqrt(std::max(0.0, one_minus_z * (2 - one_minus_z)));
    return {normalized(to_b_ * (1 - one_minus_z) + across * sine), 1 / solid_angle_sr_};
}

double SphericalTriangle::density_per_sr(const Direction& direction) const noexcept
{
    if (!(solid_angle_sr_ > 0))
        return 0;
    if (way_ == Way::by_area)
        return plane_.density_per_sr(direction, area_m2_);
    return way_ == Way::by_hemisphere ? 1 / (2 * pi) : 1 / solid_angle_sr_;
}

SphericalRectangle::SphericalRectangle(const Point& from, const Point& corner, const Vec3& edge_x,
                                       const Vec3& edge_y) noexcept
    : plane_{corner - from, cross(edge_x, edge_y)}, edge_x_(edge_x), edge_y_(edge_y)
{
    const Vec3 a = plane_.corner;
    // Two triangles about opposite corners: no cancellation, however far the rectangle is.
    solid_angle_sr_ =
        triangle_solid_angle_sr(a, edge_x, edge_y) + triangle_solid_angle_sr(a + edge_x + edge_y, -edge_x, -edge_y);
    area_m2_ = length(plane_.normal);
    const double size_x = length(edge_x), size_y = length(edge_y);
    const double squareness = std::fabs(dot(edge_x, edge_y));
    const double height = std::fabs(dot(plane_.normal, a));
    constexpr double right_angle_tolerance = 1e-9; // the map's relative error then stays below it
    constexpr double edge_on_sine = 1e-12;         // nearer to its plane the rectangle is a line
    if (!(solid_angle_sr_ > smallest_spherical_sr) || squareness > right_angle_tolerance * size_x * size_y ||
        !(height > edge_on_sine * area_m2_ * std::max(length(a), size_x + size_y)))
        return;
    by_area_ = false;
    x_ = edge_x / size_x;
    y_ = edge_y / size_y;
    z_ = cross(x_, y_);
    z0_ = dot(a, z_);
    if (z0_ > 0) {
        z_ = -z_;
        z0_ = -z0_;
    }
    x0_ = dot(a, x_), y0_ = dot(a, y_);
    x1_ = x0_ + size_x, y1_ = y0_ + size_y;
    // z components of the normals of the four side planes, and the inner angles between them.
    const auto edge_normal_z = [this](double extent) { return extent / std::hypot(z0_, extent); };
    const double n0 = -edge_normal_z(y0_), n2 = edge_normal_z(y1_), n3 = -edge_normal_z(x0_);
    const double g2 = std::acos(clamped_unit(-n2 * n3)), g3 = std::acos(clamped_unit(-n3 * n0));
    b0_ = n0;
    b1_ = n2;
    k_ = 2 * pi - g2 - g3;
}

Vec3 SphericalRectangle::sample_in_frame(UnitSquare u) const noexcept
{
    const double angle = u.u * solid_angle_sr_ + k_;
    const double f = (std::cos(angle) * b0_ - b1_) / std::sin(angle);
    const double cosine = clamped_unit(std::copysign(1 / std::hypot(f, b0_), f));
    const double sine = std::sqrt(1 - cosine * cosine);
    const double x = sine > 0 ? std::clamp(-cosine * z0_ / sine, x0_, x1_) : (cosine > 0 ? x1_ : x0_);
    const double d = std::hypot(x, z0_);
    const double h0 = y0_ / std::hypot(d, y0_), h1 = y1_ / std::hypot(d, y1_);
    const double h = h0 + u.v * (h1 - h0);
    const double y = h * h < 1 ? std::clamp(h * d / std::sqrt(1 - h * h), y0_, y1_) : y1_;
    return {x, y, z0_};
}

SampledDirection SphericalRectangle::sample(UnitSquare u) const noexcept
{
    if (!(solid_angle_sr_ > 0))
        return {};
    if (by_area_) {
        const Direction direction = normalized(plane_.corner + edge_x_ * u.u + edge_y_ * u.v);
        return {direction, density_per_sr(direction)};
    }
    const Vec3 p = sample_in_frame(u);
    return {normalized(x_ * p.x + y_ * p.y + z_ * p.z), 1 / solid_angle_sr_};
}

double SphericalRectangle::density_per_sr(const Direction& direction) const noexcept
{
    if (!(solid_angle_sr_ > 0))
        return 0;
    return by_area_ ? plane_.density_per_sr(direction, area_m2_) : 1 / solid_angle_sr_;
}

} // namespace lightwell
