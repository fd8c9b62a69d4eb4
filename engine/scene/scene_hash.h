#pragma once

#include "engine/scene/scene.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace lightwell {

/// What light depends on, in parts that can be named when one of them has changed. Unused modifiers, views and grids
/// do not count.
struct SceneFingerprint {
    std::uint64_t geometry = 0;   ///< shapes, coordinates, instances
    std::uint64_t assignment = 0; ///< which surface has which modifier
    /// Each modifier in use, in the order of first use: `material "wall"`, `source "sun"`, `pattern "sky"`,
    /// `name "A-FLOR"` (an alias), and the numbers it holds.
    std::vector<std::pair<std::string, std::uint64_t>> modifiers;
};

/// @param scene  one that validate() has accepted
SceneFingerprint scene_fingerprint(const Scene& scene);

/// All of it as one number, names left out. Two scenes with different hashes never continue one another's pictures.
std::uint64_t scene_hash(const Scene& scene);

} // namespace lightwell
