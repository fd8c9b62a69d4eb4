#pragma once

#include "engine/pictures/png.h"

#include <array>
#include <string>
#include <string_view>

namespace lightwell {

/// A bitmap font: 5 columns and one of space, 7 rows above the base line and 2 below.
inline constexpr int glyph_advance = 6, glyph_height = 9, cap_height = 7;

/// Width in pixels of a line of UTF-8 text at an integer scale.
int text_width(std::string_view text, int scale);
/// Draws one line whose upper left corner is (x, y); what lies outside the picture is cut off. ASCII and the signs
/// of degree, square, cube, plus-minus, micro, times, at least, at most; other characters become an empty box.
void draw_text(DisplayPicture& picture, int x, int y, std::string_view text, int scale,
               std::array<std::uint8_t, 3> colour);
/// Lines of at most `width` pixels, broken at blanks where there are any.
std::vector<std::string> wrapped(std::string_view text, int width, int scale);
/// Fills a rectangle; what lies outside the picture is cut off.
void fill(DisplayPicture& picture, int x, int y, int width, int height, std::array<std::uint8_t, 3> colour);

} // namespace lightwell
