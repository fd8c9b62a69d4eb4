#pragma once

#include "importers/dxf/shapes.h"
#include "importers/importer.h"

namespace lightwell::dxf {

/// The outcome of an entity that has become surfaces.
inline constexpr SkipReason made{"made"};

/// Writes what became of the entities into ledger and report: made and skipped ones, solids that cannot be read layer
/// by layer, texts of inserts, layers that are not plotted.
/// @param outcomes  for each entity; nullptr: not part of the model
void account(const Drawing& drawing, const std::vector<Reason>& outcomes, Imported& imported);

} // namespace lightwell::dxf
