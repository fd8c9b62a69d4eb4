#pragma once

#include "engine/sampling/replicates.h"

namespace lightwell {

/// Samples that bring a median relative error found with `pilot` samples down to `wanted`, a multiple of the
/// replicates within [replicates, most]. Cautious both ways: more samples help like 1 / sqrt(n), fewer cost like 1 / n.
int samples_for(double found, int pilot, double wanted, int most) noexcept;

} // namespace lightwell
