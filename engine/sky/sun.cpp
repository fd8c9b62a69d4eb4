#include "engine/sky/sky.h"

#include <cmath>
#include <cstddef>

namespace lightwell {
namespace {

/// One term amplitude * cos(phase + rate * t), t in Julian millennia from 2000 January 1.5.
struct Term {
    double amplitude, phase, rate;
};

// Earth's heliocentric longitude (1e-8 rad) and distance (1e-8 au), the terms above 1 arc second.
// Source  Bretagnon, Francou 1988 (VSOP87), as listed in Reda, Andreas 2004, Table A4.2
constexpr Term longitude_0[] = {{175347046, 0, 0},           {3341656, 4.6692568, 6283.07585},
                                {34894, 4.6261, 12566.1517}, {3497, 2.7441, 5753.3849},
                                {3418, 2.8289, 3.5231},      {3136, 3.6277, 77713.7715},
                                {2676, 4.4181, 7860.4194},   {2343, 6.1352, 3930.2097},
                                {1324, 0.7425, 11506.7698},  {1273, 2.0371, 529.691},
                                {1199, 1.1096, 1577.3435},   {990, 5.233, 5884.927},
                                {902, 2.045, 26.298},        {857, 3.508, 398.149},
                                {780, 1.179, 5223.694},      {753, 2.533, 5507.553},
                                {505, 4.583, 18849.228}};
constexpr Term longitude_1[] = {
    {628331966747, 0, 0}, {206059, 2.678235, 6283.07585}, {4303, 2.6351, 12566.1517}, {425, 1.59, 3.523}};
constexpr Term longitude_2[] = {{52919, 0, 0}, {8720, 1.0721, 6283.0758}};
constexpr Term distance_0[] = {{100013989, 0, 0}, {1670700, 3.0984635, 6283.07585}, {13956, 3.05525, 12566.1517}};

template <std::size_t count>
double sum_of(const Term (&terms)[count], double t)
{
    double sum = 0;
    for (const Term& term : terms)
        sum += term.amplitude * std::cos(term.phase + term.rate * t);
    return sum * 1e-8;
}

/// Days from 2000 January 1, 12 h, by the Gregorian calendar; the day of the month may carry a fraction.
double days_from_2000(int year, int month, double day)
{
    // Counted from March, so that the leap day comes last; 30.6001 spreads the lengths of the months.
    const int y = month > 2 ? year : year - 1, m = month > 2 ? month : month + 12;
    const double leap_days = std::floor(y / 4.0) - std::floor(y / 100.0) + std::floor(y / 400.0);
    constexpr double first_of_2000_noon = 730548.5; // in this count
    return 365.0 * y + leap_days + std::floor(30.6001 * (m + 1)) + day - first_of_2000_noon;
}

struct Apparent {
    double right_ascension_rad, declination_rad, distance_au;
    double equation_of_equinoxes_rad; ///< apparent minus mean sidereal time
};

/// The sun from the Earth's centre, with nutation and aberration.
/// Source  Meeus 1998, chapters 22 and 25
Apparent apparent_sun(double days_terrestrial)
{
    const double t = days_terrestrial / 365250, century = t * 10;
    constexpr double arc_second = radians_per_degree / 3600;
    const double longitude = sum_of(longitude_0, t) + t * (sum_of(longitude_1, t) + t * sum_of(longitude_2, t)) + pi;
    const double distance = sum_of(distance_0, t);
    const double node = (125.04452 - 1934.136261 * century) * radians_per_degree;
    const double sun = (280.4665 + 36000.7698 * century) * radians_per_degree;
    const double moon = (218.3165 + 481267.8813 * century) * radians_per_degree;
    const double in_longitude =
        (-17.20 * std::sin(node) - 1.32 * std::sin(2 * sun) - 0.23 * std::sin(2 * moon) + 0.21 * std::sin(2 * node)) *
        arc_second;
    const double in_obliquity =
        (9.20 * std::cos(node) + 0.57 * std::cos(2 * sun) + 0.10 * std::cos(2 * moon) - 0.09 * std::cos(2 * node)) *
        arc_second;
    const double obliquity = (84381.448 - 46.8150 * century) * arc_second + in_obliquity;
    const double aberration = -20.4898 * arc_second / distance;
    const double apparent = longitude + in_longitude + aberration;
    return {std::atan2(std::sin(apparent) * std::cos(obliquity), std::cos(apparent)),
            std::asin(std::sin(apparent) * std::sin(obliquity)), distance, in_longitude * std::cos(obliquity)};
}

/// Greenwich mean sidereal time.  Source  Meeus 1998, Eq. (12.4)
double mean_sidereal_rad(double days_universal)
{
    const double degrees = 280.46061837 + 360.98564736629 * days_universal;
    return std::fmod(degrees, 360.0) * radians_per_degree;
}

} // namespace

SunPosition sun_position(const PlaceAndTime& when)
{
    const double hour_utc = when.hour - when.utc_offset_h;
    const double universal = days_from_2000(when.year, when.month, when.day + hour_utc / 24);
    // Terrestrial minus universal time: 29 s in 1950, 64 s in 2000, about 90 s in 2050. The sun moves 0.04 arc
    // seconds in a second, so that a constant costs 0.0004 degrees at most.
    constexpr double terrestrial_minus_universal_s = 62;
    const Apparent sun = apparent_sun(universal + terrestrial_minus_universal_s / 86400);
    const double hour_angle = mean_sidereal_rad(universal) + sun.equation_of_equinoxes_rad +
                              when.longitude_deg * radians_per_degree - sun.right_ascension_rad;
    const double latitude = when.latitude_deg * radians_per_degree;
    const double sin_d = std::sin(sun.declination_rad), cos_d = std::cos(sun.declination_rad);
    const double up = std::sin(latitude) * sin_d + std::cos(latitude) * cos_d * std::cos(hour_angle);
    const double north = std::cos(latitude) * sin_d - std::sin(latitude) * cos_d * std::cos(hour_angle);
    const double east = -cos_d * std::sin(hour_angle);
    // Seen from the surface instead of the centre, the sun stands lower by up to 8.8 arc seconds.
    constexpr double parallax_rad = 8.794 * radians_per_degree / 3600;
    const double across = std::hypot(north, east);
    const double altitude = std::atan2(up - parallax_rad / sun.distance_au, across);
    double azimuth_deg = std::atan2(east, north) / radians_per_degree;
    if (azimuth_deg < 0)
        azimuth_deg += 360;
    return {altitude / radians_per_degree, azimuth_deg};
}

Direction sun_direction(const SunPosition& sun, double north_deg)
{
    const double altitude = sun.altitude_deg * radians_per_degree;
    // Azimuth runs clockwise from the model's north, which is north_deg counter-clockwise from +y.
    const double clockwise_from_y = (sun.azimuth_deg - north_deg) * radians_per_degree;
    return {std::cos(altitude) * std::sin(clockwise_from_y), std::cos(altitude) * std::cos(clockwise_from_y),
            std::sin(altitude)};
}

} // namespace lightwell
