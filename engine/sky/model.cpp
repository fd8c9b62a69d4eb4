#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "engine/sky/measured_sky.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

/// lm/W with which sky programs turn the models' luminances into watts.
constexpr double sky_lumens_per_watt = 203, sun_lumens_per_watt = 208;
/// The clear and intermediate models do not hold with the sun at the zenith, where the tangent runs away.
constexpr double highest_sun_rad = 87 * radians_per_degree;
/// The disc for which the models' solar luminances are stated.
constexpr double stated_sun_angle_deg = 0.5;
/// Its solid angle, as the models use it for the ground.
constexpr double stated_sun_sr = 6e-5;
/// The solid angle by which they spread a measured irradiance.
constexpr double measured_sun_sr = 5.98e-5;

double sine_squared(double full_angle_deg)
{
    const double sine = std::sin(full_angle_deg / 2 * radians_per_degree);
    return sine * sine;
}

/// The sun no higher than the models hold; at the very zenith it moves south.
Direction within_model(const Direction& to_sun)
{
    const double across = std::hypot(to_sun.x, to_sun.y);
    if (std::atan2(to_sun.z, across) <= highest_sun_rad)
        return to_sun;
    const double x = across > 0 ? to_sun.x / across : 0, y = across > 0 ? to_sun.y / across : -1;
    return {x * std::cos(highest_sun_rad), y * std::cos(highest_sun_rad), std::sin(highest_sun_rad)};
}

/// Diffuse irradiance over zenith radiance, times the normalization, as a polynomial of the altitude.
/// Source  the fits that gensky makes to the integrals of the two skies
double diffuse_integral(CieSky kind, double altitude_rad)
{
    constexpr double clear[] = {2.766521, 0.547665, -0.369832, 0.009237, 0.059229};
    constexpr double intermediate[] = {3.5556, -2.7152, -1.3081, 1.0660, 0.60227};
    const auto& c = kind == CieSky::intermediate ? intermediate : clear;
    const double x = (altitude_rad - pi / 4) / (pi / 4);
    return c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * c[4])));
}

/// The brightness function's value towards the zenith before it is normalized.
double zenith_value(CieSky kind, double altitude_rad)
{
    const double from_zenith_rad = pi / 2 - altitude_rad, sine = std::sin(altitude_rad);
    if (kind == CieSky::intermediate)
        return (2.739 + 0.9891 * std::sin(0.3119 + 2.6 * altitude_rad)) *
               std::exp(-from_zenith_rad * (0.4441 + 1.48 * altitude_rad));
    return 0.274 * (0.91 + 10 * std::exp(-3 * from_zenith_rad) + 0.45 * sine * sine);
}

/// Zenith luminance in kcd/m^2; zero instead of negative in deep twilight.
/// Source  clear: CIE, with Linke's turbidity; overcast: Krochmann 1963; intermediate: their mean
double zenith_kcd_per_m2(CieSky kind, double turbidity, double altitude_rad)
{
    const double overcast = 8.6 * std::sin(altitude_rad) + 0.123;
    if (kind == CieSky::overcast || kind == CieSky::uniform)
        return std::max(0.0, overcast);
    const double clear = (1.376 * turbidity - 1.81) * std::tan(altitude_rad) + 0.38;
    return std::max(0.0, kind == CieSky::intermediate ? (clear + overcast) / 2 : clear);
}

/// Radiance of the sun's disc of stated_sun_angle_deg.
double stated_sun_radiance(CieSky kind, double sine)
{
    constexpr double lowest_sine = 0.16;        // the extinction formula holds above 9 degrees
    constexpr double through_thin_cloud = 0.15; // an intermediate sky dims the sun to this share
    const double clear = 1.5e9 / sun_lumens_per_watt * (1.147 - 0.147 / std::max(sine, lowest_sine));
    return kind == CieSky::intermediate ? through_thin_cloud * clear : clear;
}

void check(const SkyOptions& options, const Direction& to_sun, double least_turbidity)
{
    if (!(options.turbidity >= least_turbidity && std::isfinite(options.turbidity)))
        throw InputError("sky",
                         "turbidity is " + shortest(options.turbidity) + ", expected >= " + shortest(least_turbidity) +
                             " (pure air has 1)",
                         "a clear day has 2 to 3, haze 5 to 8");
    if (!(options.ground_reflectance >= 0 && options.ground_reflectance <= 1))
        throw InputError("sky",
                         "ground reflectance is " + shortest(options.ground_reflectance) + ", expected in [0, 1]",
                         "grass has 0.2, snow 0.8");
    constexpr double unit_tolerance = 1e-6; // directions printed with six digits are accepted
    if (!(std::fabs(length(to_sun) - 1) <= unit_tolerance * 2))
        throw InputError("sky", "direction to the sun has length " + shortest(length(to_sun)) + ", expected 1",
                         "normalize it");
}

} // namespace

SkyModel make_sky(const SkyOptions& options, const Direction& to_sun)
{
    check(options, to_sun, 1);
    return make_measured_sky(options, {}, to_sun).sky;
}

MeasuredSky make_measured_sky(const SkyOptions& options, const MeasuredLight& measured, const Direction& to_sun)
{
    check(options, to_sun, 0);
    const bool follows_sun = options.kind == CieSky::clear || options.kind == CieSky::intermediate;
    SkyModel sky;
    sky.kind = options.kind;
    sky.to_sun = follows_sun ? within_model(to_sun) : to_sun;
    const double sine = std::clamp(sky.to_sun.z, -1.0, 1.0), altitude_rad = std::asin(sine);
    double mean_over_zenith = options.kind == CieSky::overcast ? 7.0 / 9 : 1; // of sky radiance, cosine-weighted
    if (follows_sun) {
        sky.normalization = zenith_value(options.kind, altitude_rad);
        mean_over_zenith = diffuse_integral(options.kind, altitude_rad) / sky.normalization / pi;
    }
    sky.zenith = measured.diffuse_W_per_m2
                     ? *measured.diffuse_W_per_m2 / pi / mean_over_zenith
                     : measured.zenith.value_or(zenith_kcd_per_m2(options.kind, options.turbidity, altitude_rad) *
                                                1000 / sky_lumens_per_watt);
    const double mean = sky.zenith * mean_over_zenith;
    double stated = 0;
    sky.ground = mean;
    if (follows_sun && sine > 0) {
        stated = measured.direct_W_per_m2 ? *measured.direct_W_per_m2 / measured_sun_sr / sine
                                          : measured.half_degree_sun.value_or(stated_sun_radiance(options.kind, sine));
        // The ground is lit by the sun even when its disc is left out of the scene.
        sky.ground += stated_sun_sr / pi * stated * sine;
        sky.with_sun = options.with_sun;
        sky.sun_radiance = stated * sine_squared(stated_sun_angle_deg) / sine_squared(sun_full_angle_deg);
    }
    sky.ground *= options.ground_reflectance;
    return {sky, mean, stated};
}

} // namespace lightwell
