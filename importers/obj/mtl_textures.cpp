#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "importers/obj/mtl.h"
#include "importers/obj/obj_lines.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

using Use = FileTexture::Use;

/// What a statement's picture stands for.
struct TextureUse {
    std::string_view statement;
    Use use;
};
constexpr TextureUse uses[] = {
    {"map_Kd", Use::colour},   {"map_Ke", Use::emission},     {"map_Ks", Use::highlight},
    {"map_d", Use::opacity},   {"map_opacity", Use::opacity}, {"map_Pr", Use::roughness},
    {"map_Pm", Use::metal},    {"map_Tf", Use::transmission}, {"norm", Use::normal},
    {"map_Kn", Use::normal},   {"map_norm", Use::normal},     {"map_bump", Use::height},
    {"map_Bump", Use::height}, {"bump", Use::height},         {"disp", Use::height},
    {"map_disp", Use::height},
};

Use use_of(std::string_view statement)
{
    for (const TextureUse& known : uses)
        if (known.statement == statement)
            return known.use;
    return Use::other;
}

/// Up to three numbers at the front of `rest`; those that follow in the line are left in it.
std::vector<double> numbers_in(std::string_view& rest)
{
    std::vector<double> numbers;
    while (numbers.size() < 3) {
        std::string_view ahead = rest;
        const std::optional<double> number = parse_double(next_word(ahead));
        if (!number || !std::isfinite(*number))
            break;
        numbers.push_back(*number);
        rest = ahead;
    }
    return numbers;
}

/// @return false when the format has no such option
bool take_option(std::string_view option, std::string_view& rest, MtlTexture& texture)
{
    if (option == "-blendu" || option == "-blendv" || option == "-cc" || option == "-type" || option == "-texres" ||
        option == "-boost") { // none of them changes a mean
        next_word(rest);
    } else if (option == "-bm") {
        texture.bend = parse_double(next_word(rest)).value_or(1);
    } else if (option == "-clamp") {
        texture.placement.repeats = next_word(rest) != "on";
    } else if (option == "-imfchan") {
        const std::string_view channel = next_word(rest);
        texture.channel = channel.empty() ? texture.channel : channel[0];
    } else if (option == "-mm") {
        texture.base = parse_double(next_word(rest)).value_or(0);
        texture.gain = parse_double(next_word(rest)).value_or(1);
    } else if (option == "-o" || option == "-s") {
        const std::vector<double> numbers = numbers_in(rest);
        const bool shifts = option == "-o";
        std::array<double, 6>& m = texture.placement.to_picture;
        for (std::size_t i = 0; i < std::min<std::size_t>(numbers.size(), 2); ++i)
            m[shifts ? 3 * i + 2 : 4 * i] = numbers[i];
    } else if (option == "-t") {
        numbers_in(rest);
    } else {
        return false;
    }
    return true;
}

double clamped(double value) noexcept
{
    return value >= 0 ? std::min(value, 1.0) : 0;
}

/// The one number that a picture of data means.
double scalar_mean(const PictureMeans& means, const MtlTexture& texture)
{
    const bool by_opacity = texture.channel == 'm' || (use_of(texture.statement) == Use::opacity && means.opacity < 1);
    const double mean = by_opacity               ? means.opacity
                        : texture.channel == 'r' ? means.plain.r
                        : texture.channel == 'g' ? means.plain.g
                        : texture.channel == 'b' ? means.plain.b
                                                 : photopic(means.plain);
    return clamped(texture.base + texture.gain * mean);
}

Spectrum colour_mean(const PictureMeans& means, const MtlTexture& texture)
{
    const auto value = [&](double mean) { return clamped(texture.base + texture.gain * mean); };
    return {value(means.colour.r), value(means.colour.g), value(means.colour.b)};
}

/// A picture multiplies the plain value; programs that leave that at 0 beside a picture mean the picture alone.
void multiply(std::optional<Spectrum>& value, const Spectrum& mean)
{
    value = value && value->max() > 0 ? *value * mean : mean;
}
void multiply(std::optional<double>& value, double mean)
{
    value = value && *value > 0 ? *value * mean : mean;
}

std::string two_digits(double value)
{
    return shortest(std::round(1000 * value) / 1000);
}

