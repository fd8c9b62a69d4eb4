#pragma once

#include "engine/base/spectrum.h"
#include "engine/base/vector.h"

namespace lightwell {

/// The colour of CIE X, Y and Z, of which (1, 1, 1) is equal-energy white. Channels are below 0 for what the primaries
/// cannot mix.
Spectrum colour_of_xyz(const Vec3& xyz) noexcept;

} // namespace lightwell
