#include "importers/gltf/gltf_material.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "importers/layered_materials.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

/// From this share on a material counts as metal, as transparent.
constexpr double mostly = 0.5;

double unit(double value) noexcept
{
    return value >= 0 ? std::min(value, 1.0) : 0.0; // NaN becomes 0 too
}

Spectrum reflectance_of(const Spectrum& rec709)
{
    const Spectrum inside{unit(rec709.r), unit(rec709.g), unit(rec709.b)};
    const Spectrum engine = from_rec709(inside);
    return {unit(engine.r), unit(engine.g), unit(engine.b)};
}

Material light_of(const GltfMaterial& from, bool from_blender, const std::string& place, Report& report)
{
    const Spectrum given = from_rec709(from.emission);
    const double scale = from_blender ? 1 : 1 / lumens_per_watt;
    report.add(Finding::converted, place,
               from_blender ? "emission of a Blender file is taken as radiance in W/(m^2 sr)"
                            : "emission in cd/m^2 is divided by 179 lm/W");
    return Light{{std::max(0.0, given.r) * scale, std::max(0.0, given.g) * scale, std::max(0.0, given.b) * scale}};
}

double index_of(const GltfMaterial& from)
{
    constexpr double highest_index = 4; // germanium; above it a file means something else
    return from.index > 1 && from.index < highest_index ? from.index : 1.5;
}

/// Share of the area that the surface covers.
double opacity_of(const GltfMaterial& from)
{
    return from.alpha_mode == "OPAQUE" ? 1 : unit(from.alpha);
}

/// What one metre of the body leaves.  Source  KHR_materials_volume: colour after the attenuation distance
Material body_of(const GltfMaterial& from, double metres_per_unit, const std::string& place, Report& report)
{
    const Spectrum colour = reflectance_of(from.attenuation_colour);
    const double distance_m = from.attenuation_distance_m * metres_per_unit;
    const auto after_one_metre = [&](double left) { return distance_m > 0 ? std::pow(left, 1 / distance_m) : 1; };
    if (from.base_colour.r != 1 || from.base_colour.g != 1 || from.base_colour.b != 1)
        report.add(Finding::approximated, place, "base colour of a transparent body is left out; its volume tints");
    if (from.roughness > 0 && from.metal_stated)
        report.add(Finding::approximated, place, "rough transparent surface is taken as smooth");
    return Dielectric{
        {after_one_metre(colour.r), after_one_metre(colour.g), after_one_metre(colour.b)}, index_of(from), 0};
}

Material glass_of(const GltfMaterial& from, const std::string& place, Report& report)
{
    if (from.transmission >= mostly) {
        report.add(Finding::approximated, place, "transmission becomes thin glass of the base colour");
        return Glass{reflectance_of(from.base_colour * unit(from.transmission)), index_of(from)};
    }
    report.add(Finding::approximated, place,
               "blended surface becomes thin glass; 1 - alpha is what one passage through the pane leaves");
    return Glass{Spectrum::grey(1 - unit(from.alpha)), index_of(from)};
}

/// A sheet that scatters part of the light to its other side.  Source  KHR_materials_diffuse_transmission
Material diffusing(const GltfMaterial& from, const std::string& place, Report& report)
{
    const double share = unit(from.diffuse_transmission);
    const Spectrum back = reflectance_of(from.base_colour) * (1 - share);
    const Spectrum through = reflectance_of(from.diffuse_transmission_colour) * share;
    const Spectrum sum = back + through;
    const double mean = photopic(sum);
    report.add(Finding::approximated, place, "light scattered forwards and backwards has one colour, their mean");
    return Trans{{unit(sum.r), unit(sum.g), unit(sum.b)}, 0, 0, mean > 0 ? unit(photopic(through) / mean) : 0, 0};
}

