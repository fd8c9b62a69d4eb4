#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "engine/base/toml.h"
#include "importers/layer_rules.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

EmissionSide side_of(const TomlTable& table)
{
    const std::string word = table.text("side").value_or("both");
    if (word == "both")
        return EmissionSide::both;
    if (word == "front")
        return EmissionSide::front;
    if (word == "back")
        return EmissionSide::back;
    throw InputError{table.place_of("side"), "side is \"" + word + "\", expected \"both\", \"front\" or \"back\"",
                     "it says to which side of a sheet an emitter sends its light"};
}

LayerRule rule_of(const TomlTable& table)
{
    table.expect_words({"layer", "group", "block", "material", "entity", "colour", "use", "side"});
    LayerRule rule;
    rule.line = table.line();
    bool any = false;
    for (const RuleWord& word : rule_words) {
        const auto pattern = table.text(word.name);
        if (!pattern)
            continue;
        if (pattern->empty())
            throw InputError{table.place_of(word.name), std::string(word.name) + " is empty",
                             "leave the word out, or write \"*\" for any"};
        rule.*word.pattern = *pattern;
        any = true;
    }
    if (!any)
        throw InputError{table.place(), "the rule says for no surface",
                         "give at least one of layer, group, block, material, entity, colour"};
    if (!rule.colour.empty() && rule.colour[0] != '#')
        throw InputError{table.place_of("colour"), "colour is \"" + rule.colour + "\", expected #rrggbb",
                         "for example colour = \"#ff0000\""};
    rule.use = table.text("use").value_or("");
    if (rule.use.empty())
        throw InputError{table.place(), "the rule does not say which material to use",
                         "add use = \"...\" with a name of the library, or use = \"void\" to leave the surfaces out"};
    rule.side = side_of(table);
    return rule;
}

} // namespace

std::string colour_text(const SurfaceKey& key)
{
    if (!key.colour)
        return {};
    constexpr char digits[] = "0123456789abcdef";
    std::string text = "#";
    for (int channel = 0; channel < 3; ++channel) {
        const double encoded = linear_to_srgb(std::clamp((*key.colour)[channel], 0.0, 1.0));
        const auto byte = static_cast<unsigned>(std::lround(255 * encoded));
        text += {digits[byte >> 4], digits[byte & 15]};
    }
    return text;
}

bool rule_matches(const LayerRule& rule, const SurfaceKey& key)
{
    const auto fits = [](const std::string& pattern, const std::string& value) {
        return pattern.empty() || matches(pattern, value);
    };
    return fits(rule.layer, key.layer) && fits(rule.group, key.group) && fits(rule.block, key.block) &&
           fits(rule.material, key.material) && fits(rule.entity, key.entity) &&
           (rule.colour.empty() || (key.colour && matches(rule.colour, colour_text(key))));
}

LayerMap read_layer_map(const std::filesystem::path& file)
{
    const TomlTable table = read_toml(file);
    table.expect_words({"default", "rule"});
    LayerMap map;
    map.file = file;
    map.default_material = table.text("default").value_or("");
    for (const TomlTable* rule : table.tables("rule"))
        map.rules.push_back(rule_of(*rule));
    return map;
}

} // namespace lightwell
