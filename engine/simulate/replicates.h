#pragma once

#include "engine/sampling/replicates.h"

namespace lightwell {

/// Median relative errors of a pilot run.
struct PilotErrors {
    double found = 0;
    int samples = 0;
    /// The part that more samples would not lower: the replicates' spread where all of them follow the same paths, so
    /// that only their ambient light differs.
    double shared = 0;
    double order = 0.5; ///< the rest falls like 1 / samples^order: 0.5 for noise, more for stratified samples
};
/// Order from the errors with some samples and with so many times fewer.
double order_of(double found, double found_with_fewer, double shared, double times_fewer) noexcept;
/// Of the samples, so many follow the same paths in a pilot run.
inline constexpr int same_paths_share = 4;

/// Samples that bring the error down to `wanted`, or where what they share is nearly as large or larger, to less than
/// half of it besides: a multiple of the replicates within [replicates, most].
int samples_for(const PilotErrors& pilot, double wanted, int most) noexcept;

} // namespace lightwell
