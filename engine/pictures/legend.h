#pragma once

#include "engine/pictures/false_colour.h"

namespace lightwell {

/// Which values the two ends of the colours stand for.
struct Scale {
    double low = 0, high = 1;
    bool logarithmic = false;
    bool has_less = false, has_more = false, has_none = false; ///< some value lies below, above, or is not a number

    /// 0 at `low`, 1 at `high`, beyond for what lies outside.
    double place(double value) const noexcept;
};

/// The ends that the options name; where they leave the choice, a round number above the 99th percentile, and for a
/// logarithmic scale from 0 three decades.
/// @throws InputError: ends not finite or not in order, logarithm of a negative end
Scale choose_scale(const std::vector<float>& values, const FalseColour& options);

/// At most `most` round numbers from low to high: 1, 2, 2.5 or 5 times a power of ten apart; on a logarithmic scale
/// 1, 2, 5 of each decade, or whole decades.
std::vector<double> legend_numbers(const Scale& scale, int most);

/// A number as people write it: 0.05, 750, 12000, 2e9.
std::string number_text(double value);

} // namespace lightwell
