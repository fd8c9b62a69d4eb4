#pragma once

#include <algorithm>
#include <cstddef>

namespace lightwell {

/// One entry picked in proportion to its weight.
struct WeightedChoice {
    std::size_t index = 0;
    double share = 0; ///< of the total; 0: there was nothing to pick
    double left = 0;  ///< [0, 1), what is left of the random number: uniform again
};

/// @param summed  running sums of `count` > 0 weights
/// @param u       [0, 1)
inline WeightedChoice choose(const double* summed, std::size_t count, double u) noexcept
{
    const double total = summed[count - 1], wanted = u * total;
    const auto at = static_cast<std::size_t>(std::upper_bound(summed, summed + count - 1, wanted) - summed);
    const double before = at == 0 ? 0 : summed[at - 1], part = summed[at] - before;
    if (!(part > 0))
        return {at, 0, 0};
    return {at, part / total, std::clamp((wanted - before) / part, 0.0, 0x1.fffffffffffffp-1)};
}

} // namespace lightwell
