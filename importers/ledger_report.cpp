#include "importers/layer_report.h"
#include "importers/screen_columns.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace lightwell {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Box& box)
{
    if (box.empty())
        return nullptr;
    return Json::array({{box.low.x, box.low.y, box.low.z}, {box.high.x, box.high.y, box.high.z}});
}

Json to_json(const std::map<std::string, std::size_t>& counts, const char* what)
{
    Json list = Json::array();
    for (const auto& [text, count] : counts)
        list.push_back({{what, text}, {"count", count}});
    return list;
}

Json to_json(const LedgerRow& row)
{
    return {{"layer", row.layer},
            {"type", row.type},
            {"read", row.read},
            {"made", row.made},
            {"skipped", to_json(row.skipped, "reason")},
            {"repaired", to_json(row.repaired, "what")},
            {"surfaces", row.surfaces},
            {"area_m2", row.area_m2},
            {"bounds_m", to_json(row.bounds)}};
}

std::size_t sum(const std::map<std::string, std::size_t>& counts)
{
    std::size_t total = 0;
    for (const auto& entry : counts)
        total += entry.second;
    return total;
}

std::string size_text(const Box& box)
{
    if (box.empty())
        return "-";
    const Vec3 size = box.high - box.low;
    return fmt::format("{:.4g} x {:.4g} x {:.4g}", size.x, size.y, size.z);
}

std::string rows_text(const std::vector<LedgerRow>& rows)
{
    std::size_t layer_width = columns_of("layer"), type_width = columns_of("type");
    for (const LedgerRow& row : rows) {
        layer_width = std::max(layer_width, columns_of(row.layer));
        type_width = std::max(type_width, columns_of(row.type));
    }
    std::string text =
        fmt::format("{}  {}  {:>8} {:>8} {:>8} {:>8}  {:>9}  {:>12}  size m\n", padded("layer", layer_width),
                    padded("type", type_width), "read", "made", "skipped", "repaired", "surfaces", "area m2");
    for (const LedgerRow& row : rows) {
        text += fmt::format("{}  {}  {:>8} {:>8} {:>8} {:>8}  {:>9}  {:>12.6g}  {}\n", padded(row.layer, layer_width),
                            padded(row.type, type_width), row.read, row.made, row.read - row.made, sum(row.repaired),
                            row.surfaces, row.area_m2, size_text(row.bounds));
        for (const auto& [reason, count] : row.skipped)
            text += fmt::format("    skipped {}: {}\n", count, reason);
        for (const auto& [what, count] : row.repaired)
            text += fmt::format("    repaired {}: {}\n", count, what);
    }
    return text;
}

} // namespace

std::string report_json(const Imported& imported, const std::filesystem::path& file, const std::vector<LedgerRow>& rows,
                        const std::vector<RuleHits>& rules)
{
    Json json{{"file", file.string()}, {"unit", imported.unit}, {"bounds_m", to_json(bounds(imported.scene))}};
    json["ledger"] = Json::array();
    for (const LedgerRow& row : rows)
        json["ledger"].push_back(to_json(row));
    json["totals"] = {{"read", imported.ledger.read_count()},
                      {"made", imported.ledger.made_count()},
                      {"skipped", imported.ledger.read_count() - imported.ledger.made_count()}};
    json["rules"] = Json::array();
    for (const RuleHits& rule : rules)
        json["rules"].push_back(
            {{"line", rule.line}, {"rule", rule.text}, {"surfaces", rule.surfaces}, {"area_m2", rule.area_m2}});
    json["notes"] = Json::array();
    for (const Note& note : imported.report.notes())
        json["notes"].push_back(
            {{"finding", to_string(note.finding)}, {"place", note.place}, {"text", note.text}, {"count", note.count}});
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string report_table(const Imported& imported, const std::vector<LedgerRow>& rows,
                         const std::vector<RuleHits>& rules)
{
    std::string text = rows_text(rows);
    text += fmt::format("{} entities read = {} made into surfaces + {} skipped; unit {}\n",
                        imported.ledger.read_count(), imported.ledger.made_count(),
                        imported.ledger.read_count() - imported.ledger.made_count(), imported.unit);
    for (const RuleHits& rule : rules)
        text += fmt::format("rule in line {}: {} surfaces, {:.6g} m2: {}\n", rule.line, rule.surfaces, rule.area_m2,
                            rule.text);
    for (const Note& note : imported.report.notes())
        if (note.finding == Finding::question)
            text += "question: " + note.text + '\n';
    return text;
}

} // namespace lightwell
