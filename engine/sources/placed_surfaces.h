#pragma once

#include "engine/scene/scene.h"

#include <functional>

namespace lightwell {

/// A surface in the place where it stands: instances and their bindings resolved.
struct PlacedSurface {
    const Part& part;
    const Surface& surface;
    std::uint32_t index; ///< of the surface in its part
    Affine to_world;
    std::uint64_t path; ///< hash of the instances passed, as in Hit
    ModifierId modifier;
    const Material& material;
};

/// Calls visit for each surface whose material is wanted, until it returns false. Prototypes that can hold none are
/// not entered, so that a forest without mirrors costs nothing.
void visit_placed(const Scene& scene, const std::function<bool(const Material&)>& wanted,
                  const std::function<bool(const PlacedSurface&)>& visit);

/// One number for a surface in its place, for tables.
std::uint64_t place_key(std::uint64_t path, std::uint32_t surface) noexcept;

} // namespace lightwell
