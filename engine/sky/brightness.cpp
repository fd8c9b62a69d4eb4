#include "engine/sky/sky.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

double angle_between(const Direction& a, const Direction& b)
{
    return std::atan2(length(cross(a, b)), dot(a, b));
}

/// CIE standard clear sky, relative to the value towards the zenith times the normalization.
/// Source  Kittler 1967; CIE 22 (1973)
double clear_sky(double angle_to_sun_rad, double cos_to_sun, double height)
{
    constexpr double horizon = 0.01; // where 1 - exp(-0.32 / height) has become 1
    const double indicatrix = 0.91 + 10 * std::exp(-3 * angle_to_sun_rad) + 0.45 * cos_to_sun * cos_to_sun;
    return height > horizon ? indicatrix * (1 - std::exp(-0.32 / height)) : indicatrix;
}

/// Source  Matsuura, Iwata 1990, in the form of the brightness function of Radiance
double intermediate_sky(double angle_to_sun_rad, double sun_from_zenith_rad, double from_zenith_rad)
{
    const double gradation =
        ((1.35 * std::sin(5.631 - 3.59 * from_zenith_rad) + 3.12) * std::sin(4.396 - 2.6 * sun_from_zenith_rad) + 6.37 -
         from_zenith_rad) /
        2.326;
    return gradation *
           std::exp(-0.563 * angle_to_sun_rad * ((2.629 - from_zenith_rad) * (1.562 - sun_from_zenith_rad) + 0.812));
}

} // namespace

double sky_brightness(int kind, double zenith, double ground, double normalization, const Direction& to_sun,
                      const Direction& direction, bool sharp_horizon) noexcept
{
    if (sharp_horizon && direction.z < 0)
        return ground;
    const double height = std::clamp(direction.z, -1.0, 1.0);
    double sky = zenith;
    if (kind == 1)
        sky *= clear_sky(angle_between(direction, to_sun), dot(direction, to_sun), height) / normalization;
    else if (kind == 2)
        sky *= (1 + 2 * height) / 3;
    else if (kind == 4)
        sky *= intermediate_sky(angle_between(direction, to_sun), std::acos(std::clamp(to_sun.z, -1.0, 1.0)),
                                std::acos(height)) /
               normalization;
    if (sharp_horizon)
        return sky;
    // The tenth powers of height + 1.01 and of its inverse weigh sky and ground: half and half a hair below the
    // horizon, one or the other alone a few degrees away.
    const double above = std::pow(height + 1.01, 20);
    return (above * sky + ground) / (above + 1);
}

} // namespace lightwell
