#pragma once

namespace lightwell {

/// Weights for a sample that one technique drew and another could have drawn: over all techniques they sum to 1.
/// @param own    density of the technique that drew it (times its number of samples)
/// @param other  density of the other one (times its number of samples), in the same measure
/// @return       0 where own is 0
/// Source  Veach 1997, Eqs. (9.8) and (9.11)
constexpr double balance_weight(double own, double other) noexcept
{
    return own > 0 ? 1 / (1 + other / own) : 0;
}
/// Exponent 2: lower variance where one technique fits well.
constexpr double power_weight(double own, double other) noexcept
{
    if (!(own > 0))
        return 0;
    const double ratio = other / own; // a ratio, so that densities of narrow lobes do not overflow when squared
    return 1 / (1 + ratio * ratio);
}

} // namespace lightwell
