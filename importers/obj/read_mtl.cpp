#include "engine/base/text.h"
#include "importers/obj/mtl.h"
#include "importers/obj/obj_lines.h"

#include <cmath>

namespace lightwell {
namespace {

std::string quoted(std::string_view word)
{
    return std::string("`").append(word.substr(0, 20)).append("`");
}

bool is_texture(std::string_view word)
{
    return word.substr(0, 4) == "map_" || word == "refl" || word == "bump" || word == "disp" || word == "decal" ||
           word == "norm";
}

/// Linear Rec.709 of CIE XYZ.  Source  IEC 61966-2-1, inverse of the matrix of its primaries and white
Spectrum rec709_of_xyz(double x, double y, double z)
{
    return {3.2406 * x - 1.5372 * y - 0.4986 * z, -0.9689 * x + 1.8758 * y + 0.0415 * z,
            0.0557 * x - 0.2040 * y + 1.0570 * z};
}

/// Reads the statements of one library in order.
class MtlReader {
public:
    MtlReader(std::string_view text, const std::string& name, Report& report)
        : lines_(text), name_(name), report_(report)
    {
    }
    std::vector<MtlMaterial> read();

private:
    void statement(std::string_view word, std::string_view rest);
    std::optional<double> number(std::string_view word, std::string_view rest);
    std::optional<Spectrum> colour(std::string_view word, std::string_view rest);
    void note(Finding finding, const std::string& text) { report_.add(finding, place(), text); }
    std::string place() const { return name_ + ":" + std::to_string(lines_.number()); }

    ObjLines lines_;
    std::string name_;
    Report& report_;
    std::vector<MtlMaterial> materials_;
};

std::vector<MtlMaterial> MtlReader::read()
{
    std::string_view line;
    while (lines_.next(line)) {
        std::string_view rest = line;
        const std::string_view word = next_word(rest);
        if (word.empty())
            continue;
        if (word == "newmtl") {
            materials_.emplace_back();
            materials_.back().name = to_utf8(name_in(rest));
            materials_.back().line = lines_.number();
        } else if (!materials_.empty()) {
            statement(word, rest);
        } else {
            note(Finding::ignored, "statement before the first `newmtl`");
        }
    }
    return std::move(materials_);
}

void MtlReader::statement(std::string_view word, std::string_view rest)
{
    MtlMaterial& material = materials_.back();
    if (word == "Kd") {
        material.diffuse = colour(word, rest);
    } else if (word == "Ks") {
        material.specular = colour(word, rest);
    } else if (word == "Ke") {
        material.emission = colour(word, rest);
    } else if (word == "Tf") {
        material.filter = colour(word, rest);
    } else if (word == "Ns") {
        material.exponent = number(word, rest);
    } else if (word == "Ni") {
        material.index = number(word, rest);
    } else if (word == "d") {
        material.dissolve = number(word, rest);
    } else if (word == "Tr") {
        if (const std::optional<double> transparency = number(word, rest); transparency && !material.dissolve)
            material.dissolve = 1 - *transparency;
    } else if (word == "Pr") {
        material.roughness = number(word, rest);
    } else if (word == "Pm") {
        material.metallic = number(word, rest);
    } else if (word == "Ps") {
        material.sheen = colour(word, rest);
    } else if (word == "Pc") {
        material.coat = number(word, rest);
    } else if (word == "Pcr") {
        material.coat_roughness = number(word, rest);
    } else if (word == "aniso") {
        material.anisotropy = number(word, rest);
    } else if (word == "illum") {
        if (const std::optional<double> model = number(word, rest); model && *model >= 0 && *model <= 10)
            material.illum = static_cast<int>(*model);
    } else if (is_texture(word)) {
        material.textures.push_back(read_texture_statement(word, rest, place(), report_));
        material.textures.back().line = lines_.number();
    } else if (word != "Ka" && word != "sharpness" && word != "anisor") { // light that is everywhere, and reflections
        note(Finding::ignored, "unknown statement " + quoted(word));
    }
}

std::optional<double> MtlReader::number(std::string_view word, std::string_view rest)
{
    std::string_view token = next_word(rest);
    if (token == "-halo")
        token = next_word(rest);
    const std::optional<double> value = parse_double(token);
    if (value && std::isfinite(*value))
        return value;
    note(Finding::ignored, quoted(word) + " is not a number; the material does without it");
    return {};
}

std::optional<Spectrum> MtlReader::colour(std::string_view word, std::string_view rest)
{
    std::string_view ahead = rest;
    const std::string_view kind = next_word(ahead);
    if (kind == "spectral") {
        note(Finding::unsupported, quoted(word) + " names a spectral curve; the material does without it");
        return {};
    }
    const bool is_xyz = kind == "xyz";
    if (is_xyz)
        rest = ahead;
    const std::optional<double> first = parse_double(next_word(rest));
    const std::optional<double> second = parse_double(next_word(rest)), third = parse_double(next_word(rest));
    if (!first) {
        note(Finding::ignored, quoted(word) + " is not three numbers; the material does without it");
        return {};
    }
    // One number stands for all three.
    const Spectrum numbers{*first, second.value_or(*first), third.value_or(second.value_or(*first))};
    const Spectrum found = is_xyz ? rec709_of_xyz(numbers.r, numbers.g, numbers.b) : numbers;
    if (found.is_finite())
        return found;
    note(Finding::ignored, quoted(word) + " is not finite; the material does without it");
    return {};
}

} // namespace

std::vector<MtlMaterial> read_mtl(std::string_view text, const std::string& name, Report& report)
{
    if (text.substr(0, 3) == "\xef\xbb\xbf")
        text.remove_prefix(3);
    return MtlReader(text, name, report).read();
}

} // namespace lightwell
