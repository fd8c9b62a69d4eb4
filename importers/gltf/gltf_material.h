#pragma once

#include "importers/gltf/gltf_document.h"
#include "importers/gltf/gltf_pictures.h"
#include "materials/material.h"

namespace lightwell {

/// What the rule of materials must know beside the material.
struct GltfSurroundings {
    bool from_blender = false; ///< emission is in W/(m^2 sr); otherwise in cd/m^2, as the format says
    bool open_shell = false;   ///< some mesh of this material does not enclose a body
    double metres_per_unit = 1;
};

/// Multiplies the factors with the means of the material's pictures.
/// @param name      of the material in Imported::file_materials
/// @param textures  receives the pictures
void apply_pictures(GltfMaterial& material, const std::string& name, GltfPictures& pictures, const std::string& place,
                    Report& report, std::vector<FileTexture>& textures);

/// Which TEXCOORD of its meshes lays the pictures of a material; -1: none is laid. Pictures of other coordinates count
/// with their means.
int coordinates_of(const GltfMaterial& material);
/// Whether the base colour is what light that passes keeps.
bool lets_base_colour_through(const GltfMaterial& material);

/// The rule of importers/gltf/README.md: emitter, glass, body, metal, plastic or something partly open; always a valid
/// material.
Material material_of(const GltfMaterial& from, const GltfSurroundings& around, const std::string& place,
                     Report& report);

} // namespace lightwell
