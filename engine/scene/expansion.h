#pragma once

#include "engine/scene/scene.h"

namespace lightwell {

/// What an inherited modifier stands for under one instance's bindings; any other modifier is itself.
ModifierId bound_modifier(const Scene& scene, ModifierId modifier, const std::vector<Binding>& bindings);

/// Bounds of each prototype in its own frame.
std::vector<Box> prototype_bounds(const Scene& scene);
/// Bounds of a part whose instances refer to prototypes with these bounds.
Box part_bounds(const Part& part, const std::vector<Box>& prototypes);

} // namespace lightwell
