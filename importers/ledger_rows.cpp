#include "importers/ledger_rows.h"

#include "importers/surface_amounts.h"

namespace lightwell {
namespace {

/// Rows by layer and type.
using Table = std::map<std::pair<std::string, std::string>, LedgerRow>;

void add_counts(Table& table, const Ledger& ledger)
{
    for (const Ledger::Made& entry : ledger.made_list()) {
        LedgerRow& row = table[{entry.layer, entry.type}];
        row.made += entry.count;
        row.read += entry.count;
    }
    for (const Ledger::Skipped& entry : ledger.skipped_list()) {
        LedgerRow& row = table[{entry.layer, entry.type}];
        row.skipped[entry.reason] += entry.count;
        row.read += entry.count;
    }
    for (const Ledger::Repaired& entry : ledger.repaired_list())
        table[{entry.layer, entry.type}].repaired[entry.what] += entry.count;
}

void add_geometry(Table& table, const Imported& imported)
{
    const auto boxes = surface_boxes(imported.scene);
    for (const auto& [id, amount] : surface_amounts(imported.scene)) {
        const auto index = static_cast<std::size_t>(id);
        if (id == void_modifier || index >= imported.keys.size())
            continue;
        const SurfaceKey& key = imported.keys[index];
        LedgerRow& row = table[{key.layer, key.entity}];
        row.surfaces += static_cast<std::size_t>(amount.surfaces);
        row.area_m2 += amount.area_m2;
        if (const auto box = boxes.find(id); box != boxes.end())
            row.bounds.extend(box->second);
    }
}

std::vector<LedgerRow> listed(Table table)
{
    std::vector<LedgerRow> rows;
    for (auto& [place, row] : table) {
        row.layer = place.first;
        row.type = place.second;
        rows.push_back(std::move(row));
    }
    return rows;
}

} // namespace

std::vector<LedgerRow> ledger_rows(const Imported& imported)
{
    Table table;
    add_counts(table, imported.ledger);
    add_geometry(table, imported);
    return listed(std::move(table));
}

void update_counts(std::vector<LedgerRow>& rows, const Ledger& ledger)
{
    Table table;
    for (LedgerRow& row : rows) {
        row.read = row.made = 0;
        row.skipped.clear();
        row.repaired.clear();
        table[{row.layer, row.type}] = std::move(row);
    }
    add_counts(table, ledger);
    rows = listed(std::move(table));
}

} // namespace lightwell
