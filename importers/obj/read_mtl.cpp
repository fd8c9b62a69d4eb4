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
    } else if (word == "illum") {
        if (const std::optional<double> model = number(word, rest); model && *model >= 0 && *model <= 10)
            material.illum = static_cast<int>(*model);
    } else if (word.substr(0, 4) == "map_" || word == "refl" || word == "bump" || word == "disp" || word == "decal" ||
               word == "norm") {
        note(Finding::unsupported,
             "texture " + quoted(word) + " is not modelled yet; the plain value beside it is used");
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
    const std::string_view whole = rest;
    const std::optional<double> r = parse_double(next_word(rest));
    if (!r || !std::isfinite(*r)) {
        const bool known = trimmed(whole).substr(0, 8) == "spectral" || trimmed(whole).substr(0, 3) == "xyz";
        note(known ? Finding::unsupported : Finding::ignored,
             quoted(word) + " is not three numbers; the material does without it");
        return {};
    }
    const std::optional<double> g = parse_double(next_word(rest)), b = parse_double(next_word(rest));
    const Spectrum found{*r, g.value_or(*r), b.value_or(g.value_or(*r))}; // one number stands for all three
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
