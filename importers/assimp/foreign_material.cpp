#include "importers/assimp/foreign_material.h"

#include <algorithm>

namespace lightwell {
namespace {

/// Below this opacity a surface counts as a pane that light goes through.
constexpr double opaque_from = 0.5;
constexpr double glass_index = 1.52;

double unit(double value)
{
    return value >= 0 ? std::min(value, 1.0) : 0.0; // NaN becomes 0 too
}

} // namespace

Spectrum colour_of(const ForeignMaterial& from)
{
    return {unit(from.diffuse[0]), unit(from.diffuse[1]), unit(from.diffuse[2])};
}

Material material_of(const ForeignMaterial& from, const std::string& place, Report& report)
{
    if (from.textures > 0)
        report.add(Finding::unsupported, place, "texture is not modelled; the plain colour is used", from.textures);
    const Spectrum emission{from.emission[0], from.emission[1], from.emission[2]};
    if (emission.is_finite() && emission.max() > 0) {
        const Spectrum given = from_rec709(emission);
        report.add(Finding::converted, place, "emission is taken as radiance in W/(m^2 sr)");
        return Light{{std::max(0.0, given.r), std::max(0.0, given.g), std::max(0.0, given.b)}};
    }
    if (from.opacity < opaque_from) {
        report.add(Finding::approximated, place,
                   "transparent material becomes thin glass; 1 - opacity is what one passage through the pane leaves");
        return Glass{Spectrum::grey(1 - unit(from.opacity)), glass_index};
    }
    if (from.shiny)
        report.add(Finding::ignored, place, "highlight: the format states no reflectance for it; the surface is matt");
    const Spectrum engine = from_rec709(colour_of(from));
    return Plastic{{unit(engine.r), unit(engine.g), unit(engine.b)}, 0, 0};
}

} // namespace lightwell
