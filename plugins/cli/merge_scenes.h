#pragma once

#include "importers/importer.h"

namespace lightwell {

/// Puts the surfaces, prototypes, modifiers, views and grids of `from` behind those of `to`; both keep their meaning.
void append_scene(Scene& to, const Scene& from);
/// The same for files before materials are chosen, so that one layer map serves several drawings.
/// Of materials of the same name that the files describe, the first is kept.
void append_import(Imported& to, const Imported& from);

} // namespace lightwell
