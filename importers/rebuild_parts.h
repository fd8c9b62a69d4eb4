#pragma once

#include "importers/choose_materials.h"
#include "importers/importer.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace lightwell {

/// An entity of the file whose surfaces were all dropped.
struct DroppedEntity {
    ModifierId key;   ///< what kind of entity it was
    ModifierId layer; ///< the modifier that decided: another one than `key` where an instance gave it
};

/// What rebuild_parts() did.
struct Rebuilt {
    std::vector<DroppedEntity> dropped;
    std::size_t dropped_instances = 0;        ///< instances in which nothing was left
    std::vector<std::size_t> shared_surfaces; ///< by modifier: open emitters that now send light to both sides
};

/// Carries out what the choices say about geometry: leaves out dropped surfaces, turns or doubles emitters. Prototypes
/// whose place-holders stand for such a modifier in some instances get a variant for those.
///
/// Afterwards a modifier id m >= modifiers.size() in the parts means "m - modifiers.size(), with half the radiance".
/// Without dropped layers and emitters nothing is touched.
Rebuilt rebuild_parts(Scene& scene, const std::vector<Choice>& choices);

} // namespace lightwell
