#include "importers/radiance/material_text.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "importers/radiance/modifier_table.h"
#include "importers/radiance/transform_words.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace lightwell::scene_text {
namespace {

constexpr std::string_view surface_types[] = {"polygon", "sphere", "bubble", "cone", "cup",      "cylinder",
                                              "tube",    "ring",   "source", "mesh", "instance", "subdivision"};
constexpr std::string_view material_types[] = {
    "plastic",   "metal",     "trans",    "dielectric", "glass",     "mirror", "light",    "illum",
    "glow",      "spotlight", "plastic2", "metal2",     "trans2",    "ashik2", "plasfunc", "metfunc",
    "transfunc", "plasdata",  "metdata",  "transdata",  "BRTDfunc",  "BSDF",   "aBSDF",    "WGMDfunc",
    "interface", "mist",      "prism1",   "prism2",     "antimatter"};
constexpr std::string_view pattern_types[] = {"brightfunc", "brightdata", "brighttext", "colorfunc",
                                              "colordata",  "colorpict",  "colortext",  "spectrum",
                                              "specfile",   "specfunc",   "specdata",   "specpict"};
constexpr std::string_view texture_types[] = {"texfunc", "texdata", "texpict"};
constexpr std::string_view mixture_types[] = {"mixfunc", "mixdata", "mixtext", "mixpict"};

template <std::size_t N>
bool contains(const std::string_view (&list)[N], std::string_view type) noexcept
{
    return std::find(std::begin(list), std::end(list), type) != std::end(list);
}

void expect_numbers(const Primitive& primitive, const std::string& place, std::size_t least, std::size_t most,
                    const char* meaning)
{
    const std::size_t found = primitive.numbers.size();
    if (found < least || found > most)
        throw InputError{place,
                         fmt::format("{} numbers, expected {}", found,
                                     least == most ? fmt::format("{}", least) : fmt::format("{} or {}", least, most)),
                         fmt::format("they are {}", meaning)};
}

Spectrum colour(const Primitive& primitive)
{
    return {primitive.numbers[0], primitive.numbers[1], primitive.numbers[2]};
}

Material reflector_of(const Primitive& p, const std::string& place)
{
    const char* const surface = "red green blue specularity roughness";
    const auto& n = p.numbers;
    if (p.type == "plastic" || p.type == "metal") {
        expect_numbers(p, place, 5, 5, surface);
        if (p.type == "plastic")
            return Plastic{colour(p), n[3], n[4]};
        return Metal{colour(p), n[3], n[4]};
    }
    if (p.type == "trans") {
        expect_numbers(p, place, 7, 7, "red green blue specularity roughness transmission transmitted-specular");
        return Trans{colour(p), n[3], n[4], n[5], n[6]};
    }
    if (p.type == "dielectric") {
        expect_numbers(p, place, 5, 5, "transmission per metre red green blue, refractive index, Hartmann's constant");
        return Dielectric{colour(p), n[3], n[4]};
    }
    expect_numbers(p, place, 3, 4, "transmissivity red green blue, and the refractive index if it is not 1.52");
    return Glass{colour(p), n.size() == 4 ? n[3] : Glass{}.index};
}

Material emitter_of(const Primitive& p, const std::string& place)
{
    const char* const radiance = "red green blue radiance in W/(m^2 sr)";
    const auto& n = p.numbers;
    if (p.type == "glow") {
        expect_numbers(p, place, 4, 4, "red green blue radiance in W/(m^2 sr), greatest distance as a source");
        return Glow{colour(p), n[3]};
    }
    if (p.type == "spotlight") {
        expect_numbers(p, place, 7, 7, "red green blue radiance, full angle in degrees, x y z of the beam");
        return Spotlight{colour(p), n[3], {n[4], n[5], n[6]}};
    }
    expect_numbers(p, place, 3, 3, radiance);
    if (p.type == "light")
        return Light{colour(p)};
    std::string alternate = p.words.empty() ? "" : decoded_name(p.words[0]);
    return Illum{colour(p), alternate == "void" ? "" : std::move(alternate)};
}

/// What lies between surfaces, or takes them away.
Material volume_of(const Primitive& p, const std::string& place)
{
    const auto& n = p.numbers;
    if (p.type == "interface") {
        expect_numbers(p, place, 8, 8,
                       "transmission per metre red green blue and refractive index, inside, then outside");
        return Interface{colour(p), n[3], {n[4], n[5], n[6]}, n[7]};
    }
    if (p.type == "antimatter") {
        Antimatter erased;
        for (const std::string_view word : p.words)
            erased.erased.push_back(decoded_name(word));
        return erased;
    }
    if (n.size() != 0 && n.size() != 3 && n.size() != 6 && n.size() != 7)
        throw InputError{place, fmt::format("{} numbers, expected 0, 3, 6 or 7", n.size()),
                         "they are extinction per metre red green blue, albedo red green blue, eccentricity"};
    Mist mist;
    if (n.size() >= 3)
        mist.extinction_per_m = colour(p);
    if (n.size() >= 6)
        mist.albedo = {n[3], n[4], n[5]};
    if (n.size() == 7)
        mist.eccentricity = n[6];
    for (const std::string_view word : p.words)
        mist.sources.emplace_back(word);
    return mist;
}

/// Turned about z as the transform words behind the function's file say.
void turn_sky(SkyBrightness& sky, const Primitive& primitive, const std::string& place)
{
    const std::vector<std::string> words(primitive.words.begin() + 2, primitive.words.end());
    std::size_t next = 0;
    const std::vector<Placement> placements = read_placements(words, next, place);
    if (next != words.size() || placements.size() != 1)
        throw InputError{place, "the words after skybright.cal are no single transform", "turn it with -rz only"};
    sky = turned(sky, placements.front().map, place);
}

void append_numbers(std::string& text, std::initializer_list<double> numbers)
{
    text += std::to_string(numbers.size());
    for (const double number : numbers) {
        text += ' ';
        text += shortest(number);
    }
    text += '\n';
}

void append_head(std::string& text, const std::string& modifier, std::string_view type, const std::string& name)
{
    text.append(modifier).append(" ").append(type).append(" ").append(name).append("\n");
}

/// One overload a material: everything after the head.
struct ArgumentWriter {
    std::string& text;

