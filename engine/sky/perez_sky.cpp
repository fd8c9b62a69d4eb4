#include "engine/sky/perez_sky.h"

#include "engine/base/errors.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lightwell {
namespace {

constexpr int bins = 8;
/// Where one range of clearness ends and the next begins.
constexpr double bin_ends[bins] = {1.065, 1.230, 1.500, 1.950, 2.800, 4.500, 6.200, 12.01};
constexpr double least_clearness = 1, most_clearness = 12.01, least_brightness = 0.01, most_brightness = 0.6;

/// For each range of clearness four numbers each for a, b, c, d, e.
constexpr double shapes[bins][20] = {
    {1.3525, -0.2576, -0.2690, -1.4366, -0.7670, 0.0007, 1.2734, -0.1233, 2.8000,  0.6004,
     1.2375, 1.0000,  1.8734,  0.6297,  0.9738,  0.2809, 0.0356, -0.1246, -0.5718, 0.9938},
    {-1.2219, -0.7730, 1.4148,  1.1016,  -0.2054, 0.0367, -3.9128, 0.9156, 6.9750,  0.1774,
     6.4477,  -0.1239, -1.5798, -0.5081, -1.7812, 0.1080, 0.2624,  0.0672, -0.2190, -0.4285},
    {-1.1000,  -0.2515, 0.8952,  0.0156, 0.2782, -0.1812, -4.5000, 1.1766, 24.7219, -13.0812,
     -37.7000, 34.8438, -5.0000, 1.5218, 3.9229, -2.6204, -0.0156, 0.1597, 0.4199,  -0.5562},
    {-0.5484,  -0.6654, -0.2672, 0.7117, 0.7234, -0.6219, -5.6812, 2.6297,  33.3389, -18.3000,
     -62.2500, 52.0781, -3.5000, 0.0016, 1.1477, 0.1062,  0.4659,  -0.3296, -0.0876, -0.0329},
    {-0.6000,  -0.3566, -2.5000, 2.3250,  0.2937, 0.0496, -5.6812, 1.8415, 21.0000, -4.7656,
     -21.5906, 7.2492,  -3.5000, -0.1554, 1.4062, 0.3988, 0.0032,  0.0766, -0.0656, -0.1294},
    {-1.0156, -0.3670, 1.0078,  1.4051,  0.2875,  -0.5328, -3.8500, 3.3750, 14.0000, -0.9999,
     -7.1406, 7.5469,  -3.4000, -0.1078, -1.0750, 1.5702,  -0.0672, 0.4016, 0.3017,  -0.4844},
    {-1.0000, 0.0211,  0.5025,  -0.5119, -0.3000, 0.1922, 0.7023, -1.6317, 19.0000, -5.0000,
     1.2438,  -1.9094, -4.0000, 0.0250,  0.3844,  0.2656, 1.0468, -0.3788, -2.4517, 1.4656},
    {-1.0500,  0.0289,  0.4260,  0.3590, -0.3250, 0.1156, 0.7781, 0.0025,  31.0625, -14.5000,
     -46.1148, 55.3750, -7.2312, 0.4050, 13.3500, 0.6234, 1.5000, -0.6426, 1.8564,  0.5636}};

struct Efficacy {
    double a, b, c, d;
};
constexpr Efficacy diffuse_efficacies[bins] = {{97.24, -0.46, 12.00, -8.91},   {107.22, 1.15, 0.59, -3.95},
                                               {104.97, 2.96, -5.53, -8.77},   {102.39, 5.59, -13.95, -13.90},
                                               {100.71, 5.94, -22.75, -23.74}, {106.42, 3.83, -36.15, -28.83},
                                               {141.88, 1.90, -53.24, -14.03}, {152.23, 0.35, -45.27, -7.98}};
constexpr Efficacy direct_efficacies[bins] = {{57.20, -4.55, -2.98, 117.12}, {98.99, -3.46, -1.21, 12.38},
                                              {109.83, -4.90, -1.71, -8.81}, {110.34, -5.84, -1.99, -4.56},
                                              {106.36, -3.97, -1.75, -6.16}, {107.19, -1.25, -1.51, -26.73},
                                              {105.75, 0.77, -1.26, -34.44}, {101.18, 1.58, -1.10, -8.29}};

int bin_of(double clearness)
{
    int bin = 0;
    while (bin < bins - 1 && clearness >= bin_ends[bin])
        ++bin;
    return bin;
}

double angle_between(const Direction& a, const Direction& b)
{
    return std::atan2(length(cross(a, b)), dot(a, b));
}

double clearness_of_zenith(double zenith_rad)
{
    return 1.041 * zenith_rad * zenith_rad * zenith_rad;
}

/// Patches of equal size around the zenith.
struct PatchRing {
    double altitude_deg;
    int count;
};

double ring_sum(const SkyShape& shape, const Direction& to_sun, double altitude_rad, int count)
{
    const double height = std::sin(altitude_rad), across = std::cos(altitude_rad);
    const double first = std::atan2(to_sun.x, to_sun.y); // one of the patches lies below or above the sun
    double sum = 0;
    for (int i = 0; i < count; ++i) {
        const double turn = first + 2 * pi * i / count;
        const Direction direction{across * std::sin(turn), across * std::cos(turn), height};
        sum += shape.relative(height, angle_between(direction, to_sun)) * height;
    }
    return sum;
}

} // namespace

