#pragma once

#include "importers/importer.h"

#include <filesystem>
#include <string>
#include <vector>

namespace lightwell {

enum class EmissionSide { both, front, back };

/// One [[rule]] of a layer map: every word given must match (globs, ranges A..B; colour as #rrggbb).
struct LayerRule {
    std::string layer, group, block, material, entity, colour;
    std::string use; ///< material name of the library or the file, or "void"
    EmissionSide side = EmissionSide::both;
    int line = 0;
};

/// map.toml: a default and rules; the last rule that matches wins.
struct LayerMap {
    std::filesystem::path file;
    std::string default_material; ///< empty: the file's own material when it has one, else grey_50 with a note
    std::vector<LayerRule> rules;
};

/// @throws InputError with file and line: TOML errors, unknown words, unknown side
LayerMap read_layer_map(const std::filesystem::path& file);

/// Gives every surface key a material: rule, else default, else the file's own, else `grey_50` with a note.
/// `void` drops surfaces (counted in the ledger). Layers whose keys end in the same material become one modifier
/// named by the layer. Afterwards every modifier of the scene resolves to a material.
/// @throws InputError for an unknown material (with the nearest names) or a rule that matches nothing
void apply_layer_map(Imported& imported, const LayerMap& map);

struct LayerSummary {
    std::string name;
    std::size_t surfaces = 0; ///< instances expanded
    double area_m2 = 0;
    std::string material; ///< assigned, or proposed when none is
};
/// By layer name, instances expanded.
std::vector<LayerSummary> summarize_layers(const Imported& imported);

/// A material of the library for a layer or material name, by the layer standards (AIA/NCS, ISO 13567, BS 1192) and
/// plain words in six languages; empty when nothing fits.
std::string propose_material(const SurfaceKey& key);
/// A map.toml with one rule a layer, with the number of surfaces and the area as comments.
std::string propose_layer_map(const Imported& imported);

} // namespace lightwell
