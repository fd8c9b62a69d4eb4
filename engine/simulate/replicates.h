#pragma once

#include "engine/sampling/replicates.h"

namespace lightwell {

/// What a pilot run tells of the median relative error.
struct PilotErrors {
    /// The part that more samples would not lower: the replicates' spread where all of them follow the same paths, so
    /// that only their ambient light differs.
    double shared = 0;
    double own = 0; ///< the rest, with these samples
    int samples = 0;
    double order = 0.5; ///< the rest falls like 1 / samples^order: 0.5 for noise, more for stratified samples
};
/// Of the samples, so many follow the same paths in a pilot run.
inline constexpr int same_paths_share = 4;

/// @param found  the error with these samples
PilotErrors pilot_errors(double found, int samples, double shared) noexcept;
/// The same, with the order from a run with fewer samples.
PilotErrors pilot_errors(double found, int samples, double shared, double found_with_fewer, int fewer) noexcept;

/// Samples that bring the error down to `wanted`, or where what they share is nearly as large or larger, to less than
/// half of it besides: a multiple of the replicates within [replicates, most].
int samples_for(const PilotErrors& pilot, double wanted, int most) noexcept;

} // namespace lightwell