/// Reflectance of the smooth surface at normal incidence: Fresnel, or what the file says in its place.
double normal_reflectance_of(const GltfMaterial& from)
{
    if (from.normal_reflectance)
        return unit(*from.normal_reflectance);
    const double root = (index_of(from) - 1) / (index_of(from) + 1);
    return unit(std::min(1.0, root * root * photopic(from_rec709(from.specular_colour))) * unit(from.specular));
}

Plastic plastic_of(const GltfMaterial& from, double slope, const std::string& place, Report& report)
{
    Plastic plastic{reflectance_of(from.base_colour), normal_reflectance_of(from), slope};
    if (from.sheen.is_finite() && from.sheen.max() > 0) {
        plastic = with_sheen(plastic, reflectance_of(from.sheen), unit(from.sheen_roughness));
        report.add(Finding::approximated, place, "sheen is added to the diffuse reflectance");
    }
    if (from.clearcoat > 0) {
        plastic = with_coat(plastic, from.clearcoat, std::pow(unit(from.clearcoat_roughness), 2));
        report.add(Finding::approximated, place, "clear coat and highlight become one highlight");
    }
    return plastic;
}

/// A round highlight as wide as the brushed one in the mean of both directions.
/// Source  KHR_materials_anisotropy: slope along the brush is mix(slope, 1, strength^2)
double round_slope(const GltfMaterial& from, double slope)
{
    const double along = std::lerp(slope, 1.0, unit(from.anisotropy) * unit(from.anisotropy));
    return std::sqrt(along * slope);
}

void note_what_is_left_out(const GltfMaterial& from, const std::string& place, Report& report)
{
    for (const std::string& name : from.not_modelled)
        report.add(Finding::unsupported, place, name + " is not modelled yet");
    if (from.anisotropy > 0)
        report.add(Finding::approximated, place, "brushed highlight is taken as round");
    const bool partly = from.transmission > 0 && from.transmission < mostly;
    if (partly)
        report.add(Finding::approximated, place, "transmission below 0.5 is taken as opaque");
}

/// Opaque or partly open.
Material covering(const GltfMaterial& from, const std::string& place, Report& report)
{
    const double opacity = opacity_of(from);
    double slope = std::pow(unit(from.roughness), 2); // rms slope of the facets: the square, as the format says
    if (from.anisotropy > 0)
        slope = round_slope(from, slope);
    if (from.metal_stated && !from.unlit && from.metallic >= mostly && opacity >= 1) {
        if (from.clearcoat > 0)
            report.add(Finding::approximated, place, "clear coat over metal is left out");
        return Metal{reflectance_of(from.base_colour), unit(from.metallic), slope};
    }
    Plastic plastic{reflectance_of(from.base_colour), 0, 0};
    if (!from.unlit && from.metal_stated)
        plastic = plastic_of(from, slope, place, report);
    else if (!from.unlit)
        report.add(Finding::assumed, place, "neither metal nor roughness is stated; taken as matt, not as metal");
    if (opacity >= 1)
        return plastic;
    report.add(Finding::approximated, place,
               from.alpha_mode == "MASK"
                   ? "cut-out surface: the share that is left covers, light goes straight through the rest"
                   : "alpha from 0.5 to 1: that share covers, light goes straight through the rest");
    return partly_open(plastic, opacity);
}

std::string rounded(double value)
{
    return shortest(std::round(1000 * value) / 1000);
}

std::string rounded(const Spectrum& s)
{
    return rounded(s.r) + " " + rounded(s.g) + " " + rounded(s.b);
}

/// The pixels of the base colour also say where the surface is.
void take_opacity(const PictureMeans& means, GltfMaterial& material)
{
    if (material.alpha_mode == "MASK")
        material.alpha = means.share_kept(material.alpha_cutoff, material.alpha);
    else
        material.alpha *= means.opacity;
}

