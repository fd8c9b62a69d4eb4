#pragma once

namespace lightwell {

/// Independently scrambled runs behind each value: their spread gives the standard error, since samples within one
/// low-discrepancy run are not independent.
inline constexpr int replicates = 8;

} // namespace lightwell
