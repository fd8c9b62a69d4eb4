#pragma once

#include "engine/scene/scene.h"

namespace lightwell {

/// Whether a pattern multiplies what this modifier modifies. The chain of modifiers may be broken or run in a circle.
bool has_pattern(const Scene& scene, ModifierId modifier) noexcept;

} // namespace lightwell