    void list(std::initializer_list<double> numbers, const std::string& word = {}) const
    {
        text += word.empty() ? "0\n0\n" : "1 " + word + "\n0\n";
        append_numbers(text, numbers);
    }
    void operator()(const Plastic& m) const { list({m.colour.r, m.colour.g, m.colour.b, m.specularity, m.roughness}); }
    void operator()(const Metal& m) const { list({m.colour.r, m.colour.g, m.colour.b, m.specularity, m.roughness}); }
    void operator()(const Trans& m) const
    {
        list({m.colour.r, m.colour.g, m.colour.b, m.specularity, m.roughness, m.transmission, m.transmitted_specular});
    }
    void operator()(const Dielectric& m) const
    {
        list({m.transmission_per_m.r, m.transmission_per_m.g, m.transmission_per_m.b, m.index, m.hartmann});
    }
    void operator()(const Glass& m) const
    {
        if (m.index == Glass{}.index)
            list({m.transmissivity.r, m.transmissivity.g, m.transmissivity.b});
        else
            list({m.transmissivity.r, m.transmissivity.g, m.transmissivity.b, m.index});
    }
    void operator()(const Mirror& m) const
    {
        list({m.reflectance.r, m.reflectance.g, m.reflectance.b}, m.alternate.empty() ? "" : encoded_name(m.alternate));
    }
    void operator()(const Interface& m) const
    {
        const Spectrum &in = m.inner_transmission_per_m, &out = m.outer_transmission_per_m;
        list({in.r, in.g, in.b, m.inner_index, out.r, out.g, out.b, m.outer_index});
    }
    void words(const std::vector<std::string>& all) const
    {
        text += std::to_string(all.size());
        for (const std::string& word : all)
            text += ' ' + encoded_name(word);
        text += "\n0\n";
    }
    void operator()(const Antimatter& m) const
    {
        words(m.erased);
        text += "0\n";
    }
    void operator()(const Mist& m) const
    {
        words(m.sources);
        const Spectrum &e = m.extinction_per_m, &a = m.albedo;
        append_numbers(text, {e.r, e.g, e.b, a.r, a.g, a.b, m.eccentricity});
    }
    /// Those with functions are written as they were read, by append_functions().
    template <class WithFunctions>
    void operator()(const WithFunctions&) const
    {
    }
    void operator()(const Light& m) const { list({m.radiance.r, m.radiance.g, m.radiance.b}); }
    void operator()(const Illum& m) const
    {
        list({m.radiance.r, m.radiance.g, m.radiance.b}, m.alternate.empty() ? "" : encoded_name(m.alternate));
    }
    void operator()(const Glow& m) const { list({m.radiance.r, m.radiance.g, m.radiance.b, m.max_radius_m}); }
    void operator()(const Spotlight& m) const
    {
        list({m.radiance.r, m.radiance.g, m.radiance.b, m.full_angle_deg, m.aim.x, m.aim.y, m.aim.z});
    }
};

} // namespace

TypeClass classify(std::string_view type) noexcept
{
    if (contains(surface_types, type))
        return TypeClass::surface;
    if (contains(material_types, type))
        return TypeClass::material;
    if (contains(pattern_types, type))
        return TypeClass::pattern;
    if (contains(texture_types, type))
        return TypeClass::texture;
    if (contains(mixture_types, type))
        return TypeClass::mixture;
    return type == "alias" ? TypeClass::alias : TypeClass::unknown;
}

Material material_of(const Primitive& primitive, const std::string& place)
{
    if (primitive.type == "mirror") {
        expect_numbers(primitive, place, 3, 3, "red green blue reflectance");
        return Mirror{colour(primitive), primitive.words.empty() ? "" : decoded_name(primitive.words[0])};
    }
    for (const std::string_view type : {"light", "illum", "glow", "spotlight"})
        if (primitive.type == type)
            return emitter_of(primitive, place);
    for (const std::string_view type : {"interface", "antimatter", "mist"})
        if (primitive.type == type)
            return volume_of(primitive, place);
    return reflector_of(primitive, place);
}