/// Changes the material's value by the mean.  @return the mean as text; empty when the picture changes no value
std::string take_mean(const PictureMeans& means, const MtlTexture& texture, MtlMaterial& mtl)
{
    const Spectrum colour = colour_mean(means, texture);
    const double scalar = scalar_mean(means, texture);
    switch (use_of(texture.statement)) {
    case Use::colour:
        multiply(mtl.diffuse, colour);
        break;
    case Use::emission:
        multiply(mtl.emission, colour);
        break;
    case Use::highlight:
        multiply(mtl.specular, colour);
        break;
    case Use::transmission:
        multiply(mtl.filter, colour);
        break;
    case Use::opacity:
        multiply(mtl.dissolve, scalar);
        return two_digits(scalar);
    case Use::roughness:
        multiply(mtl.roughness, scalar);
        return two_digits(scalar);
    case Use::metal:
        multiply(mtl.metallic, scalar);
        return two_digits(scalar);
    default:
        return {};
    }
    return two_digits(colour.r) + " " + two_digits(colour.g) + " " + two_digits(colour.b);
}

bool same_letters(const std::string& a, const std::string& b)
{
    return lowercase_ascii(a) == lowercase_ascii(b);
}

} // namespace

std::optional<std::filesystem::path> find_beside(std::string written, const std::filesystem::path& folder)
{
    std::replace(written.begin(), written.end(), '\\', '/');
    const std::string name = std::filesystem::path(written).filename().string();
    if (name.empty())
        return {};
    std::error_code none;
    for (const std::filesystem::path& path : {folder / written, folder / name})
        if (std::filesystem::is_regular_file(path, none))
            return path;
    const std::filesystem::path parent = (folder / written).parent_path();
    for (const std::filesystem::path& place : {parent, folder})
        for (std::filesystem::directory_iterator entry(place, none), end; !none && entry != end; entry.increment(none))
            if (same_letters(entry->path().filename().string(), name) && entry->is_regular_file(none))
                return entry->path();
    return {};
}

MtlTexture read_texture_statement(std::string_view statement, std::string_view rest, const std::string& place,
                                  Report& report)
{
    MtlTexture texture;
    texture.statement = statement;
    for (;;) {
        std::string_view ahead = rest;
        const std::string_view option = next_word(ahead);
        if (option.size() < 2 || option[0] != '-')
            break;
        if (!take_option(option, ahead, texture))
            report.add(Finding::ignored, place,
                       "texture option `" + to_utf8(option.substr(0, 20)) + "` is not known to the format");
        rest = ahead;
    }
    texture.file = to_utf8(name_in(rest));
    return texture;
}

const PictureMeans* MtlPictures::means_of(const std::filesystem::path& file, const std::string& place, Report& report)
{
    const auto [entry, fresh] = known_.try_emplace(file);
    if (fresh) {
        FileTexture picture;
        picture.file = file;
        try {
            entry->second = picture_means(picture, file.filename().string());
        } catch (const InputError& error) {
            report.add(Finding::ignored, place, std::string("picture left out: ") + error.what());
        }
    }
    return entry->second ? &*entry->second : nullptr;
}

void MtlPictures::apply_one(const MtlTexture& texture, MtlMaterial& mtl, const std::string& place, Report& report,
                            std::vector<FileTexture>& textures)
{
    const Use use = use_of(texture.statement);
    const std::string what = "`" + texture.statement + "` ";
    if (texture.file.empty())
        return report.add(Finding::ignored, place, what + "names no file");
    const std::optional<std::filesystem::path> file = find_beside(texture.file, folder_);
    if (!file)
        return report.add(Finding::ignored, place,
                          what + "names \"" + texture.file + "\", which is not there; the plain value is used");
    const std::string name = file->filename().string();
    FileTexture found;
    if (use == Use::height || use == Use::other) {
        report.add(Finding::unsupported, place,
                   what + name +
                       (use == Use::other ? ": has no meaning for this material"
                                          : ": heights without a unit bend no normals; the surface stays smooth"));
    } else {
        const PictureMeans* means = means_of(*file, place, report);
        if (!means)
            return;
        const std::string mean = take_mean(*means, texture, mtl);
        if (use != Use::colour && use != Use::normal)
            report.add(Finding::approximated, place,
                       what + name + ": its mean, " + mean + ", stands for the whole picture");
        found.mean = colour_mean(*means, texture);
    }
    found.what = what + name;
    found.as_stored = texture.base == 0 && texture.gain == 1 && texture.channel == 'l';
    found.strength = {texture.bend, texture.bend};
    found.material = mtl.name;
    found.use = use;
    found.file = *file;
    found.placement = texture.placement;
    textures.push_back(std::move(found));
}

void MtlPictures::apply(MtlMaterial& mtl, const std::string& place, Report& report, std::vector<FileTexture>& textures)
{
    for (const MtlTexture& texture : mtl.textures)
        apply_one(texture, mtl, place, report, textures);
}

} // namespace lightwell
