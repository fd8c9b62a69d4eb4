#include "importers/gltf/gltf_parts.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace lightwell {
namespace {

using Json = nlohmann::json;
using Use = FileTexture::Use;

/// A member of an object; null where there is none.
const Json& member(const Json& object, const char* key)
{
    static const Json nothing;
    if (!object.is_object())
        return nothing;
    const auto found = object.find(key);
    return found == object.end() ? nothing : *found;
}

double number_in(const Json& object, const char* key, double fallback)
{
    const Json& value = member(object, key);
    return value.is_number() && std::isfinite(value.get<double>()) ? value.get<double>() : fallback;
}

int index_of(const Json& value)
{
    if (!value.is_number_unsigned())
        return -1;
    const auto index = value.get<std::uint64_t>();
    return index <= std::uint64_t{std::numeric_limits<int>::max()} ? static_cast<int>(index) : -1;
}

std::string text_in(const Json& object, const char* key)
{
    const Json& value = member(object, key);
    return value.is_string() ? value.get<std::string>() : std::string();
}

/// @return `fallback` unless there are `count` numbers at least
std::vector<double> numbers_in(const Json& object, const char* key, const std::vector<double>& fallback)
{
    const Json& list = member(object, key);
    if (!list.is_array() || list.size() < fallback.size())
        return fallback;
    std::vector<double> numbers;
    for (const Json& item : list)
        numbers.push_back(item.is_number() ? item.get<double>() : 0);
    return numbers;
}

Spectrum colour_in(const Json& object, const char* key, const Spectrum& fallback)
{
    const std::vector<double> rgb = numbers_in(object, key, {fallback.r, fallback.g, fallback.b});
    return {rgb[0], rgb[1], rgb[2]};
}

/// Source  KHR_texture_transform: scale, then turn, then shift, in coordinates with v down; ours has v up
TexturePlacement placement_in(const Json& texture)
{
    const Json& transform = member(member(texture, "extensions"), "KHR_texture_transform");
    const std::vector<double> offset = numbers_in(transform, "offset", {0, 0});
    const std::vector<double> scale = numbers_in(transform, "scale", {1, 1});
    const double angle = number_in(transform, "rotation", 0), c = std::cos(angle), s = std::sin(angle);
    TexturePlacement placement;
    placement.to_picture = {c * scale[0], -s * scale[1], s * scale[1] + offset[0],
                            s * scale[0], c * scale[1],  1 - c * scale[1] - offset[1]};
    return placement;
}

/// Reads the materials of one file.
class MaterialReader {
public:
    explicit MaterialReader(const Json& parts)
        : textures_(member(parts, "textures")), samplers_(member(parts, "samplers"))
    {
    }
    GltfMaterial read(const Json& from);

private:
    void metal(const Json& from);
    void texture(const Json& holder, const char* key, Use use);
    void extension(const std::string& name, const Json& value);
    bool layer(const std::string& name, const Json& value);
    void gloss(const Json& value);
    int image_of(const Json& texture) const;

