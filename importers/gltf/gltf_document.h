#pragma once

#include "engine/base/files.h"
#include "engine/base/report.h"
#include "engine/base/spectrum.h"
#include "engine/base/transform.h"
#include "importers/file_texture.h"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lightwell {

/// A slice of a buffer, inside its bounds; empty with a fault when the file's numbers lead outside.
struct GltfView {
    std::string_view bytes;
    std::size_t stride = 0; ///< 0: elements follow each other closely
    std::string fault;      ///< why the view cannot be used
};

/// Numbers as the file describes them; checked when they are read (gltf_accessor.h).
struct GltfAccessor {
    int view = -1;
    std::size_t offset = 0, count = 0;
    int component_type = 0; ///< 5120 to 5126
    int components = 0;     ///< 1, 2, 3, 4, 9 or 16; 0 when the type is unknown
    bool normalized = false;
    struct Sparse {
        std::size_t count = 0;
        int index_view = -1, index_type = 0, value_view = -1;
        std::size_t index_offset = 0, value_offset = 0;
    };
    std::optional<Sparse> sparse;
};

/// Geometry packed by Draco: the view with the packed bytes and the ids of the attributes in it.
struct GltfDraco {
    int view = -1;
    std::map<std::string, int> attributes;
};

struct GltfPrimitive {
    int mode = 4; ///< 0 points, 1 to 3 lines, 4 triangles, 5 strip, 6 fan
    int indices = -1, material = -1;
    std::map<std::string, int> attributes;
    std::optional<GltfDraco> draco;
    std::vector<std::map<std::string, int>> targets; ///< accessors of each morph target
};

struct GltfMesh {
    std::string name;
    std::vector<GltfPrimitive> primitives;
    std::vector<double> weights; ///< of the morph targets, at rest
};

struct GltfNode {
    std::string name;
    std::string layer; ///< extras.layer, empty when there is none
    Affine to_parent;
    int mesh = -1, camera = -1, light = -1, skin = -1;
    std::vector<double> weights; ///< of the morph targets; empty: those of the mesh
    std::vector<int> children;
    std::map<std::string, int> instancing; ///< accessors of EXT_mesh_gpu_instancing; empty: one copy
};

/// Bones of a mesh: the nodes and the accessor of the matrices that bring the mesh into their frames.
struct GltfSkin {
    int inverse_bind = -1;
    std::vector<int> joints;
};

/// Where the bytes of a picture are.
struct GltfImage {
    std::string uri; ///< empty: in the view
    int view = -1;
    std::string name;
};

/// A use of a picture by a material.
struct GltfTexture {
    FileTexture::Use use = FileTexture::Use::colour;
    std::string what; ///< name in the file: "baseColorTexture", ...
    int image = -1;   ///< -1: the file names none that is there
    TexturePlacement placement;
    int coordinates = 0; ///< which TEXCOORD of the mesh lays it
    double strength = 1; ///< of a picture of normals
};

/// Factors of a material, linear Rec.709, before the means of its pictures are multiplied with them.
struct GltfMaterial {
    std::string name;
    Spectrum base_colour{1, 1, 1};
    double alpha = 1;
    std::string alpha_mode = "OPAQUE";
    double alpha_cutoff = 0.5;
    bool metal_stated = false; ///< metallicFactor, roughnessFactor or their texture stands in the file
    double metallic = 1, roughness = 1;
    Spectrum emission;                             ///< with KHR_materials_emissive_strength
    double transmission = 0;                       ///< KHR_materials_transmission
    double index = 1.5;                            ///< KHR_materials_ior
    double specular = 1;                           ///< KHR_materials_specular
    Spectrum specular_colour{1, 1, 1};             ///< the same
    double thickness = 0;                          ///< KHR_materials_volume: 0 is a thin wall
    Spectrum attenuation_colour{1, 1, 1};          ///< the same
    double attenuation_distance_m = infinity;      ///< the same
    double clearcoat = 0, clearcoat_roughness = 0; ///< KHR_materials_clearcoat
    Spectrum sheen;                                ///< KHR_materials_sheen
    double sheen_roughness = 0;                    ///< the same
    double anisotropy = 0;                         ///< KHR_materials_anisotropy
    double diffuse_transmission = 0;               ///< KHR_materials_diffuse_transmission
    Spectrum diffuse_transmission_colour{1, 1, 1}; ///< the same
    std::optional<double> normal_reflectance;      ///< of pbrSpecularGlossiness, in place of the index
    bool unlit = false;
    std::vector<GltfTexture> textures;
    std::vector<std::string> not_modelled; ///< names of other extensions
};

/// A lamp without size, as KHR_lights_punctual has it.
struct GltfLight {
    std::string name, type;    ///< "point", "spot", "directional"
    Spectrum colour{1, 1, 1};  ///< linear Rec.709
    double intensity = 1;      ///< cd; lx for a directional one
    double inner_rad = 0;      ///< of a spot: full strength up to this angle from its axis
    double outer_rad = pi / 4; ///< of a spot: nothing beyond it
};

struct GltfCamera {
    std::string name;
    bool perspective = true;
    double vertical_rad = 0, aspect = 0;    ///< perspective; aspect 0: not stated
    double half_width = 0, half_height = 0; ///< orthographic, file units
};

/// A glTF file as records of its own; indices are as written and may lead nowhere.
struct GltfDocument {
    std::string name; ///< for places in messages
    std::filesystem::path file;
    std::string generator;
    std::vector<GltfView> views;
    std::vector<GltfAccessor> accessors;
    std::vector<GltfMesh> meshes;
    std::vector<GltfNode> nodes;
    std::vector<GltfMaterial> materials;
    std::vector<GltfCamera> cameras;
    std::vector<GltfSkin> skins;
    std::vector<GltfImage> images;
    std::vector<GltfLight> lights;
    std::vector<std::string> variants; ///< KHR_materials_variants: names of the looks to choose from
    std::vector<int> roots;            ///< of the chosen scene
    std::size_t animations = 0, scenes = 0;
    std::vector<std::string> required; ///< extensions
    /// What the views point into: unpacked bytes, the file, its companions.
    std::vector<std::unique_ptr<std::string>> owned;
    std::vector<std::unique_ptr<MappedFile>> files;
};

/// Rotation by a quaternion of any length; the identity for the zero quaternion.
Affine rotation_of(double x, double y, double z, double w);

/// @throws InputError: not glTF 2, truncated, malformed JSON, nesting deeper than 128, no such companion
GltfDocument read_gltf(const std::filesystem::path& file, Report& report);

} // namespace lightwell
