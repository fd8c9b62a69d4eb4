#pragma once

namespace lightwell {

/// Where and when, in the conventions of Radiance's sky programs: angles in radians, west positive.
struct SkyClock {
    double latitude_rad = 0;
    double longitude_west_rad = 0;
    double meridian_west_rad = 0; ///< of the standard time
};
/// The sun against the local meridian.
struct SolarTime {
    double declination_rad = 0;
    double hour = 12; ///< 12 when the sun is in the south (on the northern half), unbounded
};
/// Day 1 is January 1; there is no February 29 (it is March 1).
int day_of_year(int month, int day) noexcept;
/// Declination and equation of time of an average year.
/// Error   up to half a degree, for a year is not one of the real ones; sun_position() knows better
/// Source  IES 1984, as gensky has it: skies that name month, day and hour mean this sun
SolarTime solar_time_of_day(int day_of_year, double hour, const SkyClock& clock) noexcept;
double declination_of_day_rad(int day_of_year) noexcept;
/// The same for a year.
/// Error   0.01 degrees from 1950 to 2050
/// Source  Michalsky 1988
SolarTime solar_time_of_date(int year, int month, int day, double hour, const SkyClock& clock) noexcept;

struct SunAngles {
    double altitude_rad = 0;
    double azimuth_rad = 0; ///< from south, west positive
};
SunAngles sun_angles(const SolarTime& sun, double latitude_rad) noexcept;

} // namespace lightwell
