#include "importers/layer_report.h"

#include "importers/layers.h"
#include "importers/screen_columns.h"

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
    for (const LayerSummary& layer : summarize_layers(imported)) {
        json["layers"].push_back({{"name", layer.name},
                                  {"surfaces", layer.surfaces},
                                  {"area_m2", layer.area_m2},
                                  {"material", layer.material}});
        if (!layer.file_material.empty())
            json["layers"].back()["file_material"] = layer.file_material;
    }
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
    std::size_t width = columns_of("layer"), material_width = columns_of(material_heading(imported.scene));
    bool any_of_file = false;
    for (const LayerSummary& layer : layers) {
        width = std::max(width, columns_of(layer.name));
        material_width = std::max(material_width, columns_of(layer.material));
        any_of_file = any_of_file || !layer.file_material.empty();
    }
    const auto last_columns = [&](const std::string& material, const std::string& of_file) {
        return any_of_file ? padded(material, material_width) + "  " + of_file : material;
    };
    std::string text = fmt::format("{}  {:>10}  {:>12}  {}\n", padded("layer", width), "surfaces", "area m2",
                                   last_columns(material_heading(imported.scene), "material of the file"));
    for (const LayerSummary& layer : layers)
        text += fmt::format("{}  {:>10}  {:>12.6g}  {}\n", padded(layer.name, width), layer.surfaces, layer.area_m2,
                            last_columns(layer.material.empty() ? "-" : layer.material,
                                         layer.file_material.empty() ? "-" : layer.file_material));
    const Box box = bounds(imported.scene);
    if (!box.empty())
        text += fmt::format("unit {}; from ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g}) m\n", imported.unit,
                            box.low.x, box.low.y, box.low.z, box.high.x, box.high.y, box.high.z);
    return text + skipped_text(imported.ledger);
}

} // namespace lightwell
