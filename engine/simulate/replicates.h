#pragma once

#include "engine/sampling/replicates.h"

namespace lightwell {

/// Samples that bring a median relative error found with `pilot` samples down to `wanted`, a multiple of the
/// replicates within [replicates, most]. Cautious both ways: more samples are taken to help like 1 / sqrt(n).
/// @param order  fewer samples cost like 1 / n^order: 1 for stratified samples of something smooth, 0.5 for noise
int samples_for(double found, int pilot, double wanted, int most, double order) noexcept;

} // namespace lightwell
