#include "importers/gltf/gltf_material.h"

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

void note_what_is_left_out(const GltfMaterial& from, const std::string& place, Report& report)
{
    if (from.textures > 0)
        report.add(Finding::unsupported, place, "texture is not modelled yet; the factor beside it is used",
                   from.textures);
    for (const std::string& name : from.not_modelled)
        report.add(Finding::unsupported, place, name + " is not modelled yet");
    if (from.alpha_mode == "MASK")
        report.add(Finding::unsupported, place, "alpha mask is not modelled yet; the surface is whole");
}

} // namespace

Material material_of(const GltfMaterial& from, bool from_blender, const std::string& place, Report& report)
{
    note_what_is_left_out(from, place, report);
    if (from.emission.is_finite() && from.emission.max() > 0)
        return light_of(from, from_blender, place, report);
    if (from.transmission >= mostly || (from.alpha_mode == "BLEND" && from.alpha < mostly))
        return glass_of(from, place, report);
    const Spectrum colour = reflectance_of(from.base_colour);
    if (from.unlit)
        return Plastic{colour, 0, 0};
    if (!from.metal_stated) {
        report.add(Finding::assumed, place, "neither metal nor roughness is stated; taken as matt, not as metal");
        return Plastic{colour, 0, 0};
    }
    const double slope = std::pow(unit(from.roughness), 2); // rms slope of the facets: the square, as the format says
    if (from.metallic >= mostly)
        return Metal{colour, unit(from.metallic), slope};
    const double root = (index_of(from) - 1) / (index_of(from) + 1);
    return Plastic{colour, unit(root * root * unit(from.specular)), slope};
}

} // namespace lightwell
