#pragma once

#include "engine/sampling/replicates.h"

namespace lightwell {

/// Samples that bring a median relative error found with `pilot` samples down to `wanted`, a multiple of the
/// replicates within [replicates, most].
int samples_for(double found, int pilot, double wanted, int most) noexcept;

} // namespace lightwell
