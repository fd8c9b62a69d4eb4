#include "importers/layers.h"
#include "importers/surface_amounts.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace lightwell {
namespace {

/// The material behind a modifier after mapping; the proposal before.
std::string material_of(const Imported& imported, ModifierId id)
{
    const Scene& scene = imported.scene;
    const auto index = static_cast<std::size_t>(id);
    const auto* alias = std::get_if<Alias>(&scene.modifiers[index].what);
    if (alias && alias->target != void_modifier) {
        const auto target = static_cast<std::size_t>(alias->target);
        const bool keyed = target < imported.keys.size() && !imported.keys[target].material.empty();
        return keyed ? imported.keys[target].material : scene.modifiers[target].name;
    }
    if (std::holds_alternative<Material>(scene.modifiers[index].what))
        return scene.modifiers[index].name;
    return index < imported.keys.size() ? propose_material(imported.keys[index]) : std::string();
}

/// What the file says of its materials, by their names.
std::map<std::string, std::string> file_materials_in_short(const Imported& imported)
{
    std::map<std::string, std::string> texts;
    for (const auto& [name, material] : imported.file_materials)
        texts.try_emplace(name, name + " (" + material_in_short(material) + ')');
    return texts;
}

/// A list with commas, each entry once.
void append_once(std::string& list, const std::string& entry)
{
    if (list.empty())
        list = entry;
    else if (!entry.empty() && (", " + list + ",").find(", " + entry + ",") == std::string::npos)
        list += ", " + entry;
}

} // namespace

std::string material_in_short(const Material& material)
{
    const std::string type = type_name(material);
    if (is_emitter(material))
        return fmt::format("{}, {:.4g} cd/m2", type, lumens_per_watt * photopic(emitted_radiance(material)));
    if (const auto* glass = std::get_if<Glass>(&material))
        return fmt::format("{}, {:.0f} %", type, 100 * photopic(glass->transmissivity));
    return fmt::format("{}, {:.0f} %", type, 100 * photopic(typical_reflectance(material)));
}

std::vector<LayerSummary> summarize_layers(const Imported& imported)
{
    const std::map<std::string, std::string> of_file = file_materials_in_short(imported);
    const auto amounts = surface_amounts(imported.scene);
    std::vector<ModifierId> order;
    for (const auto& entry : amounts)
        order.push_back(entry.first);
    std::sort(order.begin(), order.end());
    std::map<std::string, LayerSummary> layers;
    for (const ModifierId id : order) {
        const Amount& amount = amounts.at(id);
        const bool known = id != void_modifier;
        const std::string name = !known ? std::string("void")
                                 : static_cast<std::size_t>(id) < imported.keys.size()
                                     ? imported.keys[static_cast<std::size_t>(id)].layer
                                     : imported.scene.modifiers[static_cast<std::size_t>(id)].name;
        LayerSummary& layer = layers[name];
        layer.name = name;
        layer.surfaces += static_cast<std::size_t>(amount.surfaces);
        layer.area_m2 += amount.area_m2;
        const std::string material = known ? material_of(imported, id) : std::string("void");
        append_once(layer.material, material);
        if (known && static_cast<std::size_t>(id) < imported.keys.size()) {
            const auto entry = of_file.find(imported.keys[static_cast<std::size_t>(id)].material);
            append_once(layer.file_material, entry == of_file.end() ? std::string() : entry->second);
        }
    }
    std::vector<LayerSummary> result;
    for (auto& [name, layer] : layers)
        result.push_back(std::move(layer));
    return result;
}

} // namespace lightwell
