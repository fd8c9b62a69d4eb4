#include "engine/base/text.h"
#include "importers/layer_words.h"
#include "importers/layers.h"
#include "materials/library.h"

#include <algorithm>
#include <set>

namespace lightwell {
namespace {

using Ideas = std::set<std::string>;

/// All of `ideas` (separated by blanks) together mean the material; the first row that holds decides.
struct Proposal {
    const char* ideas;
    const char* material;
};

constexpr Proposal proposals[] = {
    // --- emitters
    {"exit light", "exit_sign"},
    {"exit", "exit_sign"},
    {"screen glass", "glass_single_clear"},
    {"screen partition", "fabric"},
    {"lightbox", "light_box"},
    {"candle", "candle_flame"},
    {"light pole", "painted_steel"},
    {"light frame", "painted_steel"},
    {"strip light", "light_strip"},
    {"fluorescent", "fluorescent_t8"},
    {"spot", "spot_lens"},
    {"bulb", "lamp"},
    {"light", "luminaire_panel"},
    {"blind screen", "blind_pastel"},
    {"screen", "screen"},
    // --- glass, mirrors, shading
    {"mirror", "mirror"},
    {"frame window wood", "medium_wood"},
    {"frame door wood", "medium_wood"},
    {"frame window steel", "painted_steel"},
    {"frame wood", "medium_wood"},
    {"frame steel", "painted_steel"},
    {"frame aluminium dark", "dark_anodised_aluminium"},
    {"frame aluminium", "anodised_aluminium"},
    {"frame curtainwall", "anodised_aluminium"},
    {"frame plastic", "white_gloss_paint"},
    {"frame window", "white_gloss_paint"},
    {"frame door", "white_gloss_paint"},
    {"frame glazing", "anodised_aluminium"},
    {"sill", "white_gloss_paint"},
    {"blind opal", "blind_white"},
    {"blind dark", "blind_dark"},
    {"blind black", "blind_dark"},
    {"blind grey", "blind_pastel"},
    {"blind metal", "blind_opaque"},
    {"blind aluminium", "blind_opaque"},
    {"blind", "blind_white"},
    {"curtain wall frame", "anodised_aluminium"},
    {"curtain wall", "glass_double_clear"},
    {"curtain facade", "glass_double_clear"},
    {"curtain", "curtain_light"},
    {"acrylic opal", "acrylic_opal"},
    {"acrylic translucent", "acrylic_opal"},
    {"acrylic white", "acrylic_opal"},
    {"acrylic", "acrylic_clear"},
    {"polycarbonate", "polycarbonate_multiwall"},
    {"etfe", "etfe_cushion"},
    {"glass block", "glass_frosted"},
    {"glass brick", "glass_frosted"},
    {"glass opal", "glass_opal"},
    {"glass frosted", "glass_frosted"},
    {"glass translucent", "glass_frosted"},
    {"glazing frosted", "glass_frosted"},
    {"frosted", "glass_frosted"},
    {"glass bronze", "glass_tinted_bronze"},
    {"glass brown", "glass_tinted_bronze"},
    {"glass green", "glass_tinted_green"},
    {"glass grey", "glass_tinted_grey"},
    {"glass dark", "glass_tinted_grey"},
    {"glass tinted", "glass_tinted_grey"},
    {"glazing tinted", "glass_tinted_grey"},
    {"glass reflective", "glass_reflective"},
    {"glass triple lowe", "glass_triple_low_e"},
    {"glazing triple lowe", "glass_triple_low_e"},
    {"glass triple", "glass_triple_clear"},
    {"glazing triple", "glass_triple_clear"},
    {"glass lowe", "glass_double_low_e"},
    {"glazing lowe", "glass_double_low_e"},
    {"glass double", "glass_double_clear"},
    {"glazing double", "glass_double_clear"},
    {"glass single", "glass_single_clear"},
    {"glazing single", "glass_single_clear"},
    {"glass window", "glass_double_clear"},
    {"glass curtainwall", "glass_double_clear"},
    {"glass facade", "glass_double_clear"},
    {"glass exterior", "glass_double_clear"},
    {"glass roof", "glass_double_clear"},
    {"glass skylight", "glass_double_clear"},
    {"glass", "glass_single_clear"},
    {"glazing partition", "glass_single_clear"},
    {"glazing railing", "glass_single_clear"},
    {"glazing", "glass_double_clear"},
    {"curtainwall", "glass_double_clear"},
    {"curt wall", "glass_double_clear"},
    {"curt", "glass_double_clear"},
    {"skylight", "glass_double_clear"},
    {"window", "glass_double_clear"},
    {"membrane roof", "membrane_white"},
    {"membrane white", "membrane_white"},
    // --- metals
    {"corten", "corten_steel"},
    {"copper patina", "weathered_copper"},
    {"patina", "weathered_copper"},
    {"copper", "copper"},
    {"brass", "brass"},
    {"bronze", "dark_anodised_aluminium"},
    {"chrome", "chrome"},
    {"gold", "gold"},
    {"zinc", "zinc"},
    {"stainless", "stainless_steel"},
    {"aluminium polished", "polished_aluminium"},
    {"aluminium brushed", "brushed_aluminium"},
    {"aluminium dark", "dark_anodised_aluminium"},
    {"aluminium black", "dark_anodised_aluminium"},
    {"aluminium", "anodised_aluminium"},
    {"steel concrete", "concrete"},
    {"steel painted", "painted_steel"},
    {"steel paint", "painted_steel"},
    {"steel", "steel"},
    // --- what stands before its material
    {"sanitary", "sanitary_porcelain"},
    {"porcelain", "sanitary_porcelain"},
    // --- mineral materials
    {"concrete block", "concrete_block"},
    {"concrete brick", "concrete_block"},
    {"concrete white", "white_concrete"},
    {"concrete pale", "light_concrete"},
    {"concrete paving", "concrete_paving"},
    {"concrete", "concrete"},
    {"sandlime", "sand_lime_brick"},
    {"tile roof", "terracotta"},
    {"brick roof", "terracotta"},
    {"terracotta", "terracotta"},
    {"block", "concrete_block"},
    {"brick dark", "dark_brick"},
    {"brick yellow", "buff_brick"},
    {"brick cream", "buff_brick"},
    {"brick pale", "buff_brick"},
    {"brick white", "sand_lime_brick"},
    {"brick", "red_brick"},
    {"limestone", "limestone"},
    {"sandstone", "sandstone"},
    {"granite", "granite"},
    {"marble", "white_marble"},
    {"slate", "slate"},
    {"stone paving", "granite"},
    {"stone", "limestone"},
    {"carpet dark", "dark_carpet"},
    {"carpet black", "dark_carpet"},
    {"carpet", "carpet"},
    {"tile acoustic", "acoustic_ceiling_tile"},
    {"tile ceiling", "acoustic_ceiling_tile"},
    {"acoustic ceiling", "acoustic_ceiling_tile"},
    {"tile floor", "floor_tile"},
    {"tile paving", "floor_tile"},
    {"tile", "white_ceramic_tile"},
    {"gypsum", "gypsum_board"},
    {"plaster exterior", "render"},
    {"plaster facade", "render"},
    {"plaster", "white_plaster"},
    {"render", "render"},
    {"screed", "cement_screed"},
    {"bitumenroof", "bitumen_roof"},
    {"asphalt", "asphalt"},
    // --- wood and floors
    {"oak dark", "dark_oak"},
    {"oak", "oak"},
    {"walnut", "walnut"},
    {"birch", "birch"},
    {"maple", "maple"},
    {"beech", "beech"},
    {"pine", "pine"},
    {"mahogany", "mahogany"},
    {"parquet", "wood_floor"},
    {"wood floor", "wood_floor"},
    {"laminate floor", "wood_floor"},
    {"laminate", "white_laminate"},
    {"wood dark", "dark_wood"},
    {"wood pale", "light_wood"},
    {"wood white", "white_gloss_paint"},
    {"wood", "medium_wood"},
    {"linoleum", "linoleum"},
    {"rubber", "rubber_floor"},
    {"leather", "leather"},
    {"fabric", "fabric"},
    {"sofa", "fabric"},
    {"metal", "painted_steel"},
    // --- outdoors
    {"green roof", "grass"},
    {"tree trunk", "bark"},
    {"trunk", "bark"},
    {"tree leaf", "leaf"},
    {"leaf", "leaf"},
    {"tree", "foliage"},
    {"grass", "grass"},
    {"plant", "foliage"},
    {"gravel", "gravel"},
    {"snow", "snow"},
    {"water", "water"},
    {"soil", "soil"},
    {"sand", "sand"},
    {"fence", "painted_steel"},
    {"vehicle park", "asphalt"},
    {"park", "grass"},
    {"road", "asphalt"},
    {"paving", "concrete_paving"},
    {"ground", "ground"},
    {"vehicle", "painted_steel"},
    {"building", "outside_facade"},
    // --- parts, before colours where the colour of the part is not its paint
    {"equipment", "grey_plastic"},
    {"elevator", "stainless_steel"},
    {"plastic", "grey_plastic"},
    {"paper wall", "generic_wall"},
    {"paper", "white_paper"},
    // --- colours of paint
    {"white furniture", "white_laminate"},
    {"white door", "white_gloss_paint"},
    {"white", "white_paint"},
    {"black", "black_paint"},
    {"grey dark", "dark_grey_paint"},
    {"grey pale", "light_grey_paint"},
    {"grey", "mid_grey_paint"},
    {"cream", "cream_paint"},
    {"red", "red_paint"},
    {"yellow", "yellow_paint"},
    {"green", "green_paint"},
    {"blue", "blue_paint"},
    {"brown", "brown_paint"},
    {"paint", "white_paint"},
    // --- parts without a material
    {"kitchen", "white_laminate"},
    {"furniture", "generic_furniture"},
    {"partition", "generic_wall"},
    {"railing", "stainless_steel"},
    {"stair", "concrete"},
    {"skirting", "white_gloss_paint"},
    {"door", "light_wood"},
    {"column", "concrete"},
    {"rafter", "medium_wood"},
    {"sunshade", "anodised_aluminium"},
    {"beam", "concrete"},
    {"foundation", "concrete"},
    {"acoustic", "acoustic_ceiling_tile"},
    {"ceiling", "generic_ceiling"},
    {"roof", "light_roof"},
    {"facade", "outside_facade"},
    {"wall", "generic_wall"},
    {"slab", "concrete"},
    {"floor", "generic_floor"},
    {"frame", "anodised_aluminium"},
    {"membrane", "membrane_white"},
};

/// "light" beside one of these is an adjective: light wood, light grey.
constexpr const char* can_be_light[] = {"wood",  "concrete", "grey",   "brick", "stone", "oak",     "metal",
                                        "green", "blue",     "brown",  "paint", "red",   "plaster", "carpet",
                                        "roof",  "steel",    "yellow", "beech", "tile",  "cream",   "pine"};

void settle_light(Ideas& ideas)
{
    if (ideas.erase("lightword") == 0)
        return;
    const bool adjective = std::any_of(std::begin(can_be_light), std::end(can_be_light),
                                       [&](const char* idea) { return ideas.contains(idea); });
    ideas.insert(adjective ? "pale" : "light");
}

std::string material_for(Ideas ideas)
{
    settle_light(ideas);
    if (ideas.contains("annotation") && !ideas.contains("light"))
        return {};
    for (const Proposal& proposal : proposals) {
        const std::vector<std::string_view> wanted = split(proposal.ideas);
        if (std::all_of(wanted.begin(), wanted.end(),
                        [&](std::string_view idea) { return ideas.contains(std::string(idea)); }))
            return proposal.material;
    }
    return {};
}

/// Beginning of an element code and the idea that it stands for.
struct Code {
    const char* beginning;
    const char* idea;
};

/// Source  CI/SfB table 1, element codes, as ISO 13567 and BS 1192-5 layers carry them
constexpr Code ci_sfb[] = {
    {"11", "ground"},   {"13", "floor"},    {"16", "foundation"}, {"17", "foundation"}, {"21", "wall"},
    {"22", "wall"},     {"23", "slab"},     {"24", "stair"},      {"27", "roof"},       {"28", "column"},
    {"315", "door"},    {"31", "window"},   {"32", "door"},       {"34", "railing"},    {"35", "ceiling"},
    {"37", "skylight"}, {"41", "render"},   {"42", "wall"},       {"43", "floor"},      {"44", "stair"},
    {"45", "ceiling"},  {"47", "roof"},     {"5", "equipment"},   {"63", "light"},      {"6", "equipment"},
    {"74", "sanitary"}, {"7", "furniture"}, {"8", "furniture"},   {"90", "ground"}};
/// Source  Uniclass 1.4 table G, elements for buildings
constexpr Code uniclass_g[] = {{"21", "foundation"}, {"22", "slab"},   {"23", "stair"},    {"24", "roof"},
                               {"25", "wall"},       {"26", "column"}, {"32", "window"},   {"44", "sanitary"},
                               {"4", "furniture"},   {"54", "light"},  {"5", "equipment"}, {"6", "equipment"},
                               {"71", "ground"},     {"72", "fence"}};
/// Source  Uniclass 2015 table EF, elements and functions
constexpr Code uniclass_2015[] = {{"20_05", "foundation"}, {"20", "column"},    {"25_30", "window"},
                                  {"25", "wall"},          {"30_10", "roof"},   {"30", "slab"},
                                  {"35", "stair"},         {"40", "furniture"}, {"45", "plant"},
                                  {"70_80", "light"},      {"70", "equipment"}, {"60", "equipment"}};

template <std::size_t N>
std::string material_of_code(const Code (&codes)[N], const std::string& digits)
{
    for (const Code& code : codes)
        if (digits.starts_with(code.beginning))
            return material_for({code.idea});
    return {};
}

bool is_capital(char c)
{
    return c >= 'A' && c <= 'Z';
}
bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/// The run of digits that begins at a place.
std::string digits_at(const std::string& text, std::size_t at)
{
    std::size_t end = std::min(at, text.size());
    while (end < text.size() && is_digit(text[end]))
        ++end;
    return text.substr(std::min(at, text.size()), end - std::min(at, text.size()));
}

/// `A-G25-M`, `A2G251`: a role of one or two characters, hyphens, then G with two or three digits.
std::string uniclass_g_code(const std::string& text)
{
    const std::size_t second = text.size() > 1 && text[1] != '-' && text[1] != 'G' ? 2 : 1;
    const std::size_t g = text.find_first_not_of('-', second);
    if (text.empty() || !is_capital(text[0]) || g == std::string::npos || text[g] != 'G')
        return {};
    const std::string digits = digits_at(text, g + 1);
    return digits.size() == 2 || digits.size() == 3 ? digits : std::string();
}

/// `A-EF_25_10-M`: two digits, and two more after an underscore when they are there.
std::string uniclass_2015_code(const std::string& text)
{
    for (const char* table : {"EF_", "EE_"}) {
        const std::size_t at = text.find(table);
        if (at == std::string::npos || (at > 0 && is_capital(text[at - 1])))
            continue;
        const std::string group = digits_at(text, at + 3), sub_group = digits_at(text, at + 6);
        if (group.size() == 2)
            return text[at + 5] == '_' && sub_group.size() == 2 ? group + '_' + sub_group : group;
    }
    return {};
}

/// `A-220---E-`, `A-(21)-G`: role of two characters, then the element of up to six; `A210G7`: role, three digits.
std::string ci_sfb_code(const std::string& text)
{
    if (text.size() < 5 || !is_capital(text[0]))
        return {};
    const std::string compact = digits_at(text, 1);
    if (compact.size() == 3 && is_capital(text[4]))
        return compact;
    const bool bracket = text[2] == '(';
    const std::string digits = digits_at(text, bracket ? 3 : 2);
    const std::size_t after = (bracket ? 3 : 2) + digits.size();
    const bool ends = after < text.size() && (text[after] == '-' || text[after] == ')');
    return digits.size() >= 2 && digits.size() <= 6 && ends ? digits : std::string();
}

/// The element field of ISO 13567, BS 1192 and Uniclass layers.
std::string material_by_code(const std::string& layer)
{
    std::string text = layer;
    std::transform(text.begin(), text.end(), text.begin(),
                   [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
    if (const std::string code = uniclass_g_code(text); !code.empty())
        return material_of_code(uniclass_g, code);
    if (const std::string code = uniclass_2015_code(text); !code.empty())
        return material_of_code(uniclass_2015, code);
    if (const std::string code = ci_sfb_code(text); !code.empty())
        return material_of_code(ci_sfb, code);
    return {};
}

/// A name of the library itself, however its words are joined: `Led-Panel 4000cd`.
std::string material_of_that_name(const std::string& name)
{
    std::string entry = folded(name);
    std::replace_if(
        entry.begin(), entry.end(), [](char c) { return c == ' ' || c == '-'; }, '_');
    // Who calls a layer black means paint, not the perfect absorber.
    return entry != "black" && find_in_library(entry) ? entry : std::string();
}

} // namespace

std::string propose_material(const SurfaceKey& key)
{
    // What a file calls its material says most; then the layer, by words and by codes; then group and block.
    for (const std::string* name : {&key.material, &key.layer}) {
        if (const std::string material = material_of_that_name(*name); !material.empty())
            return material;
        if (const std::string material = material_for(ideas_in(*name)); !material.empty())
            return material;
    }
    if (const std::string material = material_by_code(key.layer); !material.empty())
        return material;
    for (const std::string* name : {&key.group, &key.block}) {
        const std::string material = material_for(ideas_in(*name));
        if (!material.empty())
            return material;
    }
    return {};
}

} // namespace lightwell