    const Json& textures_;
    const Json& samplers_;
    GltfMaterial material_;
};

const Json& item(const Json& list, int index)
{
    static const Json nothing;
    return list.is_array() && index >= 0 && static_cast<std::size_t>(index) < list.size()
               ? list[static_cast<std::size_t>(index)]
               : nothing;
}

/// The picture that all programs can read, else the one of an extension, which may be of a kind not read here.
int MaterialReader::image_of(const Json& texture) const
{
    const int image = index_of(member(texture, "source"));
    if (image >= 0)
        return image;
    for (const auto& [name, extension] : member(texture, "extensions").items())
        if (const int other = index_of(member(extension, "source")); other >= 0)
            return other;
    return -1;
}

void MaterialReader::texture(const Json& holder, const char* key, Use use)
{
    constexpr int clamp_to_edge = 33071;
    const Json& info = member(holder, key);
    if (!info.is_object())
        return;
    const Json& texture = item(textures_, index_of(member(info, "index")));
    GltfTexture found{use, key, image_of(texture), placement_in(info)};
    const Json& transform = member(member(info, "extensions"), "KHR_texture_transform");
    const int moved = index_of(member(transform, "texCoord"));
    found.coordinates = std::max(0, moved >= 0 ? moved : index_of(member(info, "texCoord")));
    found.strength = number_in(info, "scale", 1);
    const Json& sampler = item(samplers_, index_of(member(texture, "sampler")));
    found.placement.repeats = index_of(member(sampler, "wrapS")) != clamp_to_edge;
    material_.textures.push_back(std::move(found));
}

void MaterialReader::metal(const Json& from)
{
    const Json& pbr = member(from, "pbrMetallicRoughness");
    const std::vector<double> base = numbers_in(pbr, "baseColorFactor", {1, 1, 1, 1});
    material_.base_colour = {base[0], base[1], base[2]};
    material_.alpha = base[3];
    material_.metallic = number_in(pbr, "metallicFactor", 1);
    material_.roughness = number_in(pbr, "roughnessFactor", 1);
    for (const char* key : {"metallicFactor", "roughnessFactor", "metallicRoughnessTexture"})
        material_.metal_stated = material_.metal_stated || !member(pbr, key).is_null();
    texture(pbr, "baseColorTexture", Use::colour);
    texture(pbr, "metallicRoughnessTexture", Use::metal);
}

void MaterialReader::gloss(const Json& value)
{
    material_.base_colour = colour_in(value, "diffuseFactor", {1, 1, 1});
    material_.alpha = numbers_in(value, "diffuseFactor", {1, 1, 1, 1})[3];
    material_.metal_stated = true;
    material_.metallic = 0;
    material_.roughness = 1 - number_in(value, "glossinessFactor", 1);
    material_.normal_reflectance = photopic(from_rec709(colour_in(value, "specularFactor", {1, 1, 1})));
    std::erase_if(material_.textures, [](const GltfTexture& t) { return t.use == Use::colour || t.use == Use::metal; });
    texture(value, "diffuseTexture", Use::colour);
    texture(value, "specularGlossinessTexture", Use::other);
}

/// Extensions that put something over the surface.  @return false when the name is another one
bool MaterialReader::layer(const std::string& name, const Json& value)
{
    if (name == "KHR_materials_clearcoat") {
        material_.clearcoat = number_in(value, "clearcoatFactor", 0);
        material_.clearcoat_roughness = number_in(value, "clearcoatRoughnessFactor", 0);
        for (const char* key : {"clearcoatTexture", "clearcoatRoughnessTexture", "clearcoatNormalTexture"})
            texture(value, key, Use::other);
    } else if (name == "KHR_materials_sheen") {
        material_.sheen = colour_in(value, "sheenColorFactor", {});
        material_.sheen_roughness = number_in(value, "sheenRoughnessFactor", 0);
        for (const char* key : {"sheenColorTexture", "sheenRoughnessTexture"})
            texture(value, key, Use::other);
    } else if (name == "KHR_materials_anisotropy") {
        material_.anisotropy = number_in(value, "anisotropyStrength", 0);
        texture(value, "anisotropyTexture", Use::other);
    } else {
        return false;
    }
    return true;
}

void MaterialReader::extension(const std::string& name, const Json& value)
{
    if (name == "KHR_materials_emissive_strength") {
        material_.emission = material_.emission * number_in(value, "emissiveStrength", 1);
    } else if (name == "KHR_materials_transmission") {
        material_.transmission = number_in(value, "transmissionFactor", 0);
        texture(value, "transmissionTexture", Use::transmission);
    } else if (name == "KHR_materials_ior") {
        material_.index = number_in(value, "ior", 1.5);
    } else if (name == "KHR_materials_specular") {
        material_.specular = number_in(value, "specularFactor", 1);
        material_.specular_colour = colour_in(value, "specularColorFactor", {1, 1, 1});
        texture(value, "specularTexture", Use::other);
        texture(value, "specularColorTexture", Use::other);
    } else if (name == "KHR_materials_volume") {
        material_.thickness = number_in(value, "thicknessFactor", 0);
        material_.attenuation_colour = colour_in(value, "attenuationColor", {1, 1, 1});
        material_.attenuation_distance_m = number_in(value, "attenuationDistance", infinity);
        texture(value, "thicknessTexture", Use::other);
    } else if (name == "KHR_materials_diffuse_transmission") {
        material_.diffuse_transmission = number_in(value, "diffuseTransmissionFactor", 0);
        material_.diffuse_transmission_colour = colour_in(value, "diffuseTransmissionColorFactor", {1, 1, 1});
        texture(value, "diffuseTransmissionTexture", Use::other);
        texture(value, "diffuseTransmissionColorTexture", Use::other);
    } else if (name == "KHR_materials_unlit") {
        material_.unlit = true;
    } else if (name == "KHR_materials_pbrSpecularGlossiness") {
        gloss(value);
    } else if (!layer(name, value)) {
        material_.not_modelled.push_back(name);
    }
}

GltfMaterial MaterialReader::read(const Json& from)
{
    material_ = {};
    material_.name = text_in(from, "name");
    metal(from);
    if (const std::string mode = text_in(from, "alphaMode"); !mode.empty())
        material_.alpha_mode = mode;
    material_.alpha_cutoff = number_in(from, "alphaCutoff", 0.5);
    material_.emission = colour_in(from, "emissiveFactor", {});
    texture(from, "emissiveTexture", Use::emission);
    texture(from, "normalTexture", Use::normal);
    texture(from, "occlusionTexture", Use::other);
    for (const auto& [name, value] : member(from, "extensions").items())
        extension(name, value);
    return material_;
}

GltfLight light_of(const Json& from)
{
    GltfLight light;
    light.name = text_in(from, "name");
    light.type = text_in(from, "type");
    light.colour = colour_in(from, "color", {1, 1, 1});
    light.intensity = number_in(from, "intensity", 1);
    light.inner_rad = number_in(member(from, "spot"), "innerConeAngle", 0);
    light.outer_rad = number_in(member(from, "spot"), "outerConeAngle", pi / 4);
    return light;
}

GltfSkin skin_of(const Json& from)
{
    GltfSkin skin;
    skin.inverse_bind = index_of(member(from, "inverseBindMatrices"));
    for (const Json& joint : member(from, "joints"))
        skin.joints.push_back(index_of(joint));
    return skin;
}

} // namespace

void read_parts(const std::string& json, GltfDocument& document)
{
    const Json parts = Json::parse(json);
    MaterialReader reader(parts);
    for (const Json& material : member(parts, "materials"))
        document.materials.push_back(reader.read(material));
    for (const Json& skin : member(parts, "skins"))
        document.skins.push_back(skin_of(skin));
    for (const Json& image : member(parts, "images"))
        document.images.push_back(
            {text_in(image, "uri"), index_of(member(image, "bufferView")), text_in(image, "name")});
    const Json& extensions = member(parts, "extensions");
    for (const Json& light : member(member(extensions, "KHR_lights_punctual"), "lights"))
        document.lights.push_back(light_of(light));
    for (const Json& variant : member(member(extensions, "KHR_materials_variants"), "variants"))
        document.variants.push_back(text_in(variant, "name"));
}

} // namespace lightwell
