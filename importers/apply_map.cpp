#include "engine/base/text.h"
#include "importers/choose_materials.h"
#include "importers/double_panes.h"
#include "importers/layer_rules.h"
#include "importers/luminaires.h"
#include "importers/name_modifiers.h"
#include "importers/questions.h"
#include "importers/rebuild_parts.h"
#include "importers/surface_amounts.h"
#include "materials/library.h"

#include <map>

namespace lightwell {
namespace {

constexpr const char* void_reason = "void in the layer map";
constexpr const char* spare_pane_reason = "second sheet of a glazing unit";

/// Materials that stand for all panes of a unit together.
bool is_whole_unit(const Choice& choice)
{
    return choice.kind == Choice::Kind::material && std::holds_alternative<Glass>(*choice.definition) &&
           (choice.name.starts_with("glass_double") || choice.name.starts_with("glass_triple"));
}

/// Of two sheets that draw one unit the second gets a modifier of its own, which is dropped.
void set_spare_panes_apart(Imported& imported, std::vector<Choice>& choices)
{
    Scene& scene = imported.scene;
    std::map<ModifierId, ModifierId> spare_ids;
    const auto set_apart = [&](Part& part) {
        std::map<std::string, std::vector<std::size_t>> sheets; // by material
        for (std::size_t i = 0; i < part.surfaces.size(); ++i)
            if (const ModifierId id = part.surfaces[i].modifier;
                id != void_modifier && is_whole_unit(choices[static_cast<std::size_t>(id)]))
                sheets[choices[static_cast<std::size_t>(id)].name].push_back(i);
        for (const auto& [material, surfaces] : sheets)
            for (const auto& [kept, spare] : double_panes(part, surfaces)) {
                const ModifierId id = part.surfaces[spare].modifier;
                const auto [entry, fresh] = spare_ids.try_emplace(id, void_modifier);
                if (fresh) {
                    entry->second = add_copy(imported, id);
                    choices.push_back({Choice::Kind::dropped, {}, nullptr, EmissionSide::front});
                }
                part.surfaces[spare].modifier = entry->second;
                const std::string& layer = imported.keys[static_cast<std::size_t>(id)].layer;
                imported.report.add(Finding::repaired, "layer \"" + layer + '"',
                                    "layer \"" + layer + "\": two sheets draw one glazing unit; " + material +
                                        " stands for all of its panes, so one of them is left out");
            }
    };
    for (Part& part : scene.prototypes)
        set_apart(part);
    set_apart(scene.root);
}

std::string in_short(const LayerRule& rule)
{
    std::string text;
    const auto add = [&](const std::string& words) { text += (text.empty() ? "" : ", ") + words; };
    for (const RuleWord& word : rule_words)
        if (!(rule.*word.pattern).empty())
            add(std::string(word.name) + " = \"" + rule.*word.pattern + '"');
    const auto end = [](double number) { return std::isfinite(number) ? shortest(number) : std::string(); };
    if (rule.area_m2 != NumberRange{})
        add("area_m2 = \"" + end(rule.area_m2.low) + ".." + end(rule.area_m2.high) + '"');
    if (rule.size_m != NumberRange{})
        add("size_m = \"" + end(rule.size_m.low) + ".." + end(rule.size_m.high) + '"');
    text += " -> " + rule.use;
    if (rule.photometry)
        text += (rule.use.empty() ? "" : ", ") + std::string("luminaire ") + rule.luminaire.filename().string();
    return text;
}

std::vector<RuleHits> count_hits(const Scene& scene, const LayerMap& map, const std::vector<Choice>& choices,
                                 const std::vector<PlacedLuminaire>& luminaires)
{
    std::vector<RuleHits> hits;
    for (const LayerRule& rule : map.rules)
        hits.push_back({rule.line, in_short(rule), 0, 0});
    if (hits.empty())
        return hits;
    for (const PlacedLuminaire& luminaire : luminaires)
        if (const auto rule = static_cast<std::size_t>(luminaire.rule); map.rules[rule].use.empty())
            ++hits[rule].surfaces;
    for (const auto& [id, amount] : surface_amounts(scene)) {
        const int rule = id == void_modifier ? -1 : choices[static_cast<std::size_t>(id)].rule;
        if (rule < 0)
            continue;
        hits[static_cast<std::size_t>(rule)].surfaces += static_cast<std::size_t>(amount.surfaces);
        hits[static_cast<std::size_t>(rule)].area_m2 += amount.area_m2;
    }
    return hits;
}

/// Entities behind a key whose surfaces are all gone, for formats that gather many entities in one mesh.
void unmake_by_key(Imported& imported, const std::vector<Choice>& choices)
{
    for (std::size_t i = 0; i < imported.made_with_key.size(); ++i)
        if (choices[i].kind == Choice::Kind::dropped && imported.made_with_key[i] > 0)
            imported.ledger.unmake(imported.keys[i].entity, imported.keys[i].layer, void_reason,
                                   imported.made_with_key[i]);
}

/// @param first_spare  from this modifier on, surfaces are spare panes
void unmake_dropped(Imported& imported, const std::vector<Choice>& choices, const Rebuilt& rebuilt,
                    std::size_t first_spare)
{
    unmake_by_key(imported, choices);
    for (const DroppedEntity& entity : rebuilt.dropped) {
        const auto key = static_cast<std::size_t>(entity.key), layer = static_cast<std::size_t>(entity.layer);
        if (key >= imported.made_with_key.size())
            imported.ledger.unmake(imported.keys[key].entity, imported.keys[layer].layer,
                                   layer < first_spare ? void_reason : spare_pane_reason, 1, imported.keys[key].layer);
    }
    if (rebuilt.dropped_instances > 0)
        imported.report.add(Finding::ignored, "layer map",
                            "nothing is left of an instance: all its surfaces are void in the layer map",
                            rebuilt.dropped_instances);
}

void note_shared(Imported& imported, const std::vector<Choice>& choices, const std::vector<std::size_t>& surfaces)
{
    std::map<std::pair<std::string, std::string>, std::size_t> counts;
    for (std::size_t i = 0; i < surfaces.size(); ++i)
        if (surfaces[i] > 0)
            counts[{imported.keys[i].layer, choices[i].name}] += surfaces[i];
    for (const auto& [entry, count] : counts)
        imported.report.add(Finding::assumed, "layer \"" + entry.first + '"',
                            "layer \"" + entry.first + "\": open surfaces of " + entry.second +
                                " send half of their light to each side; side = \"front\" or \"back\" in the map "
                                "gives all of it to one",
                            count);
}

void note_sides_without_light(Imported& imported, const LayerMap& map)
{
    for (const LayerRule& rule : map.rules) {
        const LibraryMaterial* material = find_in_library(rule.use);
        if (rule.side != EmissionSide::both && material && !is_emitter(material->material))
            imported.report.add(Finding::unused, map.file.string() + ':' + std::to_string(rule.line),
                                "side has no effect on " + rule.use + ", which does not emit");
    }
}

} // namespace

std::vector<RuleHits> apply_layer_map(Imported& imported, const LayerMap& map)
{
    std::vector<Choice> choices = choose_materials(imported, map);
    imported.report.add(map.report);
    const std::vector<PlacedLuminaire> luminaires = find_luminaires(imported, map, choices);
    std::vector<RuleHits> hits = count_hits(imported.scene, map, choices, luminaires);
    const std::size_t first_spare = choices.size();
    set_spare_panes_apart(imported, choices);
    const Rebuilt rebuilt = rebuild_parts(imported.scene, choices);
    unmake_dropped(imported, choices, rebuilt, first_spare);
    note_shared(imported, choices, rebuilt.shared_surfaces);
    note_sides_without_light(imported, map);
    name_modifiers(imported, choices);
    add_luminaires(imported, map, luminaires);
    ask_about_lamps(imported);
    return hits;
}

} // namespace lightwell
