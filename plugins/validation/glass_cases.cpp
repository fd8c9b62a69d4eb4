#include "plugins/validation/case.h"
#include "plugins/validation/glass_formulas.h"
#include "plugins/validation/lamp_formulas.h"

namespace lightwell {
namespace {

constexpr double index = 1.52, accepted = 0.003, luminance = 1000;
constexpr double pane_height = 1;

/// A pane wide enough for a ray at 85 degrees.
void add_pane(Scene& scene, const Glass& glass)
{
    constexpr double wide = 100;
    scene.root.add_polygon({{-wide, -wide, pane_height},
                            {wide, -wide, pane_height},
                            {wide, wide, pane_height},
                            {-wide, wide, pane_height}},
                           scene.add_material("glass", glass), "pane");
}

/// Light of a narrow sun through the pane, on a sensor that faces it: a shadow ray.
Setup shadow_ray(double transmissivity, double normal_transmittance, double degrees)
{
    constexpr double half_angle_deg = 0.01, sun_luminance = 1e9;
    const double angle = degrees * radians_per_degree;
    const Direction to_sun{std::sin(angle), 0, std::cos(angle)};
    const double expected = sun_illuminance(half_angle_deg * radians_per_degree, sun_luminance) *
                            pane_transmittance(transmissivity, index, angle);
    const std::string name = numbered("T", normal_transmittance) + numbered(" shadow ray at ", degrees);
    return {[=](const Perturbation& p) {
                Scene scene;
                scene.root.add_source({to_sun, 2 * half_angle_deg}, scene.add_material("solar", p.lamp(sun_luminance)),
                                      "sun");
                add_pane(scene, p.pane(transmissivity, index));
                return scene;
            },
            {detecting(illuminance_check(name, expected, accepted, {{0, 0, 0}, to_sun}))}};
}

/// The luminance of half a sphere of sky through the pane: the mirror image below the pane is black.
Setup view_ray(double transmissivity, double normal_transmittance, double degrees)
{
    const double angle = degrees * radians_per_degree;
    const std::string name = numbered("T", normal_transmittance) + numbered(" picture at ", degrees);
    Check check = luminance_check(name, luminance * pane_transmittance(transmissivity, index, angle), accepted,
                                  {0, 0, 0}, {std::sin(angle), 0, std::cos(angle)});
    check.exact = true; // the mirrored and the passing part are both followed
    return {[=](const Perturbation& p) {
                Scene scene;
                scene.root.add_source({{0, 0, 1}, 180}, scene.add_material("glow", p.surroundings(luminance)), "sky");
                add_pane(scene, p.pane(transmissivity, index));
                return scene;
            },
            {check}};
}

} // namespace

std::vector<Case> glass_cases()
{
    // Two cases of one id, since light comes from the sun in one and from the sky in the other.
    Case shadow{"cl_glass_transmissivity", Technique::direct | Technique::glass};
    Case picture{"cl_glass_transmissivity", Technique::sky | Technique::glass};
    for (const double normal : {0.05, 0.3, 0.5, 0.65, 0.78, 0.88, 0.9}) {
        const std::string key = numbered("", normal);
        const double transmissivity = pane_transmissivity(normal, index);
        shadow.references.emplace_back(key + ".transmissivity", transmissivity);
        shadow.references.emplace_back(key + ".hemispherical_diffuse_transmittance",
                                       diffuse_transmittance(transmissivity, index));
        for (const double degrees : {0.0, 30.0, 45.0, 60.0, 75.0, 85.0}) {
            shadow.references.emplace_back(key + numbered(".transmittance_by_angle_deg.", degrees),
                                           pane_transmittance(transmissivity, index, degrees * radians_per_degree));
            if (normal != 0.5 && normal != 0.88)
                continue; // the ends and the usual panes are enough for the engine
            shadow.setups.push_back(shadow_ray(transmissivity, normal, degrees));
            picture.setups.push_back(view_ray(transmissivity, normal, degrees));
        }
    }
    picture.references.emplace_back("0.88.transmissivity", pane_transmissivity(0.88, index));
    return {shadow, picture};
}

} // namespace lightwell
