#pragma once

#include "engine/base/transform.h"

namespace lightwell {

/// What a pattern may ask about the place where a ray meets a surface or a distant source.
/// Frame  world
struct PatternPlace {
    Point position{};
    Direction direction{0, 0, -1};   ///< of the ray: towards the surface
    Direction normal{0, 0, 1};       ///< front side, as the shape has it
    double distance_m = 0;           ///< length of the ray
    const Affine* to_part = nullptr; ///< into the frame of the part that is instanced; null: the world's
    UnitSquare texture{};            ///< coordinates on a mesh
    Vec3 along_u{}, along_v{};       ///< change of the position with each of them; 0 where there are none
    bool distant = false;            ///< on a distant source: no position
    Direction to_light{0, 0, 0};     ///< of functions over the direction of the light; 0: they are not asked
};

} // namespace lightwell
