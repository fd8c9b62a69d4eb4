#include "plugins/validation/case.h"

namespace lightwell {
namespace {

constexpr double luminance = 1000, accepted = 0.001;
/// A perfectly smooth coating gains reflectance at grazing angles and takes it from the diffuse part: no half and half.
constexpr double almost_mirror = 0.002;

Scene furnace(const Perturbation& p)
{
    Scene scene;
    scene.root.add_source({{0, 0, 1}, 360}, scene.add_material("glow", p.surroundings(luminance)), "all_around");
    return scene;
}

/// A ball of the material in the furnace, seen off its middle.
Setup ball(const std::string& name, double expected, const std::function<Material(const Perturbation&)>& material)
{
    return {
        [=](const Perturbation& p) {
            Scene scene = furnace(p);
            scene.root.add_sphere({{0, 0, 0}, 1}, Shape::sphere, scene.add_material("material", material(p)), "ball");
            return scene;
        },
        {detecting(luminance_check(name, expected, accepted, {0.3, -4, 0.2}, {0, 1, 0}))}};
}

Setup slab(const std::string& name)
{
    return {[](const Perturbation& p) {
                Scene scene = furnace(p);
                const ModifierId clear = scene.add_material("clear", Dielectric{Spectrum::grey(1), 1.5, 0});
                constexpr double w = 1, d = 0.1;
                Part& root = scene.root;
                root.add_polygon({{-w, -w, d}, {w, -w, d}, {w, w, d}, {-w, w, d}}, clear, "top");
                root.add_polygon({{-w, -w, 0}, {-w, w, 0}, {w, w, 0}, {w, -w, 0}}, clear, "bottom");
                root.add_polygon({{-w, -w, 0}, {w, -w, 0}, {w, -w, d}, {-w, -w, d}}, clear, "south");
                root.add_polygon({{-w, w, 0}, {-w, w, d}, {w, w, d}, {w, w, 0}}, clear, "north");
                root.add_polygon({{-w, -w, 0}, {-w, -w, d}, {-w, w, d}, {-w, w, 0}}, clear, "west");
                root.add_polygon({{w, -w, 0}, {w, w, 0}, {w, w, d}, {w, -w, d}}, clear, "east");
                return scene;
            },
            {detecting(luminance_check(name, luminance, accepted, {0, 0, 2}, normalized({0.2, 0.1, -1})))}};
}

} // namespace

std::vector<Case> furnace_cases()
{
    const Spectrum white = Spectrum::grey(1);
    const auto fixed = [](const Material& material) { return [=](const Perturbation&) { return material; }; };
    Case grey{"cl_furnace", Technique::sky | Technique::interreflection};
    grey.setups = {ball("diffuse_rho0.5_sphere", 0.5 * luminance,
                        [](const Perturbation& p) -> Material { return p.diffuse(0.5, 0); })};
    grey.references = {{"diffuse_rho0.5_sphere", 0.5 * luminance}};
    // White cannot be made whiter: these rows are blind to what reflects and refracts, and say nothing about it.
    Case mirror{"cl_furnace", Technique::sky | Technique::specular};
    mirror.setups = {
        ball("mirror_rho0.9_sphere", 0.9 * luminance, [](const Perturbation& p) -> Material { return p.mirror(0.9); })};
    mirror.references = {{"mirror_rho0.9_sphere", 0.9 * luminance}};
    Case others{"cl_furnace", static_cast<unsigned>(Technique::sky)};
    others.setups = {
        ball("diffuse_rho1_sphere_exterior", luminance, fixed(Plastic{white, 0, 0})),
        ball("clear_dielectric_sphere_any_index", luminance, fixed(Dielectric{white, 1.5, 0})),
        ball("clear_dielectric_sphere_any_index 2.4", luminance, fixed(Dielectric{white, 2.4, 0})),
        slab("clear_dielectric_slab"),
        ball("half_diffuse_half_mirror_(0.5+0.5)", luminance, fixed(Plastic{white, 0.5, almost_mirror})),
        ball("diffuse_reflectance0.4_plus_diffuse_transmittance0.6", luminance, fixed(Trans{white, 0, 0, 0.6, 0}))};
    for (const Setup& setup : others.setups)
        others.references.emplace_back(setup.checks[0].quantity, setup.checks[0].expected);
    return {grey, mirror, others};
}

} // namespace lightwell
