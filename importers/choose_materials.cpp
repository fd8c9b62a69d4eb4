#include "importers/choose_materials.h"

#include "engine/base/errors.h"
#include "engine/base/nearest.h"
#include "importers/geometry_words.h"
#include "importers/layer_rules.h"
#include "materials/library.h"

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>

namespace lightwell {
namespace {

/// Says "the material that the file itself describes", also where the library has one of that name.
constexpr std::string_view file_prefix = "file:";
constexpr const char* fallback_material = "grey_50";

/// The materials that a map can name: the library, then those of the file.
class MaterialNames {
public:
    explicit MaterialNames(const Imported& imported) : imported_(imported)
    {
        for (const auto& [name, material] : imported.file_materials)
            of_file_.try_emplace(name, &material);
    }

    /// @param place  of the map, for the message
    Choice named(const std::string& use, EmissionSide side, const std::string& place) const
    {
        if (use == "void")
            return {Choice::Kind::dropped, {}, nullptr, side};
        if (use.starts_with(file_prefix)) {
            const std::string name = use.substr(file_prefix.size());
            if (const Material* own = of_file(name))
                return from_file(name, *own, side);
        } else if (const LibraryMaterial* entry = find_in_library(use)) {
            return {Choice::Kind::material, entry->name, &entry->material, side};
        } else if (const Material* own = of_file(use)) {
            return from_file(use, *own, side);
        }
        throw InputError{place, "unknown material \"" + use + '"', nearest_hint(use, all_names())};
    }
    const Material* of_file(const std::string& name) const
    {
        const auto found = of_file_.find(name);
        return found == of_file_.end() ? nullptr : found->second;
    }
    static Choice from_file(const std::string& name, const Material& material, EmissionSide side)
    {
        const std::string scene_name = find_in_library(name) ? std::string(file_prefix) + name : name;
        return {Choice::Kind::material, scene_name, &material, side, -1, -1, name};
    }

private:
    std::vector<std::string> all_names() const
    {
        std::vector<std::string> names;
        for (const LibraryMaterial& entry : material_library())
            names.push_back(entry.name);
        for (const auto& [name, material] : imported_.file_materials)
            names.push_back(name);
        names.push_back("void");
        return names;
    }
    const Imported& imported_;
    std::unordered_map<std::string, const Material*> of_file_;
};

bool is_placeholder(const Modifier& modifier)
{
    return std::holds_alternative<Inherited>(modifier.what);
}

bool is_settled(const Imported& imported, std::size_t modifier)
{
    const auto* alias = std::get_if<Alias>(&imported.scene.modifiers[modifier].what);
    const bool open = is_placeholder(imported.scene.modifiers[modifier]) || (alias && alias->target == void_modifier);
    return modifier >= imported.keys.size() || !open;
}

std::string place_of(const LayerMap& map, const LayerRule& rule)
{
    return map.file.string() + ':' + std::to_string(rule.line);
}

/// Names the word of the rule that fits nothing, with what it could have been.
[[noreturn]] void reject_unmatched(const Imported& imported, const LayerMap& map, const LayerRule& rule)
{
    std::string said;
    for (const RuleWord& word : rule_words) {
        const std::string& pattern = rule.*word.pattern;
        if (pattern.empty())
            continue;
        said += (said.empty() ? "" : ", ") + std::string(word.name) + " = \"" + pattern + '"';
        LayerRule alone;
        alone.*word.pattern = pattern;
        std::set<std::string> present;
        bool fits = false;
        for (std::size_t i = 0; i < imported.keys.size(); ++i) {
            const SurfaceKey& key = imported.keys[i];
            if (is_placeholder(imported.scene.modifiers[i]))
                continue;
            fits = fits || rule_matches(alone, key);
            const std::string values[] = {key.layer, key.group, key.block, key.material, key.entity, colour_text(key)};
            const std::string& value = values[&word - rule_words];
            if (!value.empty())
                present.insert(value);
        }
        if (fits)
            continue;
        const std::string hint = nearest_hint(pattern, {present.begin(), present.end()}, 5);
        throw InputError{place_of(map, rule), std::string(word.name) + " = \"" + pattern + "\" matches no surface",
                         hint.empty() ? "the file gives no surface a " + std::string(word.name) : hint};
    }
    if (rule.area_m2 != NumberRange{} || rule.size_m != NumberRange{})
        said += (said.empty() ? "" : ", ") + std::string("the area and size of the rule");
    throw InputError{place_of(map, rule), "no surface has " + said + " together",
                     "list the layers with `lightwell layers`, or drop a word of the rule"};
}

struct RuleUse {
    std::vector<bool> matched, won;
};

/// The last rule with a material that matches the key of a modifier; -1 when none does.
/// @param luminaire  becomes the last rule with a luminaire
int winning_rule(const LayerMap& map, const SurfaceKey& key, std::size_t modifier, const GeometryClasses& classes,
                 RuleUse& use, int& luminaire)
{
    int winner = -1;
    for (std::size_t i = map.rules.size(); i-- > 0;) {
        if (!rule_matches(map.rules[i], key) || !classes.fits(modifier, i))
            continue;
        use.matched[i] = true;
        if (map.rules[i].photometry && luminaire < 0) {
            use.won[i] = true;
            luminaire = static_cast<int>(i);
        }
        if (winner < 0 && !map.rules[i].use.empty()) {
            use.won[i] = true;
            winner = static_cast<int>(i);
        }
    }
    return winner;
}

Choice choice_without_rule(const SurfaceKey& key, const LayerMap& map, const MaterialNames& names)
{
    if (!map.default_material.empty())
        return names.named(map.default_material, EmissionSide::both, map.file.string() + ": default");
    // A file that describes its emitters also says by its corners which side emits.
    if (const Material* own = key.material.empty() ? nullptr : names.of_file(key.material))
        return MaterialNames::from_file(key.material, *own, EmissionSide::front);
    return names.named(fallback_material, EmissionSide::front, "library");
}

/// Symbols that a rule makes luminaires of.
void use_bare_inserts(const Imported& imported, const LayerMap& map, RuleUse& use)
{
    for (const BareInsert& insert : imported.bare_inserts)
        for (std::size_t i = map.rules.size(); i-- > 0;)
            if (places_luminaire(map.rules[i], insert.key)) {
                use.matched[i] = use.won[i] = true;
                break;
            }
}

/// Surfaces by modifier; those in prototypes count once.
std::vector<std::size_t> count_surfaces(const Scene& scene)
{
    std::vector<std::size_t> counts(scene.modifiers.size());
    const auto count = [&](const Part& part) {
        for (const Surface& surface : part.surfaces)
            if (surface.modifier != void_modifier)
                ++counts[static_cast<std::size_t>(surface.modifier)];
        for (const Instance& instance : part.instances)
            for (const Binding& binding : instance.bindings)
                if (binding.actual != void_modifier)
                    ++counts[static_cast<std::size_t>(binding.actual)];
    };
    for (const Part& part : scene.prototypes)
        count(part);
    count(scene.root);
    return counts;
}

void note_fallback(Imported& imported, const std::vector<std::size_t>& unmapped)
{
    if (unmapped.empty())
        return;
    const std::vector<std::size_t> counts = count_surfaces(imported.scene);
    std::map<std::string, std::pair<std::size_t, std::string>> layers;
    for (const std::size_t modifier : unmapped) {
        auto& [count, proposal] = layers[imported.keys[modifier].layer];
        count += counts[modifier];
        if (proposal.empty())
            proposal = propose_material(imported.keys[modifier]);
    }
    for (const auto& [layer, entry] : layers)
        if (entry.first > 0)
            imported.report.add(Finding::unmapped, "layer \"" + layer + '"',
                                "layer \"" + layer + "\" has no material: set to " + fallback_material +
                                    (entry.second.empty() ? "" : "; by its name it could be " + entry.second),
                                entry.first);
}

void note_useless(Imported& imported, const LayerMap& map, const RuleUse& use)
{
    for (std::size_t i = 0; i < map.rules.size(); ++i) {
        const LayerRule& rule = map.rules[i];
        if (!use.matched[i])
            reject_unmatched(imported, map, rule);
        if (!use.won[i])
            imported.report.add(Finding::unused, place_of(map, rule),
                                "rule in line " + std::to_string(rule.line) +
                                    " has no effect: later rules decide for all its surfaces");
    }
}

} // namespace

void give_each_modifier_a_key(Imported& imported)
{
    for (std::size_t i = imported.keys.size(); i < imported.scene.modifiers.size(); ++i)
        imported.keys.push_back({imported.scene.modifiers[i].name, {}, {}, {}, {}, {}});
}

ModifierId add_copy(Imported& imported, ModifierId of)
{
    give_each_modifier_a_key(imported);
    const auto index = static_cast<std::size_t>(of);
    imported.scene.modifiers.push_back(imported.scene.modifiers[index]);
    imported.keys.push_back(imported.keys[index]);
    return static_cast<ModifierId>(imported.keys.size() - 1);
}

std::vector<Choice> choose_materials(Imported& imported, const LayerMap& map)
{
    const MaterialNames names{imported};
    for (const LayerRule& rule : map.rules) // unknown names are errors even where no surface would get them
        if (!rule.use.empty())
            names.named(rule.use, rule.side, place_of(map, rule));
    const GeometryClasses classes{imported, map};
    std::vector<Choice> choices(imported.scene.modifiers.size());
    RuleUse use{std::vector<bool>(map.rules.size()), std::vector<bool>(map.rules.size())};
    std::vector<std::size_t> unmapped;
    for (std::size_t i = 0; i < choices.size(); ++i) {
        if (is_settled(imported, i)) {
            choices[i].kind = Choice::Kind::settled;
            continue;
        }
        const SurfaceKey& key = imported.keys[i];
        if (is_placeholder(imported.scene.modifiers[i])) {
            choices[i].kind = Choice::Kind::inherited; // rules are for the keys that instances put in its place
            continue;
        }
        int luminaire = -1;
        if (const int winner = winning_rule(map, key, i, classes, use, luminaire); winner >= 0) {
            const LayerRule& rule = map.rules[static_cast<std::size_t>(winner)];
            choices[i] = names.named(rule.use, rule.side, place_of(map, rule));
            choices[i].rule = winner;
        } else {
            choices[i] = choice_without_rule(key, map, names);
            if (map.default_material.empty() && (key.material.empty() || !names.of_file(key.material)))
                unmapped.push_back(i);
        }
        choices[i].luminaire = luminaire;
    }
    use_bare_inserts(imported, map, use);
    note_useless(imported, map, use);
    note_fallback(imported, unmapped);
    return choices;
}

} // namespace lightwell
