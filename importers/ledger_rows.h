#pragma once

#include "importers/importer.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace lightwell {

/// What became of the entities of one type on one layer. Entities are counted on the layer they are drawn on, surfaces
/// on the layer they appear on: what a block draws on layer 0 is read there and seen on the layer of each insert.
struct LedgerRow {
    std::string layer, type;
    std::size_t read = 0, made = 0;                       ///< read = made + skipped
    std::map<std::string, std::size_t> skipped, repaired; ///< by reason; by what was done
    std::size_t surfaces = 0;                             ///< instances expanded
    double area_m2 = 0;
    Box bounds; ///< in metres; empty where there is no surface
};

/// By layer, then by type. To be called before a layer map is applied: the map forgets the types.
std::vector<LedgerRow> ledger_rows(const Imported& imported);
/// Takes over what a layer map has moved to the skipped side since.
void update_counts(std::vector<LedgerRow>& rows, const Ledger& ledger);

} // namespace lightwell
