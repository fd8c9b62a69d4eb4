#pragma once

#include "importers/layers.h"

#include <string>
#include <vector>

namespace lightwell {

/// What a layer map decides for one modifier of an import.
struct Choice {
    enum class Kind {
        material,  ///< surfaces get `definition`
        dropped,   ///< surfaces are left out
        inherited, ///< a place-holder that stays one
        settled    ///< no key of the import: an entry that is complete already
    } kind = Kind::material;
    std::string name;                        ///< of the material in the scene
    const Material* definition = nullptr;    ///< of the library or of Imported::file_materials
    EmissionSide side = EmissionSide::front; ///< for emitters
    int rule = -1;                           ///< of the map, which decided; -1: none
    int luminaire = -1;                      ///< the last rule with a measured luminaire that fits; -1: none
    std::string file_material = {};          ///< its name in Imported::file_materials; empty: of the library
    /// An emitter that is part of a luminaire: eyes see it, the luminaire's distribution gives its light.
    bool seen_only() const { return kind == Kind::material && luminaire >= 0 && is_emitter(*definition); }
};

/// Modifiers beyond the keys are complete already; afterwards each has a key with its name as layer.
void give_each_modifier_a_key(Imported& imported);

/// A modifier with its key once more, for surfaces that are to be told apart.
ModifierId add_copy(Imported& imported, ModifierId of);

/// One choice for each modifier of the scene. Notes what has no rule and what had no effect.
/// @throws InputError for an unknown material or a rule that matches nothing
std::vector<Choice> choose_materials(Imported& imported, const LayerMap& map);

} // namespace lightwell
