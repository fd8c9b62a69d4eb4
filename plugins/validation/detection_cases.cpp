#include "plugins/validation/case.h"
#include "plugins/validation/glass_formulas.h"
#include "plugins/validation/lamp_formulas.h"
#include "plugins/validation/room_formulas.h"

/// \file One row for each technique that nothing but this technique can make fail. Light comes from glows that no
/// deliberate error touches, except where lamps or the sky are what is tested.
namespace lightwell {
namespace {

constexpr double accepted = 0.005, luminance = 1000;

/// A black square with a front of constant luminance that faces up or down.
void add_glow(Scene& scene, double height, bool faces_up)
{
    constexpr double wide = 4;
    std::vector<Point> corners{
        {-wide, -wide, height}, {wide, -wide, height}, {wide, wide, height}, {-wide, wide, height}};
    if (!faces_up)
        std::reverse(corners.begin(), corners.end());
    scene.root.add_polygon(corners, scene.add_material("glow", Glow{Spectrum::grey(luminance / lumens_per_watt), 0}),
                           "glow");
}

Case one_row(const char* name, Technique technique, Check check, std::function<Scene(const Perturbation&)> scene)
{
    Case result{std::string("detects_") + name, static_cast<unsigned>(technique)};
    result.setups.push_back({std::move(scene), {detecting(std::move(check))}});
    return result;
}

Case direct_row()
{
    constexpr double radius = 0.5, height = 2;
    const Check check = illuminance_check("disc lamp", disc_illuminance(radius, height, 0.5, luminance), accepted,
                                          {{0.5, 0, 0}, {0, 0, 1}});
    return one_row("direct", Technique::direct, check, [=](const Perturbation& p) {
        Scene scene;
        scene.root.add_ring({{0, 0, height}, {0, 0, -1}, 0, radius}, scene.add_material("lamp", p.lamp(luminance)),
                            "disc");
        return scene;
    });
}

Case specular_row()
{
    constexpr double reflectance = 0.9, wide = 4;
    Check check =
        luminance_check("glow in a mirror", reflectance * luminance, accepted, {0, 0, 1}, normalized({0.3, 0.1, -1}));
    check.exact = true;
    return one_row("specular", Technique::specular, check, [=](const Perturbation& p) {
        Scene scene;
        scene.root.add_polygon({{-wide, -wide, 0}, {wide, -wide, 0}, {wide, wide, 0}, {-wide, wide, 0}},
                               scene.add_material("mirror", p.mirror(reflectance)), "mirror");
        add_glow(scene, 2, false);
        return scene;
    });
}

Case ambient_row()
{
    constexpr double radius = 1, lamp_radius = 1e-3, reflectance = 0.9, flux_lm = 1000;
    constexpr double intensity = flux_lm / (4 * pi);
    const double expected = intensity / (radius * radius) + sphere_indirect(radius, reflectance, flux_lm);
    Check check = illuminance_check("white sphere", expected, accepted, {{0, 0, -radius}, {0, 0, 1}});
    check.method = Method::usual;
    return one_row("ambient", Technique::interreflection, check, [=](const Perturbation& p) {
        Scene scene;
        scene.root.add_sphere({{0, 0, 0}, radius}, Shape::bubble, scene.add_material("wall", p.diffuse(reflectance, 1)),
                              "wall");
        const Light steady{Spectrum::grey(intensity / (pi * lamp_radius * lamp_radius) / lumens_per_watt)};
        scene.root.add_sphere({{0, 0, 0}, lamp_radius}, Shape::sphere, scene.add_material("lamp", steady), "lamp");
        return scene;
    });
}

Case sky_row()
{
    const Check check = illuminance_check("open sky", pi * luminance, accepted, {{0, 0, 0}, {0, 0, 1}});
    return one_row("sky", Technique::sky, check, [](const Perturbation& p) {
        Scene scene;
        scene.root.add_source({{0, 0, 1}, 180}, scene.add_material("glow", p.surroundings(luminance)), "sky");
        return scene;
    });
}

Case glass_row()
{
    constexpr double transmissivity = 0.96, index = 1.52, angle = 0.5, wide = 4;
    Check check = luminance_check("glow through a pane", luminance * pane_transmittance(transmissivity, index, angle),
                                  accepted, {0, 0, 0}, {std::sin(angle), 0, std::cos(angle)});
    check.exact = true;
    return one_row("glass", Technique::glass, check, [=](const Perturbation& p) {
        Scene scene;
        scene.root.add_polygon({{-wide, -wide, 1}, {wide, -wide, 1}, {wide, wide, 1}, {-wide, wide, 1}},
                               scene.add_material("pane", p.pane(transmissivity, index)), "pane");
        add_glow(scene, 2, false);
        return scene;
    });
}

} // namespace

std::vector<Case> detection_cases()
{
    return {direct_row(), specular_row(), ambient_row(), sky_row(), glass_row()};
}

} // namespace lightwell
