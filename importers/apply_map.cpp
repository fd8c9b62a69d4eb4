#include "importers/choose_materials.h"
#include "importers/name_modifiers.h"
#include "importers/rebuild_parts.h"
#include "materials/library.h"

#include <map>

namespace lightwell {
namespace {

constexpr const char* void_reason = "void in the layer map";

/// Entities behind a key whose surfaces are all gone, for formats that gather many entities in one mesh.
void unmake_by_key(Imported& imported, const std::vector<Choice>& choices)
{
    for (std::size_t i = 0; i < imported.made_with_key.size(); ++i)
        if (choices[i].kind == Choice::Kind::dropped && imported.made_with_key[i] > 0)
            imported.ledger.unmake(imported.keys[i].entity, imported.keys[i].layer, void_reason,
                                   imported.made_with_key[i]);
}

void unmake_dropped(Imported& imported, const std::vector<Choice>& choices, const Rebuilt& rebuilt)
{
    unmake_by_key(imported, choices);
    for (const DroppedEntity& entity : rebuilt.dropped) {
        const auto key = static_cast<std::size_t>(entity.key);
        if (key >= imported.made_with_key.size())
            imported.ledger.unmake(imported.keys[key].entity,
                                   imported.keys[static_cast<std::size_t>(entity.layer)].layer, void_reason);
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

void apply_layer_map(Imported& imported, const LayerMap& map)
{
    const std::vector<Choice> choices = choose_materials(imported, map);
    const Rebuilt rebuilt = rebuild_parts(imported.scene, choices);
    unmake_dropped(imported, choices, rebuilt);
    note_shared(imported, choices, rebuilt.shared_surfaces);
    note_sides_without_light(imported, map);
    name_modifiers(imported, choices);
}

} // namespace lightwell
