#pragma once

#include "importers/dxf/shapes.h"
#include "importers/importer.h"

#include <map>

namespace lightwell::dxf {

/// The outcome of an entity that has become surfaces.
inline constexpr SkipReason made{"made"};

/// What was done to entities so that they could become surfaces, by their index.
using Repairs = std::map<std::size_t, const char*>;

/// Writes what became of the entities into ledger and report: made, repaired and skipped ones, solids that cannot be
/// read layer by layer, texts of inserts, layers that are not plotted.
/// @param outcomes  for each entity; nullptr: not part of the model
void account(const Drawing& drawing, const std::vector<Reason>& outcomes, const Repairs& repairs, Imported& imported);

} // namespace lightwell::dxf
