#include "engine/scene/add_sky.h"
#include "plugins/validation/case.h"
#include "plugins/validation/glass_formulas.h"
#include "plugins/validation/quadrature.h"
#include "plugins/validation/room_formulas.h"

namespace lightwell {
namespace {

constexpr double zenith = 1000, accepted = 0.003;
constexpr unsigned sky_only = static_cast<unsigned>(Technique::sky);
constexpr Sensor upwards{{0, 0, 0}, {0, 0, 1}};

/// A plain half sphere of constant luminance, or the scene language's overcast sky without ground.
Scene under(SkyGradation gradation, const Perturbation& p)
{
    Scene scene;
    if (gradation == SkyGradation::uniform) {
        scene.root.add_source({{0, 0, 1}, 180}, scene.add_material("glow", p.surroundings(zenith)), "sky");
        return scene;
    }
    SkyModel sky;
    sky.kind = CieSky::overcast;
    sky.zenith = p.zenith(zenith);
    add_sky(scene, sky);
    return scene;
}

Case tilt_case(const std::string& id, SkyGradation gradation)
{
    Case result{id, sky_only};
    Setup setup{[=](const Perturbation& p) { return under(gradation, p); }, {}};
    for (const double degrees : {0.0, 15.0, 30.0, 45.0, 60.0, 90.0, 120.0, 150.0}) {
        const double tilt = degrees * radians_per_degree, value = zenith * tilted_plane(gradation, tilt);
        result.references.emplace_back(numbered("tilt", degrees), value);
        const Check check = illuminance_check(numbered("tilt", degrees), value, accepted,
                                              {{0, 0, 0}, {std::sin(tilt), 0, std::cos(tilt)}});
        setup.checks.push_back(degrees <= 30 ? detecting(check) : check);
    }
    result.setups.push_back(setup);
    return result;
}

void add_roof(Scene& scene, double radius, double height)
{
    constexpr double wide = 1e5; // the horizon is closed but for h / wide
    scene.root.add_ring({{0, 0, height}, {0, 0, -1}, radius, wide}, scene.add_material("black", Plastic{}), "roof");
}

Case opening_case(const std::string& id, double radius, double height)
{
    Case result{id, sky_only};
    const double angle = std::atan2(radius, height);
    for (const SkyGradation gradation : {SkyGradation::uniform, SkyGradation::overcast}) {
        const char* name = gradation == SkyGradation::uniform ? "uniform" : "overcast";
        const double value = zenith * sky_cone(gradation, angle);
        result.references.emplace_back(name, value);
        const Check check = illuminance_check(name, value, accepted, upwards);
        result.setups.push_back({[=](const Perturbation& p) {
                                     Scene scene = under(gradation, p);
                                     add_roof(scene, radius, height);
                                     return scene;
                                 },
                                 {radius >= height ? detecting(check) : check}});
    }
    return result;
}

/// Uniform sky through a pane over a round opening: each ring of sky is dimmed by its angle.
Case glazed_opening_case()
{
    constexpr double radius = 1, height = 1, transmissivity = 0.96, index = 1.52;
    double expected = 0;
    for (const QuadratureNode& node : gauss_legendre(64, 0, std::atan2(radius, height)))
        expected +=
            node.weight * zenith * pi * std::sin(2 * node.x) * pane_transmittance(transmissivity, index, node.x);
    Case result{"own_glazed_opening", Technique::sky | Technique::glass};
    result.setups.push_back({[=](const Perturbation& p) {
                                 Scene scene = under(SkyGradation::uniform, p);
                                 add_roof(scene, radius, height);
                                 const double s = 2 * radius, z = height * 1.001;
                                 scene.root.add_polygon({{-s, -s, z}, {s, -s, z}, {s, s, z}, {-s, s, z}},
                                                        scene.add_material("glass", p.pane(transmissivity, index)),
                                                        "pane");
                                 return scene;
                             },
                             {detecting(illuminance_check("below", expected, accepted, upwards))}});
    return result;
}

} // namespace

std::vector<Case> sky_cases()
{
    return {tilt_case("cl_sky_uniform", SkyGradation::uniform), tilt_case("cl_sky_overcast", SkyGradation::overcast),
            opening_case("cl_round_opening_R0.5_h3", 0.5, 3),   opening_case("cl_round_opening_R1_h1", 1, 1),
            opening_case("cl_round_opening_R5_h0.5", 5, 0.5),   glazed_opening_case()};
}

} // namespace lightwell
