#pragma once

#include "importers/choose_materials.h"

namespace lightwell {

/// Replaces the modifiers of an import by what the choices say: first the materials in use, each once, then one alias
/// for each layer, named by it, or `layer/material` for each of its materials when it has several. Surfaces, bindings
/// and `keys` follow; place-holders stay.
/// @param choices  by modifier; ids beyond their number in the parts ask for half the radiance (rebuild_parts.h)
void name_modifiers(Imported& imported, const std::vector<Choice>& choices);

} // namespace lightwell
