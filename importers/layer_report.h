#pragma once

#include "importers/layers.h"
#include "importers/ledger_rows.h"

#include <filesystem>
#include <string>

namespace lightwell {

/// One object for programs: `file`, `unit`, `bounds_m` ([[x,y,z],[x,y,z]], null when there is nothing), `layers` (name,
/// surfaces, area_m2, material: assigned, or proposed before mapping) and `entities` (read, made, skipped by type,
/// layer and reason).
std::string layers_json(const Imported& imported, const std::filesystem::path& file);
/// The same as a table for people: layers, then what was skipped.
std::string layers_table(const Imported& imported);

/// One object for programs: `file`, `unit`, `bounds_m`, `ledger` (a row for each layer and type: read, made, skipped by
/// reason, repaired by what was done, surfaces, area_m2, bounds_m), `totals`, `rules` (line, rule, surfaces, area_m2)
/// and `notes` (finding, place, text, count; questions are among them).
/// @param rows   of ledger_rows(), with the counts after mapping
/// @param rules  what apply_layer_map() returned; empty before mapping
std::string report_json(const Imported& imported, const std::filesystem::path& file, const std::vector<LedgerRow>& rows,
                        const std::vector<RuleHits>& rules);
/// The same as tables for people, questions last.
std::string report_table(const Imported& imported, const std::vector<LedgerRow>& rows,
                         const std::vector<RuleHits>& rules);

} // namespace lightwell
