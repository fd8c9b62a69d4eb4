#include "materials/library.h"

#include "engine/base/errors.h"
#include "engine/base/nearest.h"
#include "engine/base/text.h"
#include "engine/base/toml.h"
#include "materials/library_text.h"

#include <cmath>
#include <unordered_map>

namespace lightwell {
namespace {

/// A number that the kind of material cannot do without.
double needed(const TomlTable& entry, const char* word)
{
    const auto value = entry.number(word);
    if (!value)
        throw InputError{entry.place(), std::string("has no ") + word};
    return *value;
}

Spectrum channels(const TomlTable& entry, const char* word)
{
    const std::vector<double> numbers = entry.numbers(word);
    if (numbers.size() != 3)
        throw InputError{entry.place_of(word), std::string(word) + " needs three channels"};
    return {numbers[0], numbers[1], numbers[2]};
}

/// A spectrum of the given luminous mean with the hue of `tint`; grey without one.
Spectrum tinted(const TomlTable& entry, double mean)
{
    if (!entry.has("tint"))
        return Spectrum::grey(mean);
    const Spectrum tint = channels(entry, "tint");
    return tint * (mean / photopic(tint));
}

/// Fraction that is left after one passage inside a pane whose luminous transmittance at normal incidence is known.
/// Source  Radiance reference manual, `glass`: T = (1 - r)^2 t / (1 - r^2 t^2), solved for t, with r of the index
Spectrum transmissivity_of(Spectrum transmittance, double index)
{
    const double r = std::pow((index - 1) / (index + 1), 2), passed = (1 - r) * (1 - r);
    const auto solve = [&](double total) {
        return total > 0 ? (std::sqrt(passed * passed + 4 * r * r * total * total) - passed) / (2 * r * r * total) : 0;
    };
    return {solve(transmittance.r), solve(transmittance.g), solve(transmittance.b)};
}

Material plastic(const TomlTable& entry)
{
    // The stated reflectance holds the highlight; the coloured part is what remains below the coat.
    const double specularity = entry.number("specularity").value_or(0);
    const double below = (needed(entry, "reflectance") - specularity) / (1 - specularity);
    return Plastic{tinted(entry, below), specularity, entry.number("roughness").value_or(0)};
}

Material metal(const TomlTable& entry)
{
    return Metal{tinted(entry, needed(entry, "reflectance")), entry.number("specularity").value_or(0),
                 entry.number("roughness").value_or(0)};
}

Material trans(const TomlTable& entry)
{
    // colour * (1 - specularity) is shared between reflection and transmission.
    const double specularity = entry.number("specularity").value_or(0), passed = needed(entry, "transmittance");
    const double shared = needed(entry, "reflectance") - specularity + passed;
    return Trans{tinted(entry, shared / (1 - specularity)), specularity, entry.number("roughness").value_or(0),
                 shared > 0 ? passed / shared : 0, entry.number("transmitted_specular").value_or(0)};
}

Material glass(const TomlTable& entry)
{
    const double index = entry.number("index").value_or(Glass{}.index);
    return Glass{transmissivity_of(tinted(entry, needed(entry, "transmittance")), index), index};
}

Material dielectric(const TomlTable& entry)
{
    return Dielectric{channels(entry, "transmission_per_m"), needed(entry, "index"), 0};
}

Material mirror(const TomlTable& entry)
{
    return Mirror{tinted(entry, needed(entry, "reflectance"))};
}

Material light(const TomlTable& entry)
{
    return Light{tinted(entry, needed(entry, "luminance") / lumens_per_watt)};
}

Material material_of(const TomlTable& entry)
{
    struct Kind {
        const char* word;
        Material (*make)(const TomlTable&);
    };
    static constexpr Kind kinds[] = {{"plastic", plastic},       {"metal", metal},   {"trans", trans}, {"glass", glass},
                                     {"dielectric", dielectric}, {"mirror", mirror}, {"light", light}};
    const std::string word = entry.text("kind").value_or("");
    for (const Kind& kind : kinds)
        if (word == kind.word)
            return kind.make(entry);
    throw InputError{entry.place_of("kind"), "unknown kind \"" + word + '"'};
}

/// The numbers as the file states them, then where they come from: `reflectance 0.3 (range 0.2 to 0.4): ...`.
std::string source_of(const TomlTable& entry, const TomlTable& sources)
{
    std::string numbers;
    for (const char* word : {"reflectance", "transmittance", "luminance", "index"})
        if (const auto value = entry.number(word))
            numbers += (numbers.empty() ? "" : ", ") + std::string(word) + ' ' + shortest(*value);
    const std::vector<double> range = entry.numbers("range");
    if (range.size() == 2)
        numbers += " (typical; range " + shortest(range[0]) + " to " + shortest(range[1]) + ')';
    std::string text = entry.text("source").value_or("");
    if (text.empty())
        throw InputError{entry.place(), "has no source"};
    std::string meanings;
    for (const std::string_view word : split(text, " ,;:()")) {
        const auto meaning = sources.text(std::string(word));
        if (meaning && meanings.find(*meaning) == std::string::npos)
            meanings += (meanings.empty() ? " [" : " | ") + std::string(word) + " = " + *meaning;
    }
    if (!meanings.empty())
        text += meanings + ']';
    return numbers + (numbers.empty() ? "" : ": ") + text + (entry.has("tint") ? "; hue typical, not measured" : "");
}

std::vector<LibraryMaterial> read_library()
{
    std::vector<LibraryMaterial> library;
    for (const LibraryText& text : library_texts()) {
        const TomlTable file = parse_toml(text.text, std::string("materials/library/") + text.file);
        file.expect_words({"sources", "material"});
        for (const TomlTable* entry : file.tables("material")) {
            entry->expect_words({"name", "kind", "description", "reflectance", "transmittance", "luminance", "range",
                                 "tint", "specularity", "roughness", "transmitted_specular", "transmission_per_m",
                                 "index", "source"});
            library.push_back({entry->text("name").value_or(""), entry->text("description").value_or(""),
                               source_of(*entry, *file.table("sources")), material_of(*entry)});
            validate_material(library.back().material, entry->place() + ": material " + library.back().name);
        }
    }
    return library;
}

} // namespace

const std::vector<LibraryMaterial>& material_library()
{
    static const std::vector<LibraryMaterial> library = read_library();
    return library;
}

const LibraryMaterial* find_in_library(const std::string& name)
{
    static const std::unordered_map<std::string, const LibraryMaterial*> index = [] {
        std::unordered_map<std::string, const LibraryMaterial*> entries;
        for (const LibraryMaterial& material : material_library())
            entries.emplace(material.name, &material);
        return entries;
    }();
    const auto found = index.find(name);
    return found == index.end() ? nullptr : found->second;
}

std::vector<std::string> nearest_names(const std::string& name, std::size_t count)
{
    std::vector<std::string> names;
    for (const LibraryMaterial& material : material_library())
        names.push_back(material.name);
    return nearest(name, names, count);
}

} // namespace lightwell