std::optional<SkyBrightness> sky_brightness_of(const Primitive& primitive, const std::string& place)
{
    const auto& words = primitive.words;
    if (primitive.type != "brightfunc" || words.size() < 2 || words[0] != "skybr" || words[1] != "skybright.cal")
        return std::nullopt;
    const auto& n = primitive.numbers;
    const char* const meaning =
        "they are 1 clear, 2 overcast, 3 uniform or 4 intermediate; zenith; ground; for 1 and 4 also "
        "normalization and x y z of the sun";
    const double kind = n.empty() ? 0 : n[0];
    const bool with_sun = kind == 1 || kind == 4;
    if (!(with_sun || kind == 2 || kind == 3) || n.size() < (with_sun ? 7u : 3u) || n.size() > 7)
        throw InputError{place, fmt::format("{} numbers, the first {}, are no sky", n.size(), kind), meaning};
    SkyBrightness sky;
    sky.kind = static_cast<SkyBrightness::Kind>(static_cast<int>(kind));
    sky.zenith = n[1];
    sky.ground = n[2];
    sky.normalization = n.size() > 3 ? n[3] : 1;
    if (n.size() == 7)
        sky.to_sun = normalized({n[4], n[5], n[6]});
    if (!(sky.zenith >= 0) || !(sky.ground >= 0) || (with_sun && !(sky.normalization > 0)) || length(sky.to_sun) == 0)
        throw InputError{place, "a brightness is negative, or the sun has no direction", meaning};
    turn_sky(sky, primitive, place);
    return sky;
}

void append_material(std::string& text, const std::string& modifier, const std::string& name, const Material& material)
{
    append_head(text, modifier, type_name(material), name);
    std::visit(ArgumentWriter{text}, material);
}

void append_sky_brightness(std::string& text, const std::string& modifier, const std::string& name,
                           const SkyBrightness& sky)
{
    if (sky.sharp_horizon)
        text += sharp_horizon_comment + '\n';
    append_head(text, modifier, "brightfunc", name);
    text += "2 skybr skybright.cal\n0\n";
    const Direction& sun = sky.to_sun;
    append_numbers(text,
                   {static_cast<double>(sky.kind), sky.zenith, sky.ground, sky.normalization, sun.x, sun.y, sun.z});
}

namespace {

/// Letters have no transform among their words: their corner and their two vectors are moved.
std::vector<double> moved_letters(std::vector<double> numbers, const Affine& map)
{
    const auto put = [&](std::size_t at, const Vec3& v) {
        for (int axis = 0; axis < 3; ++axis)
            numbers[at + static_cast<std::size_t>(axis)] = v[axis];
    };
    const auto get = [&](std::size_t at) { return Vec3{numbers[at], numbers[at + 1], numbers[at + 2]}; };
    put(0, map.point(get(0)));
    put(3, map.vector(get(3)));
    put(6, map.vector(get(6)));
    return numbers;
}

std::string quoted(const std::string& word)
{
    if (!word.empty() && word.find_first_of(" \t\n\"'") == std::string::npos)
        return word;
    const char quote = word.find('"') == std::string::npos ? '"' : '\'';
    return quote + word + quote;
}

} // namespace

namespace {

/// The words, with files where they were found and the transform as it is now; then the numbers.
bool append_read(std::string& text, const PatternText& read, const std::vector<std::string>& first, const Affine& map,
                 const FileWords& file_words)
{
    const bool letters = read.type.ends_with("text");
    std::vector<std::string> words = read.words;
    for (const auto& [at, path] : read.files)
        words[at] = file_words.found(path);
    for (const auto& [at, contents] : read.made)
        words[at] = file_words.made(contents);
    words.insert(words.begin(), first.begin(), first.end());
    const auto transform = letters ? std::optional<std::vector<std::string>>(std::in_place) : words_of(map);
    if (transform)
        words.insert(words.end(), transform->begin(), transform->end());
    text += std::to_string(words.size());
    for (const std::string& word : words)
        text += ' ' + quoted(word);
    const std::vector<double> numbers = letters ? moved_letters(read.numbers, map) : read.numbers;
    text += "\n0\n" + std::to_string(numbers.size());
    for (const double number : numbers)
        text += ' ' + shortest(number);
    text += '\n';
    return transform.has_value();
}

} // namespace

bool append_functions(std::string& text, const std::string& modifier, const std::string& name,
                      const PlaceProgram& functions, const FileWords& file_words)
{
    append_head(text, modifier, functions.text().type, name);
    return append_read(text, functions.text(), {}, functions.to_scene(), file_words);
}

bool append_varying(std::string& text, const std::string& modifier, const std::string& name,
                    const PlaceFunction& function, const std::vector<std::string>& mixed, const FileWords& file_words)
{
    append_head(text, modifier, function.text().type, name);
    return append_read(text, function.text(), mixed, function.to_scene(), file_words);
}

} // namespace lightwell::scene_text
