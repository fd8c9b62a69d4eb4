#pragma once

#include "engine/base/quantities.h"

#include <algorithm>
#include <cmath>

namespace lightwell {

/// Three linear channels in the engine's primaries (.64,.33 .29,.60 .15,.06, equal-energy white): radiance in
/// W/(m^2 sr), irradiance in W/m^2, reflectance, or whatever the name of the variable says.
struct Spectrum {
    double r = 0, g = 0, b = 0;

    constexpr bool operator==(const Spectrum&) const noexcept = default;
    static constexpr Spectrum grey(double value) noexcept { return {value, value, value}; }
    constexpr double operator[](int channel) const noexcept { return channel == 0 ? r : channel == 1 ? g : b; }
    constexpr double max() const noexcept { return std::max(r, std::max(g, b)); }
    constexpr bool is_black() const noexcept { return r == 0 && g == 0 && b == 0; }
    bool is_finite() const noexcept { return std::isfinite(r) && std::isfinite(g) && std::isfinite(b); }
};

constexpr Spectrum operator+(Spectrum a, Spectrum b) noexcept
{
    return {a.r + b.r, a.g + b.g, a.b + b.b};
}
constexpr Spectrum operator-(Spectrum a, Spectrum b) noexcept
{
    return {a.r - b.r, a.g - b.g, a.b - b.b};
}
constexpr Spectrum operator*(Spectrum a, Spectrum b) noexcept
{
    return {a.r * b.r, a.g * b.g, a.b * b.b};
}
constexpr Spectrum operator*(Spectrum a, double s) noexcept
{
    return {a.r * s, a.g * s, a.b * s};
}
constexpr Spectrum operator*(double s, Spectrum a) noexcept
{
    return a * s;
}
constexpr Spectrum operator/(Spectrum a, double s) noexcept
{
    return {a.r / s, a.g / s, a.b / s};
}
constexpr Spectrum& operator+=(Spectrum& a, Spectrum b) noexcept
{
    return a = a + b;
}
constexpr Spectrum& operator*=(Spectrum& a, Spectrum b) noexcept
{
    return a = a * b;
}

/// Radiance's photometric convention for these primaries: 179 lm per watt of equal-energy white.
inline constexpr double lumens_per_watt = 179;
/// Weights of the three channels; they sum to 1, so that grey stays grey.
inline constexpr Spectrum photometric_weights{0.265, 0.670, 0.065};

/// The weighted mean of the channels, in the unit of the channels.
constexpr double photopic(Spectrum s) noexcept
{
    return photometric_weights.r * s.r + photometric_weights.g * s.g + photometric_weights.b * s.b;
}
/// @param radiance  W/(m^2 sr)
constexpr Luminance luminance_of(Spectrum radiance) noexcept
{
    return Luminance{lumens_per_watt * photopic(radiance)};
}
/// @param irradiance  W/m^2
constexpr Illuminance illuminance_of(Spectrum irradiance) noexcept
{
    return Illuminance{lumens_per_watt * photopic(irradiance)};
}
/// Linear Rec.709 (D65) of files and hosts to the engine's primaries; white adapts to white, so grey stays grey.
Spectrum from_rec709(Spectrum linear_rec709) noexcept;
/// The engine's primaries to linear Rec.709, for display and hosts; inverse of from_rec709().
Spectrum to_rec709(Spectrum engine) noexcept;
/// sRGB transfer curve, decoded: [0, 1] -> [0, 1] linear.
/// Source  IEC 61966-2-1
double srgb_to_linear(double encoded) noexcept;
double linear_to_srgb(double linear) noexcept;

} // namespace lightwell
