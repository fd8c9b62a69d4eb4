#include "importers/dxf/lights.h"

#include <fmt/format.h>

#include <algorithm>

namespace lightwell::dxf {
namespace {

enum LightKind { distant = 1, point = 2, spot = 3 };

/// The strength that a new lamp of a drawing with photometric lights has.
constexpr double cd_per_intensity = 1500, lux_per_intensity = 1500;
constexpr double ball_radius_m = 0.01;
constexpr double sun_full_angle_deg = 0.533;

struct Lamp {
    std::string material_name;
    Material material;
    std::variant<Sphere, DistantSource> shape;
};

/// Grey radiance of a luminance.
Spectrum radiance_of(double luminance_cd_per_m2)
{
    const double radiance_W_per_m2_sr = luminance_cd_per_m2 / lumens_per_watt;
    return {radiance_W_per_m2_sr, radiance_W_per_m2_sr, radiance_W_per_m2_sr};
}

Lamp distant_lamp(double intensity, const Direction& to_source)
{
    const double sine = std::sin(0.5 * sun_full_angle_deg * radians_per_degree);
    const double lux = intensity * lux_per_intensity;
    return {fmt::format("distant light {:.6g} lx", lux), Light{radiance_of(lux / (pi * sine * sine))},
            DistantSource{to_source, sun_full_angle_deg}};
}

/// Full angle of the cone that stands for the soft edge from hotspot to falloff.
double beam_angle_deg(double hotspot_deg, double falloff_deg)
{
    const double outer = std::clamp(falloff_deg, 0.1, 360.0), inner = std::clamp(hotspot_deg, 0.0, outer);
    const auto cosine = [](double full_deg) { return std::cos(0.5 * full_deg * radians_per_degree); };
    return 2 * std::acos(0.5 * (cosine(inner) + cosine(outer))) / radians_per_degree;
}

Lamp ball_lamp(const Fields& fields, double intensity, const Point& at, const Direction& aim)
{
    const double cd = intensity * cd_per_intensity;
    const Spectrum radiance = radiance_of(cd / (pi * ball_radius_m * ball_radius_m));
    const Sphere ball{at, ball_radius_m};
    if (fields.flags(70) != spot || aim == Vec3{})
        return {fmt::format("point light {:.6g} cd", cd), Light{radiance}, ball};
    const double angle_deg = beam_angle_deg(fields.get(50, 45), fields.get(51, 50));
    return {fmt::format("spot light {:.6g} cd {:.4g} deg to {:.6g} {:.6g} {:.6g}", cd, angle_deg, aim.x, aim.y, aim.z),
            Spotlight{radiance, angle_deg, aim}, ball};
}

} // namespace

Reason dark_reason(const Entity& light)
{
    static constexpr SkipReason off{"the light is switched off"}, none{"the light has no intensity"};
    constexpr int is_on = 290;
    const Fields fields{light.values};
    if (fields.get(is_on, 1) == 0)
        return &off;
    return fields.get(40, 1) > 0 ? nullptr : &none;
}

void add_light(const Drawing& drawing, const DrawnLight& light, const Affine& to_metres, ModifierTable& modifiers,
               Imported& imported)
{
    const Fields fields{light.entity->values};
    const Point at = to_metres.point(light.to_frame.point(fields.point(10)));
    const Direction aim = normalized(to_metres.point(light.to_frame.point(fields.point(11))) - at);
    const double intensity = fields.get(40, 1);
    const Lamp lamp = fields.flags(70) == distant && aim != Vec3{} ? distant_lamp(intensity, -aim)
                                                                   : ball_lamp(fields, intensity, at, aim);
    const auto known = [&](const auto& material) { return material.first == lamp.material_name; };
    if (std::none_of(imported.file_materials.begin(), imported.file_materials.end(), known))
        imported.file_materials.emplace_back(lamp.material_name, lamp.material);
    const ModifierId modifier = modifiers.modifier_for(light.what, lamp.material_name);
    const std::string name = drawing.name(*light.entity);
    Part& part = imported.scene.root;
    if (const auto* ball = std::get_if<Sphere>(&lamp.shape))
        part.add_sphere(*ball, Shape::sphere, modifier, name);
    else
        part.add_source(std::get<DistantSource>(lamp.shape), modifier, name);
    imported.report.add(Finding::converted, drawing.place(*light.entity),
                        "lights of the drawing: an intensity of 1 is taken as 1500 cd (distant: 1500 lx), spot lights "
                        "as even cones, and light falls off as in nature");
}

} // namespace lightwell::dxf
