#pragma once

#include "engine/base/spectrum.h"

#include <cstdint>

namespace lightwell::dxf {

inline constexpr int colour_by_block = 0;
inline constexpr int colour_by_layer = 256;
inline constexpr int colour_white = 7; ///< what a new layer has, and what BYBLOCK means outside blocks

/// Linear Rec.709 of a colour number of AutoCAD's palette.
/// @param index  1 to 255; anything else is white
Spectrum palette_colour(int index);
/// Linear Rec.709 of group 420.  @param rgb  0xRRGGBB, sRGB
Spectrum true_colour(std::int32_t rgb);

} // namespace lightwell::dxf
