#pragma once

#include <array>
#include <cstdint>

namespace lightwell {

/// Colour of a place on a scale from 0 (dark violet) over blue, green and orange to 1 (pale yellow).
///
/// Lightness CIE L* rises in equal steps, so that equal differences look equally large, the order is seen without a
/// legend, and a black-and-white copy keeps it. Values outside [0, 1] take the nearest end.
std::array<std::uint8_t, 3> map_colour(double place) noexcept;

/// CIE 1976 lightness L*, 0 (black) to 100 (white), of an sRGB colour.
double lightness_of(std::array<std::uint8_t, 3> srgb) noexcept;

} // namespace lightwell
