#include "importers/layer_report.h"

#include "importers/layers.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace lightwell {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Point& p)
{
    return Json::array({p.x, p.y, p.z});
}

/// Columns on a screen: one for each code point, two for each East Asian one.
std::size_t columns_of(const std::string& text)
{
    std::size_t columns = 0;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if ((byte & 0xC0) != 0x80)
            columns += byte >= 0xE3 && byte < 0xF0 ? 2 : 1;
    }
    return columns;
}

std::string padded(const std::string& text, std::size_t columns)
{
    const std::size_t used = columns_of(text);
    return text + std::string(used < columns ? columns - used : 0, ' ');
}

/// Before a layer map is applied a scene holds no materials, and the column shows proposals.
const char* material_heading(const Scene& scene)
{
    const bool chosen = std::any_of(scene.modifiers.begin(), scene.modifiers.end(), [](const Modifier& modifier) {
        return std::holds_alternative<Material>(modifier.what);
    });
    return chosen ? "material" : "proposed material";
}

std::string skipped_text(const Ledger& ledger)
{
    std::string text = fmt::format("{} entities read, {} made into surfaces, {} skipped\n", ledger.read_count(),
                                   ledger.made_count(), ledger.read_count() - ledger.made_count());
    for (const Ledger::Skipped& skipped : ledger.skipped_list())
        text += fmt::format("  skipped {} x {} on layer \"{}\": {}\n", skipped.count, skipped.type, skipped.layer,
                            skipped.reason);
    return text;
}

} // namespace

std::string layers_json(const Imported& imported, const std::filesystem::path& file)
{
    Json json;
    json["file"] = file.string();
    json["unit"] = imported.unit;
    const Box box = bounds(imported.scene);
    json["bounds_m"] = box.empty() ? Json(nullptr) : Json::array({to_json(box.low), to_json(box.high)});
    json["layers"] = Json::array();
    for (const LayerSummary& layer : summarize_layers(imported))
        json["layers"].push_back({{"name", layer.name},
                                  {"surfaces", layer.surfaces},
                                  {"area_m2", layer.area_m2},
                                  {"material", layer.material}});
    Json skipped = Json::array();
    for (const Ledger::Skipped& entry : imported.ledger.skipped_list())
        skipped.push_back(
            {{"type", entry.type}, {"layer", entry.layer}, {"reason", entry.reason}, {"count", entry.count}});
    json["entities"] = {{"read", imported.ledger.read_count()},
                        {"made", imported.ledger.made_count()},
                        {"skipped", std::move(skipped)}};
    // A name with broken bytes is shown with replacement characters rather than not at all.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string layers_table(const Imported& imported)
{
    const std::vector<LayerSummary> layers = summarize_layers(imported);
    std::size_t width = columns_of("layer");
    for (const LayerSummary& layer : layers)
        width = std::max(width, columns_of(layer.name));
    std::string text = fmt::format("{}  {:>10}  {:>12}  {}\n", padded("layer", width), "surfaces", "area m2",
                                   material_heading(imported.scene));
    for (const LayerSummary& layer : layers)
        text += fmt::format("{}  {:>10}  {:>12.6g}  {}\n", padded(layer.name, width), layer.surfaces, layer.area_m2,
                            layer.material.empty() ? "-" : layer.material);
    const Box box = bounds(imported.scene);
    if (!box.empty())
        text += fmt::format("unit {}; from ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g}) m\n", imported.unit,
                            box.low.x, box.low.y, box.low.z, box.high.x, box.high.y, box.high.z);
    return text + skipped_text(imported.ledger);
}

} // namespace lightwell
