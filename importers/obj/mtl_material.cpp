#include "engine/base/text.h"
#include "importers/layered_materials.h"
#include "importers/obj/mtl.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

/// Below this dissolve a surface counts as a pane that light goes through; above it as opaque.
constexpr double opaque_from = 0.5;
/// Reflectance assumed where a material has no Kd: a middling grey.
constexpr double assumed_reflectance = 0.5;
constexpr double assumed_glass_index = 1.52;

/// Each channel brought into [0, 1], with a note when that changed it by more than a rounding error.
Spectrum within_unit(Spectrum colour, const std::string& what, const std::string& place, Report& report)
{
    constexpr double rounding = 1e-6; // a decimal fraction of six digits
    const auto clamped = [](double value) { return std::clamp(value, 0.0, 1.0); };
    const Spectrum result{clamped(colour.r), clamped(colour.g), clamped(colour.b)};
    const Spectrum change = colour - result;
    if (std::max({std::fabs(change.r), std::fabs(change.g), std::fabs(change.b)}) > rounding)
        report.add(Finding::repaired, place, what + " outside 0 to 1 is brought to the nearer end");
    return result;
}

/// In the engine's primaries; a saturated colour that lies a little outside them is brought to their edge.
Spectrum unit_colour(const std::optional<Spectrum>& rec709, const std::string& what, const std::string& place,
                     Report& report)
{
    if (!rec709)
        return {};
    const Spectrum engine = from_rec709(within_unit(*rec709, what, place, report));
    return {std::clamp(engine.r, 0.0, 1.0), std::clamp(engine.g, 0.0, 1.0), std::clamp(engine.b, 0.0, 1.0)};
}

/// Rms slope of the facets: Pr squared (the usual perceptual scale), or the slope of Beckmann facets whose lobe is
/// as wide as the highlight of exponent Ns.
/// Source  Walter et al. 2007, section 5.2: exponent = 2 / alpha^2 - 2
double roughness_of(const MtlMaterial& mtl)
{
    if (mtl.roughness)
        return std::pow(std::clamp(*mtl.roughness, 0.0, 1.0), 2);
    return std::min(1.0, std::sqrt(2 / (std::max(0.0, mtl.exponent.value_or(0)) + 2)));
}

/// Share of light in the highlight. The highlight formula of MTL, Ks cos^Ns(half vector), is not normalised: over
/// the hemisphere it reflects Ks * 8 / (Ns + 8). From illum 3 on Ks itself is the reflectance of a mirror image.
double specularity_of(const MtlMaterial& mtl, const std::string& place, Report& report)
{
    const int illum = mtl.illum.value_or(mtl.specular ? 2 : 1);
    if (illum < 2)
        return 0;
    if (mtl.roughness) { // physically based: the Fresnel reflectance of a coat
        const double index = std::max(1.0, mtl.index.value_or(1.5));
        return std::pow((index - 1) / (index + 1), 2);
    }
    const double strength = photopic(unit_colour(mtl.specular, "Ks", place, report));
    return illum == 2 ? strength * 8 / (std::max(0.0, mtl.exponent.value_or(0)) + 8) : strength;
}

bool is_glass(const MtlMaterial& mtl)
{
    if (mtl.dissolve && *mtl.dissolve < opaque_from)
        return true;
    const int illum = mtl.illum.value_or(0); // 4, 6, 7, 9: glass or refraction
    const bool transparent_model = illum == 4 || illum == 6 || illum == 7 || illum == 9;
    return transparent_model && ((mtl.filter && mtl.filter->max() > 0) || mtl.dissolve.value_or(1) < 1);
}

Material glass_of(const MtlMaterial& mtl, const std::string& place, Report& report)
{
    const double through = 1 - std::clamp(mtl.dissolve.value_or(0), 0.0, 1.0);
    const bool filtered = mtl.filter && mtl.filter->max() > 0;
    const Spectrum transmissivity = filtered ? unit_colour(mtl.filter, "Tf", place, report) : Spectrum::grey(through);
    report.add(Finding::approximated, place,
               std::string("transparent material becomes thin glass; ") + (filtered ? "Tf" : "1 - d") +
                   " is what one passage through the pane leaves");
    const double index = mtl.index.value_or(assumed_glass_index);
    return Glass{transmissivity, index > 1 && index < 4 ? index : assumed_glass_index};
}

