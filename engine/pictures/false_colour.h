#pragma once

#include "engine/pictures/png.h"

#include <string>

namespace lightwell {

/// A field of numbers as a labelled map: perceptually ordered colours, a legend with round numbers and the unit,
/// a title line and a line below it (average, minimum, uniformity, error).
struct FalseColour {
    std::string title;
    std::string caption;
    std::string unit = "lx";
    double low = 0, high = 0; ///< high 0: a round number above the 99th percentile
    bool logarithmic = false;
};
/// @param values       width * height, row 0 at the top; NaN is drawn as background (no value there)
/// @param cell_pixels  side of a value's square; taken larger where the map would be too small to see
/// @throws InputError: sizes that do not agree, ends of the scale not finite or not in order
DisplayPicture false_colour(const std::vector<float>& values, int width, int height, const FalseColour& options,
                            int cell_pixels = 1);

} // namespace lightwell
