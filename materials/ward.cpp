#include "materials/ward.h"

#include "engine/base/frame.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

/// Below this height of the half vector its fourth power leaves the range of numbers; no light travels so flat.
constexpr double lowest_half_height = 1e-70;

double squared(double x)
{
    return x * x;
}

/// exp(-tan^2 / roughness^2) of the facet that mirrors one direction into the other; half is not normalized.
double facet_share(const Vec3& half, double u, double v)
{
    return std::exp(-(squared(half.x / u) + squared(half.y / v)) / squared(half.z));
}

} // namespace

ScatteredLobe Ward::scattered(Direction to_viewer, Direction to_light) const noexcept
{
    const Vec3 half = to_viewer + to_light;
    if (!(to_viewer.z > 0 && to_light.z > 0 && half.z > lowest_half_height))
        return {};
    const double z2 = half.z * half.z;
    const double value = facet_share(half, u_, v_) * dot(half, half) / (pi * u_ * v_ * z2 * z2);
    // Density is value * cos_light / weight, with the weight 2 cos_light / (cos_viewer + cos_light).
    return {value, value * half.z / 2};
}

Direction Ward::sample(Direction to_viewer, UnitSquare u) const noexcept
{
    const double slope = std::sqrt(-std::log1p(-u.u));
    const double azimuth = 2 * pi * u.v;
    const Vec3 half{u_ * slope * std::cos(azimuth), v_ * slope * std::sin(azimuth), 1};
    const Vec3 mirrored = half * (2 * dot(to_viewer, half) / dot(half, half)) - to_viewer;
    return normalized(mirrored);
}

ScatteredLobe BrushedTransmission::scattered(Direction to_viewer, Direction to_light) const noexcept
{
    if (!(to_viewer.z > 0 && to_light.z < 0))
        return {};
    const Vec3 moved = to_viewer + to_light;
    const double lobe = std::exp(-(squared(moved.x / u_) + squared(moved.y / v_))) / (pi * u_ * v_);
    return {lobe, lobe * -to_light.z};
}

Vec3 BrushedTransmission::sample(Direction to_viewer, UnitSquare u) const noexcept
{
    const double radius = std::sqrt(-std::log1p(-u.u));
    const double azimuth = 2 * pi * u.v;
    const double x = u_ * radius * std::cos(azimuth) - to_viewer.x, y = v_ * radius * std::sin(azimuth) - to_viewer.y;
    const double z2 = 1 - x * x - y * y;
    return z2 > 0 ? Vec3{x, y, -std::sqrt(z2)} : Vec3{};
}

ScatteredLobe RoughTransmission::scattered(Direction to_viewer, Direction to_light) const noexcept
{
    if (!(to_viewer.z > 0 && to_light.z < 0))
        return {};
    // |sum|^2 = 2 - 2 cos of the angle to the straight direction, without cancellation.
    const Vec3 sum = to_viewer + to_light;
    const double width = roughness_ * roughness_;
    const double lobe = std::exp(-dot(sum, sum) / width) / (pi * width);
    const double root = std::sqrt(to_viewer.z * -to_light.z);
    return {lobe / std::max(root, roughness_ / 2), lobe / -std::expm1(-4 / width)};
}

Direction RoughTransmission::sample(Direction to_viewer, UnitSquare u) const noexcept
{
    const double width = roughness_ * roughness_;
    const double one_minus_cos = std::min(2.0, -0.5 * width * std::log1p(u.u * std::expm1(-4 / width)));
    const double sine = std::sqrt(std::max(0.0, one_minus_cos * (2 - one_minus_cos)));
    const double azimuth = 2 * pi * u.v;
    const Vec3 local{sine * std::cos(azimuth), sine * std::sin(azimuth), 1 - one_minus_cos};
    return normalized(frame_about(-to_viewer).to_world(local));
}

} // namespace lightwell
