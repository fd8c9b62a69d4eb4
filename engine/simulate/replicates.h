#pragma once

namespace lightwell {

/// Independently scrambled runs behind each value: their spread gives the standard error, since samples within one
/// low-discrepancy run are not independent.
inline constexpr int replicates = 8;

/// Samples that bring a median relative error found with `pilot` samples down to `wanted`, a multiple of the
/// replicates within [replicates, most].
int samples_for(double found, int pilot, double wanted, int most) noexcept;

} // namespace lightwell
