#pragma once

#include "engine/scene/scene.h"

#include <cstdint>

namespace lightwell {

/// A fingerprint of everything that light depends on: geometry, materials, instances; not names, views or grids.
/// Two scenes with different fingerprints never continue one another's pictures.
std::uint64_t scene_hash(const Scene& scene) noexcept;

} // namespace lightwell
