#pragma once

#include "engine/base/report.h"
#include "engine/base/spectrum.h"
#include "engine/scene/scene.h"
#include "importers/file_texture.h"

#include <filesystem>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace lightwell {

/// What a layer map can ask about a surface. Surfaces with equal keys share one modifier of the imported scene.
struct SurfaceKey {
    std::string layer;              ///< what the user knows as the layer (see each importer's README); never empty
    std::string group;              ///< OBJ group, glTF node path
    std::string block;              ///< DXF block, glTF mesh; empty outside blocks
    std::string material;           ///< the file's material name
    std::string entity;             ///< DXF entity type, "mesh", "face"
    std::optional<Spectrum> colour; ///< the file's colour, linear Rec.709
};

/// A copy of a block that draws no surface, a symbol: it may stand for a luminaire.
struct BareInsert {
    SurfaceKey key; ///< its layer and block
    Affine to_scene;
    std::string name;
};

/// A file read into surfaces, before materials are chosen.
struct Imported {
    Scene scene;                  ///< metres, z up
    std::vector<SurfaceKey> keys; ///< keys[i] belongs to scene.modifiers[i], an Alias without target (or Inherited)
    /// Materials that the file itself describes (MTL, glTF), by the file's name, to be used when no rule matches.
    std::vector<std::pair<std::string, Material>> file_materials;
    /// Pictures of those materials; their means are in the materials already.
    std::vector<FileTexture> file_textures;
    std::string unit; ///< as reported: "mm (from $INSUNITS)", "m (glTF)", ...
    Ledger ledger;    ///< entities read = made + skipped
    /// Entities made into surfaces of keys[i]; for keys beyond its end there is one entity for each surface name. Only
    /// formats that gather many entities in one mesh need it, so that the ledger stays right when a layer is dropped.
    std::vector<std::size_t> made_with_key;
    std::vector<BareInsert> bare_inserts;
    Direction up_in_parts{0, 0, 1}; ///< as parts draw what stands upright, before instances place them
    Report report;
};

/// Outlines of a plan that are raised to walls.
struct RaisedLayer {
    std::string layer; ///< pattern, as in a layer map
    double height_m;   ///< > 0
};

/// "A-WALL=2.8", "*WALL*=2800mm", "Mur=9 ft": a pattern of layer names and a height, in metres unless it has a unit.
/// @param place  option or file and line, for the message
/// @throws InputError without a layer, or unless the height is a number above 0
RaisedLayer parse_raised_layer(const std::string& words, const std::string& place);

/// How to read what a file does not say.
struct ImportOptions {
    std::optional<double> metres_per_unit;       ///< overrides what the file says
    std::string up;                              ///< "", "y" or "z": overrides the format's rule
    bool keep_triangles = false;                 ///< triangles of one flat face stay triangles
    std::optional<double> crease_angle_deg = {}; ///< curved meshes without normals get them across edges bent less
    double chord_tolerance_m = 0.0005;    ///< for curves that have no exact surface (ellipses, arcs bent into walls)
    std::vector<RaisedLayer> raised = {}; ///< DXF: the last rule that fits a layer counts
};

/// Collects keys: one modifier for each distinct key.
class KeyTable {
public:
    explicit KeyTable(Imported& imported) : imported_(imported) {}
    ModifierId modifier_for(const SurfaceKey& key);
    /// The place-holder that prototypes use for what instances decide, e.g. DXF layer 0 inside a block.
    ModifierId inherited(const SurfaceKey& key);

private:
    ModifierId find_or_add(const SurfaceKey& key, bool inherited);
    Imported& imported_;
    std::unordered_map<std::string, ModifierId> known_;
};

/// True when the content (not only the name) looks like the importer's format.
bool recognize_dxf(const std::filesystem::path& file);
bool recognize_obj(const std::filesystem::path& file);
bool recognize_gltf(const std::filesystem::path& file);
/// FBX, Collada, 3DS, PLY, STL, X3D, OFF, IFC; also STEP, IGES, USD and VRML, which import_assimp refuses by name.
bool recognize_assimp(const std::filesystem::path& file);

/// @throws InputError: unreadable, truncated or malformed beyond use
Imported import_dxf(const std::filesystem::path& file, const ImportOptions& options);
Imported import_obj(const std::filesystem::path& file, const ImportOptions& options);
Imported import_gltf(const std::filesystem::path& file, const ImportOptions& options);
Imported import_assimp(const std::filesystem::path& file, const ImportOptions& options);

} // namespace lightwell
