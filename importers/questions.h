#pragma once

#include "importers/importer.h"

namespace lightwell {

/// Asks about sizes that physics and building make hard to believe: models of 40 km or 4 mm, doors 2 mm high, floors
/// that stand upright. Nothing is changed; each doubt is a note of the kind Finding::question with a proposal.
/// @param file  for the place of the notes
void ask_about_sizes(Imported& imported, const std::string& file);

/// Asks about lamps that are hard to believe: more flux than any lamp, more luminance than the sun. For scenes whose
/// materials are chosen.
void ask_about_lamps(Imported& imported);

} // namespace lightwell
