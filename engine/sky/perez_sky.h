#pragma once

#include "engine/base/vector.h"

#include <string>
#include <vector>

namespace lightwell {

/// A sky whose luminance, relative to a constant, is (1 + a exp(b / cos zenith)) (1 + c exp(d g) + e cos^2 g), g the
/// angle to the sun. Perez' all-weather skies have this form, and so have the fifteen general skies of the CIE.
struct SkyShape {
    double a = 0, b = 0, c = 0, d = 0, e = 0;
    /// @param height  cosine of the angle to the zenith; from the horizon downwards the horizon's
    double relative(double height, double angle_to_sun_rad) const noexcept;
    /// Horizontal illuminance of the relative luminance.
    /// Error   exact sum over the 145 patches of Tregenza, which differs from the integral by up to 2 %
    double patch_sum(const Direction& to_sun) const noexcept;
    /// Error   relative 1e-6 with 1000 rings
    double integral(const Direction& to_sun) const noexcept;
};
/// The general sky of a number, 1 (overcast, steep gradation) to 15 (white-blue turbid, broad solar corona).
/// Source  CIE S 011/E:2003, Table 1
/// @throws InputError for another number
SkyShape general_sky(int number);

/// What the weather makes of a sky.
struct Weather {
    double clearness = 1;     ///< Perez' epsilon, 1 overcast to 12 clear
    double brightness = 0.01; ///< Perez' delta
    double water_cm = 2;      ///< precipitable water
};
/// Bounds within which the model holds; gendaylit moves what lies outside onto them.
Weather within_bounds(Weather weather) noexcept;
/// Perez' shape for weather and sun.
/// Source  Perez, Seals, Michalsky 1993, Table 1
SkyShape perez_shape(const Weather& weather, double sun_from_zenith_rad);
/// Luminous efficacies, lm/W.
/// Source  Perez, Ineichen, Seals, Michalsky, Stewart 1990, Table 4
double diffuse_efficacy(const Weather& weather, double sun_from_zenith_rad) noexcept;
double direct_efficacy(const Weather& weather, double sun_from_zenith_rad) noexcept;

/// Irradiance of sun (on a plane facing it) and sky (horizontal), W/m^2.
struct SkyIrradiance {
    double direct = 0, diffuse = 0;
};
/// The day of the year says how far away the sun is.
double extraterrestrial_W_per_m2(int day_of_year) noexcept;
/// Source  Kasten, Young 1989 in the form of 1966
double air_mass(double sun_from_zenith_rad) noexcept;
Weather weather_of(const SkyIrradiance& light, double sun_from_zenith_rad, int day_of_year) noexcept;
SkyIrradiance irradiance_of(const Weather& weather, double sun_from_zenith_rad, int day_of_year) noexcept;
/// The share of horizontal irradiance that is diffuse.
/// Source  Erbs, Klein, Duffie 1982
double diffuse_share(double clearness_index) noexcept;

} // namespace lightwell
