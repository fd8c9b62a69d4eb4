#pragma once

#include <compare>

namespace lightwell {

/// A number with its unit in the type; converts only where the code says so.
template <class Unit>
struct Quantity {
    double value = 0;

    Quantity() = default;
    explicit constexpr Quantity(double number) noexcept : value(number) {}
    constexpr auto operator<=>(const Quantity&) const noexcept = default;
    constexpr Quantity operator+(Quantity b) const noexcept { return Quantity{value + b.value}; }
    constexpr Quantity operator-(Quantity b) const noexcept { return Quantity{value - b.value}; }
    constexpr Quantity operator*(double s) const noexcept { return Quantity{value * s}; }
    constexpr double operator/(Quantity b) const noexcept { return value / b.value; }
};

using Luminance = Quantity<struct CandelaPerSquareMetre>; ///< cd/m^2
using Illuminance = Quantity<struct Lux>;                 ///< lx
using Length = Quantity<struct Metre>;                    ///< m
using MetresPerUnit = Quantity<struct MetrePerFileUnit>;  ///< m per drawing unit
using InverseSolidAngle = Quantity<struct PerSteradian>;  ///< 1/sr

} // namespace lightwell
