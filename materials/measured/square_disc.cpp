#include "materials/measured/square_disc.h"

#include <algorithm>
#include <cmath>

namespace lightwell {

namespace {
constexpr double eighth = pi / 4;
} // namespace

UnitSquare square_of(const DiscPoint& p) noexcept
{
    const double radius = std::fmin(1, std::hypot(p.x, p.y));
    double azimuth = std::atan2(p.y, p.x);
    if (azimuth < -eighth)
        azimuth += 2 * pi;
    double a = 0, b = 0;
    if (azimuth < eighth) {
        a = radius;
        b = azimuth * a / eighth;
    } else if (azimuth < 3 * eighth) {
        b = radius;
        a = -(azimuth - 2 * eighth) * b / eighth;
    } else if (azimuth < 5 * eighth) {
        a = -radius;
        b = (azimuth - 4 * eighth) * a / eighth;
    } else {
        b = -radius;
        a = -(azimuth - 6 * eighth) * b / eighth;
    }
    return {std::clamp((a + 1) / 2, 0.0, 1.0), std::clamp((b + 1) / 2, 0.0, 1.0)};
}

DiscPoint disc_of(const UnitSquare& s) noexcept
{
    const double a = 2 * s.u - 1, b = 2 * s.v - 1;
    if (a == 0 && b == 0)
        return {};
    double radius = 0, azimuth = 0;
    if (a > -b) {
        radius = a > b ? a : b;
        azimuth = a > b ? eighth * (b / a) : eighth * (2 - a / b);
    } else {
        radius = a < b ? -a : -b;
        azimuth = a < b ? eighth * (4 + b / a) : eighth * (6 - a / b);
    }
    return {radius * std::cos(azimuth), radius * std::sin(azimuth)};
}

} // namespace lightwell
