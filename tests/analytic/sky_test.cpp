#include "tests/analytic/expect.h"

#include "engine/scene/add_sky.h"

namespace lightwell {
namespace {

Scene under_sky(CieSky kind, double zenith_cd_per_m2)
{
    Scene scene;
    SkyModel sky;
    sky.kind = kind;
    sky.zenith = zenith_cd_per_m2 / lumens_per_watt;
    add_sky(scene, sky);
    return scene;
}

/// Uniform sky: E = pi L. CIE overcast sky L = Lz (1 + 2 sin h) / 3: E = 7 pi Lz / 9.
TEST(Sky, UnobstructedHorizontalIlluminanceIsTheClosedForm)
{
    const Simulation uniform(under_sky(CieSky::uniform, 1000)), overcast(under_sky(CieSky::overcast, 1000));
    expect_agrees(illuminance_at(uniform, {{0, 0, 0}, {0, 0, 1}}, 1 << 14), 1000 * pi, 0.005);
    expect_agrees(illuminance_at(overcast, {{0, 0, 0}, {0, 0, 1}}, 1 << 14), 1000 * pi * 7 / 9, 0.005);
}

/// Round hole of radius R at height h in an opaque roof, uniform sky: E = pi L R^2 / (R^2 + h^2).
TEST(Sky, ARoundRoofOpeningIsADiscOfSky)
{
    for (const double radius : {0.5, 5.0}) {
        SCOPED_TRACE(radius);
        Scene scene = under_sky(CieSky::uniform, 1000);
        scene.root.add_ring({{0, 0, 3}, {0, 0, -1}, radius, 1e5}, scene.add_material("black", Plastic{}), "roof");
        const Simulation simulation(std::move(scene));
        expect_agrees(illuminance_at(simulation, {{0, 0, 0}, {0, 0, 1}}, 1 << 19),
                      1000 * pi * radius * radius / (radius * radius + 9), 0.02);
    }
}

/// A glazed opening passes the sky times the pane's transmittance by angle, here nearly normal: 88.1 %. A round wall
/// keeps out the sky beyond the rim of the roof.
TEST(Sky, AGlazedOpeningIsFoundByItsPaneAndDimmedByIt)
{
    Scene scene = under_sky(CieSky::uniform, 1000);
    const ModifierId black = scene.add_material("black", Plastic{});
    const ModifierId glass = scene.add_material("glass", Glass{Spectrum::grey(0.96), 1.52});
    const double r = 0.25, half = 0.5 * std::sqrt(pi) * r;
    scene.root.add_ring({{0, 0, 5}, {0, 0, -1}, r, 20}, black, "roof");
    scene.root.add_cone({{{0, 0, -1}, {0, 0, 5.02}}, {20, 20}}, Shape::tube, black, "wall");
    scene.root.add_polygon({{-1.15 * half, -1.15 * half, 5.01},
                            {1.15 * half, -1.15 * half, 5.01},
                            {1.15 * half, 1.15 * half, 5.01},
                            {-1.15 * half, 1.15 * half, 5.01}},
                           glass, "pane");
    const Simulation simulation(std::move(scene));
    expect_agrees(illuminance_at(simulation, {{0, 0, 0}, {0, 0, 1}}, 1 << 19), 0.881 * 1000 * pi * r * r / (r * r + 25),
                  0.02, 2e-3);
}

} // namespace
} // namespace lightwell
