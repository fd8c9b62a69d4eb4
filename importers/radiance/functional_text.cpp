#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "importers/radiance/material_text.h"
#include "materials/bright_colours.h"
#include "materials/functional.h"
#include "materials/measured/measured_table.h"

#include <algorithm>
#include <fmt/format.h>

namespace lightwell::scene_text {
namespace {

using Numbers = std::vector<double>;

Spectrum colour_at(const Numbers& n, std::size_t first)
{
    return first + 2 < n.size() ? Spectrum{n[first], n[first + 1], n[first + 2]} : Spectrum{};
}

/// Functions may ask for more numbers than the material itself has.
void expect_at_least(const Numbers& n, std::size_t least, const std::string& place, const char* meaning)
{
    if (n.size() < least)
        throw InputError{place, fmt::format("{} numbers, expected at least {}", n.size(), least),
                         fmt::format("the first are {}", meaning)};
}

Material brushed_of(const Primitive& p, const PatternReader::MaterialWords& words, const std::string& place)
{
    const bool trans = p.type == "trans2";
    expect_at_least(p.numbers, trans ? 8 : 6, place,
                    "red green blue specularity roughness along roughness across, of trans2 also transmission and "
                    "transmitted specular share");
    const Numbers& n = p.numbers;
    const auto kind = p.type == "plastic2" ? Brushed::Kind::plastic
                      : p.type == "metal2" ? Brushed::Kind::metal
                                           : Brushed::Kind::trans;
    return Brushed{kind, colour_at(n, 0), n[3], n[4], n[5], trans ? n[6] : 0, trans ? n[7] : 0, {words.functions, {}}};
}

Material by_functions(const Primitive& p, const PatternReader::MaterialWords& words, const std::string& place,
                      Report& report)
{
    constexpr std::string_view kinds[] = {"plasfunc", "metfunc",   "transfunc", "plasdata",
                                          "metdata",  "transdata", "BRTDfunc"};
    Functional made;
    made.kind =
        static_cast<Functional::Kind>(std::find(std::begin(kinds), std::end(kinds), p.type) - std::begin(kinds));
    made.function = words.functions;
    const Numbers& n = p.numbers;
    if (made.kind == Functional::Kind::BRTDfunc) {
        expect_at_least(n, 9, place, "diffuse reflectance of the front, of the back, and diffuse transmittance");
        made.front = colour_at(n, 0);
        made.back = colour_at(n, 3);
        made.through = colour_at(n, 6);
    } else {
        const bool trans = p.type.starts_with("trans");
        expect_at_least(n, trans ? 6 : 4, place,
                        "red green blue specularity, of transfunc and transdata also transmission and transmitted "
                        "specular share");
        made.colour = colour_at(n, 0);
        made.specularity = n[3];
        made.transmission = trans ? n[4] : 0;
        made.transmitted_specular = trans ? n[5] : 0;
    }
    validate_patterned_material(made, place); // the colour may be under a pattern, which the caller knows
    made.scale = bounded_scale(made);
    if (made.scale < 1)
        report.add(
            Finding::approximated, place,
            fmt::format("its functions send back more light than they get; they are multiplied by {:.3g}", made.scale));
    return made;
}

Material measured_of(const Primitive& p, const PatternReader::MaterialWords& words, const std::string& place,
                     Report& report)
{
    const Numbers& n = p.numbers;
    if (n.size() % 3 != 0 || n.size() > 9)
        throw InputError{place, fmt::format("{} numbers, expected 0, 3, 6 or 9", n.size()),
                         "they are added diffuse reflectance of the front, of the back, and diffuse transmittance"};
    Measured made;
    made.passes_straight = p.type == "aBSDF";
    made.front = colour_at(n, 0);
    made.back = colour_at(n, 3);
    made.through = colour_at(n, 6);
    made.file = words.table->string();
    made.table = MeasuredTable::read(*words.table);
    made.up.function = words.functions;
    if (made.table->scaled_by() < 1)
        report.add(Finding::approximated, place,
                   fmt::format("{} sends back more light than it gets; its values are multiplied by {:.4g}", made.file,
                               made.table->scaled_by()));
    return made;
}

Material wgmd_of(const Primitive& p, const PatternReader::MaterialWords& words, const std::string& place)
{
    expect_at_least(p.numbers, 9, place, "diffuse reflectance of the front, of the back, and diffuse transmittance");
    Wgmd made;
    for (std::size_t i = 0; i < std::size(made.tints); ++i)
        made.tints[i] = words.names[i] == "void" ? "" : decoded_name(words.names[i]);
    made.front = colour_at(p.numbers, 0);
    made.back = colour_at(p.numbers, 3);
    made.through = colour_at(p.numbers, 6);
    made.grain.function = words.functions;
    return made;
}

} // namespace

Material functional_material_of(const Primitive& primitive, const PatternReader::MaterialWords& words,
                                const std::string& place, Report& report)
{
    if (primitive.type == "prism1" || primitive.type == "prism2")
        return Prism{primitive.type == "prism2" ? 2 : 1, words.functions, {}};
    if (primitive.type == "ashik2") {
        expect_at_least(primitive.numbers, 8, place,
                        "diffuse reflectance red green blue, specular reflectance red green blue, two powers");
        const Numbers& n = primitive.numbers;
        return Ashikhmin{colour_at(n, 0), colour_at(n, 3), n[6], n[7], {words.functions, {}}};
    }
    if (primitive.type == "BSDF" || primitive.type == "aBSDF")
        return measured_of(primitive, words, place, report);
    if (primitive.type == "WGMDfunc")
        return wgmd_of(primitive, words, place);
    if (primitive.type.ends_with('2'))
        return brushed_of(primitive, words, place);
    return by_functions(primitive, words, place, report);
}

} // namespace lightwell::scene_text
