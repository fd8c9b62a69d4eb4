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

NumberRange range_of(const TomlTable& table, const char* word)
{
    const auto text = table.text(word);
    if (!text)
        return {};
    const std::size_t dots = text->find("..");
    const auto end = [&](std::string_view number, double without) -> std::optional<double> {
        return trimmed(number).empty() ? without : parse_double(trimmed(number));
    };
    if (dots != std::string::npos && trimmed(*text) != "..") {
        const auto low = end(std::string_view(*text).substr(0, dots), -infinity);
        const auto high = end(std::string_view(*text).substr(dots + 2), infinity);
        if (low && high && *low <= *high)
            return {*low, *high};
    }
    throw InputError{table.place_of(word), std::string(word) + " is \"" + *text + "\", expected LOW..HIGH",
                     "for example \"0.5..2\", \"..0.1\" or \"10..\""};
}

/// `luminaire`, `aim` and `turn`.
void take_luminaire(const TomlTable& table, const std::filesystem::path& map, LayerRule& rule, Report& report)
{
    const auto file = table.text("luminaire");
    for (const char* word : {"aim", "turn"})
        if (!file && table.has(word))
            throw InputError{table.place_of(word), std::string(word) + " without luminaire",
                             "it says where a measured luminaire sends its light: add luminaire = \"file.ies\""};
    if (!file)
        return;
    rule.luminaire = map.parent_path() / *file;
    try {
        rule.photometry = std::make_shared<const Photometry>(read_photometry(rule.luminaire, report));
    } catch (const InputError& error) {
        throw InputError{table.place_of("luminaire"), error.what(),
                         "name an IES or EULUMDAT file, from the map's folder"};
    }
    if (table.has("aim")) {
        const std::vector<double> aim = table.numbers("aim");
        if (aim.size() == 3)
            rule.aim = {aim[0], aim[1], aim[2]};
        if (!(length(rule.aim) > 0) || !is_finite(rule.aim))
            throw InputError{table.place_of("aim"), "aim is no direction",
                             "three numbers, for example aim = [0, 0.3, -1]"};
    }
    rule.turn_deg = table.number("turn").value_or(0);
    if (!(std::fabs(rule.turn_deg) <= 360))
        throw InputError{table.place_of("turn"),
                         "turn is " + shortest(rule.turn_deg) + ", expected -360 to 360 degrees"};
}

LayerRule rule_of(const TomlTable& table, const std::filesystem::path& file, Report& report)
{
    table.expect_words({"layer", "group", "block", "material", "entity", "colour", "area_m2", "size_m", "use", "side",
                        "luminaire", "aim", "turn"});
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
    rule.area_m2 = range_of(table, "area_m2");
    rule.size_m = range_of(table, "size_m");
    if (!any && !table.has("area_m2") && !table.has("size_m"))
        throw InputError{table.place(), "the rule says for no surface",
                         "give at least one of layer, group, block, material, entity, colour, area_m2, size_m"};
    if (!rule.colour.empty() && rule.colour[0] != '#')
        throw InputError{table.place_of("colour"), "colour is \"" + rule.colour + "\", expected #rrggbb",
                         "for example colour = \"#ff0000\""};
    rule.use = table.text("use").value_or("");
    take_luminaire(table, file, rule, report);
    if (rule.use.empty() && !rule.photometry)
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

bool places_luminaire(const LayerRule& rule, const SurfaceKey& bare_insert)
{
    return rule.photometry && rule.area_m2 == NumberRange{} && rule.size_m == NumberRange{} &&
           rule_matches(rule, bare_insert);
}

LayerMap read_layer_map(const std::filesystem::path& file)
{
    const TomlTable table = read_toml(file);
    table.expect_words({"default", "rule"});
    LayerMap map;
    map.file = file;
    map.default_material = table.text("default").value_or("");
    for (const TomlTable* rule : table.tables("rule"))
        map.rules.push_back(rule_of(*rule, file, map.report));
    return map;
}

} // namespace lightwell
