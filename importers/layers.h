#pragma once

#include "engine/base/vector.h"
#include "importers/importer.h"
#include "materials/photometry.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace lightwell {

enum class EmissionSide { both, front, back };

/// `LOW..HIGH`, both ends included; either may be missing.
struct NumberRange {
    double low = -infinity, high = infinity;
    bool holds(double number) const { return number >= low && number <= high; }
    bool operator==(const NumberRange&) const = default;
};

/// One [[rule]] of a layer map: every word given must match (globs, ranges A..B; colour as #rrggbb).
struct LayerRule {
    std::string layer, group, block, material, entity, colour;
    NumberRange area_m2, size_m; ///< of one surface as its block draws it; size: the longest side of its box
    std::string use;             ///< material name of the library or the file, or "void"; empty: a luminaire alone
    EmissionSide side = EmissionSide::both;
    std::filesystem::path luminaire;              ///< IES or EULUMDAT file; empty: none
    std::shared_ptr<const Photometry> photometry; ///< what it holds
    Vec3 aim{};                                   ///< of the light, in the frame of the insert; 0: as the insert has it
    double turn_deg = 0;                          ///< about the upward axis of the luminaire, from plane 0 to plane 90
    int line = 0;
};

/// map.toml: a default and rules; the last rule that matches wins.
struct LayerMap {
    std::filesystem::path file;
    std::string default_material; ///< empty: the file's own material when it has one, else grey_50 with a note
    std::vector<LayerRule> rules;
    Report report; ///< of the luminaires' files
};

/// What a rule decided.
struct RuleHits {
    int line = 0;
    std::string text;         ///< the rule in short: `layer = "A-WALL*" -> white_paint`
    std::size_t surfaces = 0; ///< instances expanded; those that a later rule took over do not count. Without
                              ///< a material: luminaires
    double area_m2 = 0;
};

/// @throws InputError with file and line: TOML errors, unknown words, unknown side
LayerMap read_layer_map(const std::filesystem::path& file);

/// Gives every surface key a material: rule, else default, else the file's own, else `grey_50` with a note.
/// `void` drops surfaces (counted in the ledger). Layers whose keys end in the same material become one modifier
/// named by the layer. Afterwards every modifier of the scene resolves to a material. Of two sheets that draw one
/// glazing unit, both of a material that stands for the whole unit (`glass_double_*`, `glass_triple_*`), one stays.
/// @return what each rule decided, in the order of the map
/// @throws InputError for an unknown material (with the nearest names) or a rule that matches nothing
std::vector<RuleHits> apply_layer_map(Imported& imported, const LayerMap& map);

struct LayerSummary {
    std::string name;
    std::size_t surfaces = 0; ///< instances expanded
    double area_m2 = 0;
    std::string material;      ///< assigned, or proposed when none is
    std::string file_material; ///< what the file itself says: `Plaster (plastic, 62 %)`; empty: nothing
};
/// By layer name, instances expanded.
std::vector<LayerSummary> summarize_layers(const Imported& imported);

/// A material of the library for a layer or material name, by the layer standards (AIA/NCS, ISO 13567, BS 1192) and
/// plain words in six languages; empty when nothing fits.
std::string propose_material(const SurfaceKey& key);
/// A map.toml with one rule a layer, with the number of surfaces and the area as comments.
std::string propose_layer_map(const Imported& imported);
/// The same for a map that exists: its text, untouched, followed by rules for what none of its rules is for. Nothing is
/// added, not a byte, when there is a rule for everything.
/// @param text  of the map's file
std::string extend_layer_map(const Imported& imported, const LayerMap& map, const std::string& text);
/// A material in short, for tables: `plastic, 62 %`, `glass, 88 %`, `light, 4000 cd/m2`.
std::string material_in_short(const Material& material);

} // namespace lightwell
