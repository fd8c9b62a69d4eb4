#pragma once

#include "engine/pictures/picture.h"

#include <array>
#include <map>
#include <string>
#include <string_view>

namespace lightwell {

/// What the text lines at the head of a Radiance picture say.
struct RgbeHeader {
    std::string history;                          ///< all lines but the first "#?" and FORMAT, as they are
    std::map<std::string, std::string> variables; ///< NAME=value lines of this picture itself, later ones win
    std::string format;                           ///< empty in very old pictures
    std::array<double, 3> factors{1, 1, 1};       ///< product of EXPOSURE and COLORCORR: pixel = radiance * factor
};

/// Lines that begin with a tab tell of the pictures this one was made from; they are history and change nothing here.
/// @throws InputError: exposure or colour correction that is not a positive number
RgbeHeader parse_rgbe_header(std::string_view lines, const std::string& place);

/// Header text for a picture, from "#?RADIANCE" to FORMAT, with the factors that its pixels must be multiplied with:
/// the picture's "history" entry as it is, then every entry that the history does not already state.
struct RgbeHeaderText {
    std::string text;
    std::array<double, 3> factors{1, 1, 1};
};
RgbeHeaderText rgbe_header_of(const Picture& picture, const std::string& place);

} // namespace lightwell