Material metal_of(const MtlMaterial& mtl, const std::string& place, Report& report)
{
    if (mtl.metallic.value_or(0) >= 0.5)
        return Metal{unit_colour(mtl.diffuse, "Kd", place, report), std::min(1.0, *mtl.metallic), roughness_of(mtl)};
    return Metal{unit_colour(mtl.specular, "Ks", place, report), 1,
                 mtl.exponent || mtl.roughness ? roughness_of(mtl) : 0};
}

/// Kd is kept, since it decides how much light a room has; the highlight gets at most what is left.
Plastic plastic_of(const MtlMaterial& mtl, const std::string& place, Report& report)
{
    Spectrum diffuse = Spectrum::grey(assumed_reflectance);
    if (mtl.diffuse)
        diffuse = unit_colour(mtl.diffuse, "Kd", place, report);
    else
        report.add(Finding::assumed, place, "no Kd: diffuse reflectance 0.5");
    double specularity = specularity_of(mtl, place, report);
    if (diffuse.max() + specularity > 1) {
        specularity = 1 - diffuse.max();
        report.add(Finding::repaired, place,
                   "Kd and highlight together reflect more than arrives; the highlight is weakened");
    }
    if (specularity <= 0)
        return Plastic{diffuse, 0, 0};
    return Plastic{within_unit(diffuse / (1 - specularity), "Kd", place, report), specularity, roughness_of(mtl)};
}

/// The layers of the physically based statements over a plastic: sheen, then a clear coat.
Plastic with_layers(const MtlMaterial& mtl, Plastic plastic, const std::string& place, Report& report)
{
    if (mtl.sheen && mtl.sheen->max() > 0) {
        plastic = with_sheen(plastic, unit_colour(mtl.sheen, "Ps", place, report), mtl.roughness.value_or(1));
        report.add(Finding::approximated, place, "sheen is added to the diffuse reflectance");
    }
    if (mtl.coat.value_or(0) > 0) {
        plastic = with_coat(plastic, *mtl.coat, std::pow(std::clamp(mtl.coat_roughness.value_or(0), 0.0, 1.0), 2));
        report.add(Finding::approximated, place, "clear coat and highlight become one highlight");
    }
    return plastic;
}

} // namespace

Material material_of(const MtlMaterial& mtl, const std::string& place, Report& report)
{
    if (mtl.emission && mtl.emission->max() > 0) {
        const Spectrum radiance = from_rec709(*mtl.emission);
        report.add(Finding::converted, place, "Ke is taken as radiance in W/(m^2 sr)");
        return Light{{std::max(0.0, radiance.r), std::max(0.0, radiance.g), std::max(0.0, radiance.b)}};
    }
    if (is_glass(mtl))
        return glass_of(mtl, place, report);
    if (mtl.anisotropy.value_or(0) != 0)
        report.add(Finding::approximated, place, "brushed highlight (`aniso`) is taken as round");
    const bool open = mtl.dissolve.value_or(1) < 1;
    const bool black = !mtl.diffuse || mtl.diffuse->max() <= 0;
    const bool mirror_like = mtl.illum.value_or(0) == 3 && black && mtl.specular && mtl.specular->max() > 0;
    if (mtl.metallic.value_or(0) >= 0.5 || mirror_like) {
        if (open)
            report.add(Finding::approximated, place, "metal with d below 1 is taken as opaque");
        return metal_of(mtl, place, report);
    }
    const Plastic plastic = with_layers(mtl, plastic_of(mtl, place, report), place, report);
    if (!open)
        return plastic;
    report.add(Finding::approximated, place,
               "d from 0.5 to 1: that share of the area is the surface, light goes straight through the rest");
    return partly_open(plastic, *mtl.dissolve);
}

} // namespace lightwell
