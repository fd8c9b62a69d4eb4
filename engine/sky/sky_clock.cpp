#include "engine/sky/sky_clock.h"

#include "engine/base/vector.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

constexpr double hours_per_radian = 12 / pi;

/// Days from 2000 January 1, 12 h universal time.
double days_from_2000(int year, int month, int day, double hour)
{
    const int y = month > 2 ? year : year - 1, m = month > 2 ? month : month + 12;
    const double leap_days = std::floor(y / 4.0) - std::floor(y / 100.0) + std::floor(y / 400.0);
    constexpr double first_of_2000_noon = 730548.5; // counted like the line below, months from March
    return 365.0 * y + leap_days + std::floor(30.6001 * (m + 1)) + day + hour / 24 - first_of_2000_noon;
}

double wrapped(double value, double period)
{
    return value - period * std::floor(value / period);
}

} // namespace

int day_of_year(int month, int day) noexcept
{
    constexpr int before[12] = {0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334};
    return before[std::clamp(month, 1, 12) - 1] + day;
}

double declination_of_day_rad(int day) noexcept
{
    return 0.4093 * std::sin(2 * pi / 365 * (day - 81));
}

SolarTime solar_time_of_day(int day, double hour, const SkyClock& clock) noexcept
{
    const double equation_h = 0.170 * std::sin(4 * pi / 373 * (day - 80)) - 0.129 * std::sin(2 * pi / 355 * (day - 8));
    return {declination_of_day_rad(day),
            hour + equation_h + hours_per_radian * (clock.meridian_west_rad - clock.longitude_west_rad)};
}

SolarTime solar_time_of_date(int year, int month, int day, double hour, const SkyClock& clock) noexcept
{
    const double universal_h = hour + hours_per_radian * clock.meridian_west_rad;
    const double days = days_from_2000(year, month, day, universal_h);
    const double mean_longitude = wrapped(280.460 + 0.9856474 * days, 360);
    const double anomaly = wrapped(357.528 + 0.9856003 * days, 360) * radians_per_degree;
    const double longitude =
        (mean_longitude + 1.915 * std::sin(anomaly) + 0.020 * std::sin(2 * anomaly)) * radians_per_degree;
    const double obliquity = (23.439 - 4e-7 * days) * radians_per_degree;
    const double right_ascension = std::atan2(std::cos(obliquity) * std::sin(longitude), std::cos(longitude));
    const double sidereal_h = 6.697375 + 0.0657098242 * days + universal_h;
    const double hour_angle =
        wrapped(sidereal_h - hours_per_radian * (clock.longitude_west_rad + right_ascension) + 12, 24);
    return {std::asin(std::sin(obliquity) * std::sin(longitude)), hour_angle};
}

SunAngles sun_angles(const SolarTime& sun, double latitude) noexcept
{
    const double turn = sun.hour / hours_per_radian;
    const double sd = std::sin(sun.declination_rad), cd = std::cos(sun.declination_rad);
    const double sl = std::sin(latitude), cl = std::cos(latitude);
    return {std::asin(std::clamp(sl * sd - cl * cd * std::cos(turn), -1.0, 1.0)),
            -std::atan2(cd * std::sin(turn), -cl * sd - sl * cd * std::cos(turn))};
}

} // namespace lightwell
