#pragma once

#include "importers/importer.h"
#include "importers/layers.h"

#include <iosfwd>
#include <string>
#include <vector>

namespace lightwell {

/// The layers of an import as aligned columns, with the balance of entities below.
void print_layer_table(const Imported& imported, const std::vector<LayerSummary>& layers, bool assigned,
                       std::ostream& out);
/// The same for programs: file, unit, bounds_m, entities, layers, notes.
/// @param assigned  the materials come from a layer map; else they are proposals
void print_layer_json(const std::string& file, const Imported& imported, const std::vector<LayerSummary>& layers,
                      bool assigned, std::ostream& out);

} // namespace lightwell