double SkyShape::relative(double height, double angle_to_sun_rad) const noexcept
{
    constexpr double lowest = 0.01; // where exp(b / height) no longer changes, as perezlum.cal has it
    const double cosine = std::cos(angle_to_sun_rad);
    return (1 + a * std::exp(b / std::max(height, lowest))) *
           (1 + c * std::exp(d * angle_to_sun_rad) + e * cosine * cosine);
}

double SkyShape::patch_sum(const Direction& to_sun) const noexcept
{
    constexpr PatchRing rings[] = {{6, 30}, {18, 30}, {30, 24}, {42, 24}, {54, 18}, {66, 12}, {78, 6}, {90, 1}};
    constexpr int patches = 145;
    double sum = 0;
    for (const PatchRing& ring : rings)
        sum += ring_sum(*this, to_sun, ring.altitude_deg * radians_per_degree, ring.count);
    return sum * 2 * pi / patches;
}

double SkyShape::integral(const Direction& to_sun) const noexcept
{
    constexpr int rings = 1000, around = 720;
    double sum = 0;
    for (int i = 0; i < rings; ++i) {
        const double altitude = (i + 0.5) / rings * pi / 2;
        sum += ring_sum(*this, to_sun, altitude, around) * std::cos(altitude);
    }
    return sum * (pi / 2 / rings) * (2 * pi / around);
}

SkyShape general_sky(int number)
{
    if (number < 1 || number > 15)
        throw InputError("sky", "general sky " + std::to_string(number) + " does not exist, expected 1 to 15",
                         "1 to 5 are overcast, 6 to 10 partly cloudy, 11 to 15 clear");
    constexpr double gradations[6][2] = {{4.0, -0.70}, {1.1, -0.8}, {0, -1}, {-1, -0.55}, {-1, -0.32}, {-1, -0.15}};
    constexpr double indicatrices[6][3] = {{0, -1, 0},       {2, -1.5, 0.15},  {5, -2.5, 0.30},
                                           {10, -3.0, 0.45}, {16, -3.0, 0.30}, {24, -2.8, 0.15}};
    constexpr int kinds[15][2] = {{1, 1}, {1, 2}, {2, 1}, {2, 2}, {3, 1}, {3, 2}, {3, 3}, {3, 4},
                                  {4, 2}, {4, 3}, {4, 4}, {5, 4}, {5, 5}, {6, 5}, {6, 6}};
    const auto& [gradation, indicatrix] = kinds[number - 1];
    const auto& [a, b] = gradations[gradation - 1];
    const auto& [c, d, e] = indicatrices[indicatrix - 1];
    // The CIE subtracts the indicatrix at a right angle to the sun; divided by what is left of 1 it is Perez' form.
    const double rest = 1 - c * std::exp(d * pi / 2);
    return {a, b, c / rest, d, e / rest};
}

