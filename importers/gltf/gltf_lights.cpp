#include "importers/gltf/gltf_lights.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

/// A lamp without size becomes a ball as large as the bulb of a household lamp.
constexpr double ball_radius_m = 0.03;
/// Apparent diameter of the sun.  Source  mean distance and radius: 2 asin(696000 / 149600000)
constexpr double sun_diameter_deg = 0.533;

/// Radiance of a lamp of the file: its photometric value spread over what the factor says, in the lamp's colour.
/// @param per_value  1 / m^2 for a ball, 1 / sr for the sky
Spectrum radiance_of(const GltfLight& light, double per_value)
{
    const Spectrum colour = from_rec709(light.colour);
    const double scale = light.intensity / lumens_per_watt * per_value;
    return {std::max(0.0, colour.r) * scale, std::max(0.0, colour.g) * scale, std::max(0.0, colour.b) * scale};
}

/// Half the angle of a beam with a hard rim that carries the flux of the soft one: full strength up to the inner angle,
/// beyond it the square of the share of the way, counted in cosines, to the outer angle, whose mean is a third.
/// Source  KHR_lights_punctual, inner and outer cone angles
double hard_half_angle(const GltfLight& light)
{
    const double outer = std::cos(light.outer_rad), inner = std::cos(light.inner_rad);
    return std::acos(std::clamp(inner - (inner - outer) / 3, -1.0, 1.0));
}

bool sensible(const GltfLight& light)
{
    return light.intensity > 0 && light.colour.is_finite() && from_rec709(light.colour).max() > 0 &&
           light.inner_rad >= 0 && light.inner_rad < light.outer_rad && light.outer_rad <= pi / 2 + 1e-6;
}

/// Where the lamp is, whatever the scale of its node.
struct Stand {
    Point centre;
    Direction to_source; ///< against the way it shines: along +z of the node
};

Material material_of(const GltfLight& light, const Stand& stand)
{
    const double ball_per_m2 = 1 / (pi * ball_radius_m * ball_radius_m);
    if (light.type == "spot")
        return Spotlight{radiance_of(light, ball_per_m2), 2 * hard_half_angle(light) / radians_per_degree,
                         -stand.to_source};
    const double sine = std::sin(0.5 * sun_diameter_deg * radians_per_degree);
    return Light{radiance_of(light, light.type == "directional" ? 1 / (pi * sine * sine) : ball_per_m2)};
}

const char* rule_for(const GltfLight& light)
{
    if (light.type == "directional")
        return "directional light: a disc of 0.533 degrees in the sky that gives its lux";
    if (light.type == "spot")
        return "spot light: a ball of 6 cm with its candela; its beam has a hard rim and the flux of the soft one";
    return "point light: a ball of 6 cm with its candela";
}

} // namespace

std::string add_light(const GltfDocument& document, int number, SurfaceKey key, const Affine& to_world,
                      std::set<std::string>& names, KeyTable& keys, Imported& imported)
{
    const GltfLight& light = document.lights[static_cast<std::size_t>(number)];
    if (light.type != "directional" && light.type != "spot" && light.type != "point")
        return "unknown type of light";
    if (!sensible(light))
        return "a light without light, or with impossible angles";
    const Stand stand{to_world.translation, normalized(to_world.z)};
    if (!is_finite(stand.centre) || !is_finite(stand.to_source) || !(length(stand.to_source) > 0))
        return "placed beyond the range of numbers";
    key.colour = light.colour;
    key.material = "light: " + (light.name.empty() ? std::to_string(number) : light.name);
    if (light.type == "spot")
        key.material += " at " + key.group;
    if (light.type == "spot" && names.count(key.material) > 0) // siblings of one name, each with its own aim
        key.material += " #" + std::to_string(names.size());
    if (names.insert(key.material).second)
        imported.file_materials.emplace_back(key.material, material_of(light, stand));
    const ModifierId modifier = keys.modifier_for(key);
    if (light.type == "directional")
        imported.scene.root.add_source({stand.to_source, sun_diameter_deg}, modifier, key.group);
    else
        imported.scene.root.add_sphere({stand.centre, ball_radius_m}, Shape::sphere, modifier, key.group);
    imported.report.add(Finding::converted, document.name + ": node \"" + key.group + '"', rule_for(light));
    return {};
}

} // namespace lightwell
