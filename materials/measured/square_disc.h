#pragma once

#include "engine/sampling/warps.h"

namespace lightwell {

/// Area-preserving map between the unit disc and the unit square, with (0.5, 0.5) for the centre and the right edge for
/// azimuth 0: the one in which trees of scattering data are laid out.
/// Source  Shirley, Chiu 1997
UnitSquare square_of(const DiscPoint& p) noexcept;
DiscPoint disc_of(const UnitSquare& s) noexcept;

} // namespace lightwell