/// Changes the factors by the means.  @return the mean as text; empty when the picture changes no factor
std::string take_mean(const PictureMeans& means, FileTexture::Use use, GltfMaterial& material)
{
    switch (use) {
    case FileTexture::Use::colour:
        material.base_colour = material.base_colour * means.colour;
        take_opacity(means, material);
        return {};
    case FileTexture::Use::emission:
        material.emission = material.emission * means.colour;
        return rounded(means.colour);
    case FileTexture::Use::metal: // roughness in green, metal in blue
        material.roughness *= means.plain.g;
        material.metallic *= means.plain.b;
        return "roughness " + rounded(means.plain.g) + " and metal " + rounded(means.plain.b);
    case FileTexture::Use::transmission:
        material.transmission *= means.plain.r;
        return rounded(means.plain.r);
    default:
        return {};
    }
}

void apply_picture(const GltfTexture& texture, GltfMaterial& material, GltfPictures& pictures, const std::string& place,
                   Report& report)
{
    if (texture.use == FileTexture::Use::normal)
        return;
    if (texture.what == "occlusionTexture")
        return report.add(Finding::ignored, place, "occlusionTexture: the simulation finds out what hides light");
    if (texture.use == FileTexture::Use::other)
        return report.add(Finding::unsupported, place, texture.what + " is not read; the factor beside it is used");
    const PictureMeans* means = pictures.means(texture.image, place, report);
    if (means == nullptr)
        return;
    if (const std::string mean = take_mean(*means, texture.use, material); !mean.empty())
        report.add(Finding::approximated, place,
                   texture.what + ": its mean, " + mean + ", stands for the whole picture");
}

} // namespace

bool lets_base_colour_through(const GltfMaterial& material)
{
    return material.transmission >= mostly;
}

int coordinates_of(const GltfMaterial& material)
{
    for (const FileTexture::Use use : {FileTexture::Use::colour, FileTexture::Use::normal})
        for (const GltfTexture& texture : material.textures)
            if (texture.use == use && texture.image >= 0)
                return texture.coordinates;
    return -1;
}

void apply_pictures(GltfMaterial& material, const std::string& name, GltfPictures& pictures, const std::string& place,
                    Report& report, std::vector<FileTexture>& textures)
{
    const double stated_alpha = material.alpha;
    bool masked_by_picture = false;
    for (const GltfTexture& texture : material.textures) {
        apply_picture(texture, material, pictures, place, report);
        const bool shown = texture.use == FileTexture::Use::colour || texture.use == FileTexture::Use::normal;
        const PictureMeans* means = shown ? pictures.means(texture.image, place, report) : nullptr;
        if (shown && means == nullptr)
            continue;
        masked_by_picture |= texture.use == FileTexture::Use::colour;
        try {
            FileTexture found = pictures.located(texture.image);
            found.material = name;
            found.use = texture.use;
            found.placement = texture.placement;
            found.what = texture.what;
            found.mean = means ? means->colour : found.mean;
            found.strength = {texture.strength, texture.strength};
            found.as_stored = texture.coordinates == coordinates_of(material);
            textures.push_back(std::move(found));
        } catch (const InputError&) { // noted where the means were asked for
            continue;
        }
    }
    if (material.alpha_mode == "MASK" && !masked_by_picture)
        material.alpha = stated_alpha >= material.alpha_cutoff ? 1 : 0;
}

Material material_of(const GltfMaterial& from, const GltfSurroundings& around, const std::string& place, Report& report)
{
    note_what_is_left_out(from, place, report);
    if (from.emission.is_finite() && from.emission.max() > 0)
        return light_of(from, around.from_blender, place, report);
    if (from.transmission >= mostly && from.thickness > 0) {
        if (!around.open_shell)
            return body_of(from, around.metres_per_unit, place, report);
        report.add(Finding::approximated, place, "transparent body has an open mesh; it becomes a thin pane");
    }
    if (from.transmission >= mostly || (from.alpha_mode == "BLEND" && opacity_of(from) < mostly))
        return glass_of(from, place, report);
    if (from.diffuse_transmission > 0)
        return diffusing(from, place, report);
    return covering(from, place, report);
}

} // namespace lightwell
