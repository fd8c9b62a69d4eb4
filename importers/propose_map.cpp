#include "engine/base/toml.h"
#include "importers/double_panes.h"
#include "importers/layer_rules.h"
#include "importers/layers.h"
#include "materials/library.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace lightwell {
namespace {

/// A text as a pattern that matches itself only (but for the case of letters).
std::string exactly(const std::string& text)
{
    std::string pattern;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool range = text[i] == '.' && i + 1 < text.size() && text[i + 1] == '.';
        if (text[i] == '*' || text[i] == '?' || text[i] == '[' || range)
            pattern += {'[', text[i], ']'};
        else
            pattern += text[i];
    }
    return pattern;
}

/// The proposal for glass of which nothing else is known.
constexpr const char* plain_glass = "glass_single_clear";

/// What the map says for one key: a name of the library or `file:NAME`, and why.
struct Use {
    std::string material, reason;
    bool operator==(const Use& other) const { return material == other.material; }
};

class Proposer {
public:
    explicit Proposer(const Imported& imported)
    {
        for (const auto& [name, material] : imported.file_materials)
            of_file_.try_emplace(name, &material);
    }
    /// @param pairs  of parallel sheets among the surfaces of the key
    Use use_for(const SurfaceKey& key, std::size_t pairs) const
    {
        const auto own = of_file_.find(key.material);
        const bool described = own != of_file_.end();
        const std::string of_file = described ? "file:" + key.material + " is " + material_in_short(*own->second) : "";
        if (described && is_emitter(*own->second))
            return {"file:" + key.material, "emitter described by the file: " + material_in_short(*own->second)};
        std::string name = propose_material(key);
        if (name == plain_glass && pairs > 0)
            return {"glass_double_clear", fmt::format("{} pairs of parallel sheets: double panes", pairs)};
        if (!name.empty())
            return {name, find_in_library(name)->description + (described ? "; " + of_file : "")};
        if (described)
            return {"file:" + key.material, "described by the file: " + material_in_short(*own->second)};
        return {"grey_50", "no proposal: please choose"};
    }

private:
    std::map<std::string, const Material*> of_file_;
};

std::string rule_text(const std::string& layer, const std::string& material, const Use& use, const std::string& amount)
{
    std::string text =
        "[[rule]]" + (amount.empty() ? "" : "  # " + amount) + "\nlayer = " + toml_quoted(exactly(layer));
    if (!material.empty())
        text += "\nmaterial = " + toml_quoted(exactly(material));
    return text + "\nuse = " + toml_quoted(use.material) + "  # " + use.reason + "\n\n";
}

std::string plural(std::size_t count)
{
    return count == 1 ? "1 surface" : fmt::format("{} surfaces", count);
}

/// Pairs of parallel sheets by layer, for layers whose name speaks of glass.
std::map<std::string, std::size_t> pairs_of_sheets(const Imported& imported)
{
    std::vector<bool> is_glass;
    for (const SurfaceKey& key : imported.keys)
        is_glass.push_back(propose_material(key) == plain_glass);
    std::map<std::string, std::size_t> pairs;
    const auto count = [&](const Part& part) {
        std::map<std::string, std::vector<std::size_t>> surfaces;
        for (std::size_t i = 0; i < part.surfaces.size(); ++i) {
            const auto modifier = static_cast<std::size_t>(part.surfaces[i].modifier);
            if (part.surfaces[i].modifier != void_modifier && modifier < is_glass.size() && is_glass[modifier])
                surfaces[imported.keys[modifier].layer].push_back(i);
        }
        for (const auto& [layer, candidates] : surfaces)
            pairs[layer] += double_panes(part, candidates).size();
    };
    for (const Part& part : imported.scene.prototypes)
        count(part);
    count(imported.scene.root);
    return pairs;
}

/// What is proposed for a layer: by material of the file.
using Uses = std::map<std::string, Use>;

/// Rules for the keys that `wanted` says yes to, by layer.
template <class Wanted>
std::map<std::string, Uses> uses_by_layer(const Imported& imported, const Wanted& wanted)
{
    const Proposer proposer{imported};
    std::map<std::string, std::size_t> pairs = pairs_of_sheets(imported);
    std::map<std::string, Uses> uses;
    for (std::size_t i = 0; i < imported.keys.size(); ++i) {
        const SurfaceKey& key = imported.keys[i];
        if (!std::holds_alternative<Inherited>(imported.scene.modifiers[i].what) && wanted(key))
            uses[key.layer].try_emplace(key.material, proposer.use_for(key, pairs[key.layer]));
    }
    return uses;
}

/// One rule for the layer; materials of the file that end elsewhere follow as exceptions.
std::string rules_text(const LayerSummary& layer, const Uses& by_material)
{
    const Use& common = by_material.begin()->second;
    std::string text =
        rule_text(layer.name, {}, common, fmt::format("{}, {:.6g} m2", plural(layer.surfaces), layer.area_m2));
    for (const auto& [material, use] : by_material)
        if (!(use == common))
            text += rule_text(layer.name, material, use, {});
    return text;
}

/// Rules that leave alone what earlier ones decide: by layer where none of its surfaces has a rule yet, else by layer
/// and material.
std::string added_rules(const Imported& imported, const LayerMap& map)
{
    const auto has_rule = [&](const SurfaceKey& key) {
        return std::any_of(map.rules.begin(), map.rules.end(),
                           [&](const LayerRule& rule) { return rule_matches(rule, key); });
    };
    const auto missing = uses_by_layer(imported, [&](const SurfaceKey& key) { return !has_rule(key); });
    const auto mapped = uses_by_layer(imported, has_rule);
    std::string text;
    for (const LayerSummary& layer : summarize_layers(imported)) {
        const auto entry = missing.find(layer.name);
        if (entry == missing.end())
            continue;
        const auto beside = mapped.find(layer.name);
        if (beside == mapped.end())
            text += rules_text(layer, entry->second);
        else
            for (const auto& [material, use] : entry->second)
                if (!material.empty() && !beside->second.contains(material))
                    text += rule_text(layer.name, material, use, {});
    }
    return text;
}

} // namespace

std::string propose_layer_map(const Imported& imported)
{
    const auto uses = uses_by_layer(imported, [](const SurfaceKey&) { return true; });
    std::string text =
        "# Which material each layer gets. The last rule that matches wins; patterns know * ? [a-z] and A..B;\n"
        "# use = \"void\" leaves the surfaces out. `lightwell materials` lists the library.\n"
        "# Materials are proposed by name only: please check them.\n\n";
    for (const LayerSummary& layer : summarize_layers(imported))
        if (const auto entry = uses.find(layer.name); entry != uses.end())
            text += rules_text(layer, entry->second);
    return text;
}

std::string extend_layer_map(const Imported& imported, const LayerMap& map, const std::string& text)
{
    const std::string added = added_rules(imported, map);
    if (added.empty())
        return text;
    const std::string_view gap = text.empty() || text.ends_with("\n\n") ? "" : text.ends_with('\n') ? "\n" : "\n\n";
    return text + std::string(gap) + "# --- proposed for what had no rule\n" + added;
}

} // namespace lightwell
