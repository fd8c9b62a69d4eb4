#pragma once

#include "engine/base/vector.h"

namespace lightwell {

/// A moment at a place, by the clock of that place.
struct PlaceAndTime {
    double latitude_deg = 0;  ///< north positive
    double longitude_deg = 0; ///< east positive
    double utc_offset_h = 0;
    int year = 2024, month = 6, day = 21;
    double hour = 12; ///< local clock time by utc_offset_h, [0, 24)
};

struct SunPosition {
    double altitude_deg; ///< above the horizon, without refraction
    double azimuth_deg;  ///< clockwise from north
};

/// The sun from a place at sea level, without refraction.
/// Error: 0.0013 degrees from 1950 to 2050, against an ephemeris at 4000 random places and times (a dozen of them in
///        tests/unit/sky).
/// Source  VSOP87, its terms above 1 arc second; Meeus 1998 (nutation, aberration, sidereal time)
SunPosition sun_position(const PlaceAndTime& when);
/// x east, y north, z up, turned so that the model's north points to north_deg counter-clockwise from +y.
Direction sun_direction(const SunPosition& sun, double north_deg = 0);

enum class CieSky { clear, intermediate, overcast, uniform };

/// The arguments of the sky's brightness function and the sun that goes with it.
/// Source  CIE standard clear, intermediate (Matsuura) and overcast skies with the zenith luminances of gensky
struct SkyModel {
    CieSky kind = CieSky::overcast;
    bool with_sun = false;
    Direction to_sun{0, 0, 1};
    double sun_radiance = 0;  ///< W/(m^2 sr) of a disc of sun_full_angle_deg; set whenever the sun is up
    double zenith = 0;        ///< W/(m^2 sr)
    double ground = 0;        ///< W/(m^2 sr)
    double normalization = 1; ///< of the brightness function of the clear and intermediate skies
};
/// The mean disc. gensky draws 0.5 degrees; make_sky() keeps the irradiance that its radiance gives with that disc.
inline constexpr double sun_full_angle_deg = 0.533;

struct SkyOptions {
    CieSky kind = CieSky::clear;
    bool with_sun = true;
    double turbidity = 2.45;
    double ground_reflectance = 0.2;
};
/// Absolute luminance from the sun's altitude, as gensky has it: 203 lm/W for the sky and 208 lm/W for the sun.
/// Overcast and uniform skies have no sun, nor has the night; under clear and intermediate skies the ground is lit by
/// the sun even when `with_sun` leaves its disc out. There the model holds up to an altitude of 87 degrees: a higher
/// sun is moved down to it, and `to_sun` says so.
/// @param to_sun  unit
/// @throws InputError for turbidity below 1, a ground reflectance outside [0, 1], a direction that is not unit
SkyModel make_sky(const SkyOptions& options, const Direction& to_sun);

/// Radiance of the sky (z >= 0) or the ground in a direction, W/(m^2 sr), without the sun's disc.
/// @param kind           1 clear, 2 overcast, 3 uniform, 4 intermediate
/// @param sharp_horizon  the formula itself; else as skybright.cal has it: sky and ground blend over the horizon
double sky_brightness(int kind, double zenith, double ground, double normalization, const Direction& to_sun,
                      const Direction& direction, bool sharp_horizon = false) noexcept;

} // namespace lightwell