Weather within_bounds(Weather weather) noexcept
{
    constexpr double inside = 0.001; // gendaylit stays this far below the upper bounds
    if (!(weather.clearness >= least_clearness))
        weather.clearness = least_clearness;
    if (weather.clearness > most_clearness)
        weather.clearness = most_clearness - inside;
    if (!(weather.brightness >= least_brightness))
        weather.brightness = least_brightness;
    if (weather.brightness > most_brightness)
        weather.brightness = most_brightness - inside;
    return weather;
}

SkyShape perez_shape(const Weather& weather, double zenith)
{
    const int bin = bin_of(weather.clearness);
    const auto& x = shapes[bin];
    // Between the first range and clear skies the table was not made for dark ones.
    const double brightness =
        weather.clearness > 1.065 && weather.clearness < 2.8 ? std::max(weather.brightness, 0.2) : weather.brightness;
    const auto value = [&](int first) {
        return x[first] + x[first + 1] * zenith + brightness * (x[first + 2] + x[first + 3] * zenith);
    };
    SkyShape shape{value(0), value(4), value(8), value(12), value(16)};
    if (bin == 0) {
        shape.c = std::exp(std::pow(brightness * (x[8] + x[9] * zenith), x[10])) - x[11];
        shape.d = -std::exp(brightness * (x[12] + x[13] * zenith)) + x[14] + brightness * x[15];
    }
    return shape;
}

double diffuse_efficacy(const Weather& weather, double zenith) noexcept
{
    const Efficacy& x = diffuse_efficacies[bin_of(weather.clearness)];
    return x.a + x.b * weather.water_cm + x.c * std::cos(zenith) + x.d * std::log(weather.brightness);
}

double direct_efficacy(const Weather& weather, double zenith) noexcept
{
    const Efficacy& x = direct_efficacies[bin_of(weather.clearness)];
    return std::max(0.0, x.a + x.b * weather.water_cm + x.c * std::exp(5.73 * zenith - 5) + x.d * weather.brightness);
}

double extraterrestrial_W_per_m2(int day) noexcept
{
    constexpr double solar_constant = 1367;
    const double angle = 2 * pi * (day - 1) / 365;
    return solar_constant * (1.00011 + 0.034221 * std::cos(angle) + 0.00128 * std::sin(angle) +
                             0.000719 * std::cos(2 * angle) + 0.000077 * std::sin(2 * angle));
}

double air_mass(double zenith) noexcept
{
    const double degrees = std::min(zenith / radians_per_degree, 90.0);
    return 1 / (std::cos(degrees * radians_per_degree) + 0.15 * std::pow(93.885 - degrees, -1.253));
}

Weather weather_of(const SkyIrradiance& light, double zenith, int day) noexcept
{
    const double k = clearness_of_zenith(zenith);
    Weather weather;
    weather.clearness = ((light.diffuse + light.direct) / light.diffuse + k) / (1 + k);
    weather.brightness = light.diffuse * air_mass(zenith) / extraterrestrial_W_per_m2(day);
    return weather;
}

SkyIrradiance irradiance_of(const Weather& weather, double zenith, int day) noexcept
{
    const double k = clearness_of_zenith(zenith);
    const double diffuse = weather.brightness * extraterrestrial_W_per_m2(day) / air_mass(zenith);
    return {diffuse * (weather.clearness * (1 + k) - k - 1), diffuse};
}

double diffuse_share(double index) noexcept
{
    if (index <= 0.22)
        return 1 - 0.09 * index;
    if (index <= 0.8)
        return 0.9511 + index * (-0.1604 + index * (4.388 + index * (-16.638 + index * 12.336)));
    return 0.165;
}

} // namespace lightwell
