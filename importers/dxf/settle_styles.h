#pragma once

#include "engine/scene/scene.h"

namespace lightwell::dxf {

/// Where all copies of a block put the same modifiers in the places that it leaves open, they are written into the
/// block itself: then a copy takes no more memory than its place.
void settle_common_styles(Scene& scene);

} // namespace lightwell::dxf
