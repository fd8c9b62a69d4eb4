#pragma once

#include "importers/choose_materials.h"
#include "importers/layers.h"

#include <string>
#include <vector>

namespace lightwell {

/// Where a rule of the map puts a measured luminaire.
struct PlacedLuminaire {
    int rule = -1;        ///< of the map
    Affine frame;         ///< from the luminaire's frame into the scene: a rotation, mirrored where the insert is
    Vec3 body{};          ///< half the extent of the body about the frame's origin; 0: none
    bool shining = false; ///< some of the body is made of an emitter: that is what eyes see
    std::string name;     ///< of the insert or surface
};

/// One for each insert of a block that a rule with `block` fits, or whose layer the insert decides, drawn or not; else
/// for each group of touching surfaces that it fits.
///
/// The frame of an insert is the block's: light towards its -z, plane 0 along its x axis, at the middle of the body; at
/// the insertion point when the block draws no surface. For groups of surfaces: light downwards, or out of the one
/// polygon that it is; the longer side of the opening along the longer side of the group. `aim` and `turn` of the rule
/// change that, in the frame of the insert.
std::vector<PlacedLuminaire> find_luminaires(const Imported& imported, const LayerMap& map,
                                             const std::vector<Choice>& choices);

/// Adds them, with modifiers and keys of their own.
/// @throws InputError with the map's file and line for a luminaire's file that cannot be read
void add_luminaires(Imported& imported, const LayerMap& map, const std::vector<PlacedLuminaire>& placed);

} // namespace lightwell
