#pragma once

#include "engine/pictures/picture.h"

namespace lightwell {

/// How far values are from a reference.
struct Difference {
    double relative_rms = 0; ///< root of mean square difference / root of mean square reference; 0 when both are 0
    double mean_ratio = 1;   ///< mean / mean of the reference; 1 when both are 0
    double worst = 0;        ///< largest absolute difference, in the channel's unit
    int worst_x = 0, worst_y = 0;
    std::size_t compared = 0;   ///< pixels finite in both
    std::size_t mismatched = 0; ///< pixels finite, infinite or not a number in one and not so in the other
};

struct Comparison {
    std::map<std::string, Difference> channels;
    Difference luminance;                ///< photopic, cd/m^2; only when both have R, G, B
    std::vector<std::string> missing;    ///< channels of the reference that the picture does not have
    std::vector<std::string> additional; ///< and the other way round
    bool identical = false;              ///< same channels, same bits
};

/// @throws InputError when the sizes differ
Comparison compare(const Picture& picture, const Picture& reference);

} // namespace lightwell
