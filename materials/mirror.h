#pragma once

#include "engine/base/vector.h"

namespace lightwell {

/// The direction that a smooth surface reflects into. Frame  local, z = normal
constexpr Direction mirrored(const Direction& to_viewer) noexcept
{
    return {-to_viewer.x, -to_viewer.y, to_viewer.z};
}

} // namespace lightwell
