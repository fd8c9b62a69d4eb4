#include "engine/scene/add_sky.h"
#include "engine/simulate/simulate.h"

#include <gtest/gtest.h>

/// \file A stage that a scene does not need is not built.
namespace lightwell {
namespace {

/// A diffuse room under a lamp: nothing in it mirrors, lets light through or varies.
Scene plain_room()
{
    Scene scene;
    const ModifierId wall = scene.add_material("wall", Plastic{Spectrum::grey(0.5)});
    const ModifierId lamp = scene.add_material("lamp", Light{Spectrum::grey(10)});
    scene.root.add_sphere({{0, 0, 0}, 3}, Shape::bubble, wall, "room");
    scene.root.add_sphere({{0, 0, 1}, 0.1}, Shape::sphere, lamp, "lamp");
    return scene;
}

void add_square(Scene& scene, const Material& material, double z)
{
    const ModifierId modifier = scene.add_material("square", material);
    scene.root.add_polygon({{-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}}, modifier, "square");
}

GridResult light_on_a_desk(const Simulation& simulation)
{
    SensorGrid grid;
    grid.sensors = {{{0, 0, -1}, {0, 0, 1}}};
    GridSettings settings;
    settings.samples = 8;
    return simulation.illuminance(grid, settings);
}

TEST(Stages, OfASceneWithoutMirrorsPatternsAndTranslucencyNoneOfTheirsIsBuilt)
{
    const Simulation simulation(plain_room());
    const PreparedStages built = simulation.prepared();
    EXPECT_EQ(built.lamps, 1u);
    EXPECT_EQ(built.suns, 0u);
    EXPECT_EQ(built.openings, 0u);
    EXPECT_EQ(built.mirrors, 0u);
    EXPECT_EQ(built.virtual_sources, 0u);
    EXPECT_EQ(built.see_through, 0u);
    EXPECT_EQ(built.both_sides, 0u);
    EXPECT_EQ(built.patterns, 0u);
}

TEST(Stages, EachIsBuiltForWhatNeedsIt)
{
    Scene mirrored = plain_room();
    add_square(mirrored, Mirror{Spectrum::grey(0.9)}, -2);
    EXPECT_EQ(Simulation(std::move(mirrored)).prepared().virtual_sources, 1u);

    Scene translucent = plain_room();
    add_square(translucent, Trans{Spectrum::grey(0.8), 0, 0, 0.5, 0.5}, -2);
    const PreparedStages sheet = Simulation(std::move(translucent)).prepared();
    EXPECT_EQ(sheet.both_sides, 1u);
    EXPECT_EQ(sheet.see_through, 1u);
    EXPECT_EQ(sheet.mirrors, 0u);

    Scene glazed = plain_room();
    add_square(glazed, Glass{Spectrum::grey(0.9)}, -2);
    SkyModel sky;
    sky.kind = CieSky::overcast;
    sky.zenith = 10;
    add_sky(glazed, sky);
    const PreparedStages window = Simulation(std::move(glazed)).prepared();
    EXPECT_EQ(window.openings, 1u);
    EXPECT_EQ(window.see_through, 1u);
    EXPECT_GT(window.patterns, 0u);
    EXPECT_EQ(window.mirrors, 0u);
}

/// A disc of radius 1 at height 2 over black surfaces, one of which hides half of it from the sensor: E is half of
/// pi L R^2 / (R^2 + h^2). Without ambient light there is nothing to prepare.
TEST(Stages, WhereLightEndsOnBlackSurfacesOnlyShadowRaysAreTraced)
{
    Scene scene;
    scene.root.add_ring({{0, 0, 2}, {0, 0, -1}, 0, 1}, scene.add_material("lamp", Light{Spectrum::grey(10)}), "disc");
    const ModifierId black = scene.add_material("black", Plastic{});
    scene.root.add_polygon({{0, -9, 1}, {9, -9, 1}, {9, 9, 1}, {0, 9, 1}}, black, "screen");
    SensorGrid grid;
    grid.sensors = {{{0, 0, 0}, {0, 0, 1}}};
    const GridResult found = Simulation(std::move(scene)).illuminance(grid, {});
    EXPECT_EQ(found.work.ambient_rays.total(), 0);
    EXPECT_EQ(found.work.deep_sites, 0u);
    EXPECT_EQ(found.work.value_rays.total(), found.work.value_rays.shadow);
    const double expected = 0.5 * pi * 10 * lumens_per_watt * 1 / (1 + 4.0);
    EXPECT_NEAR(found.values[0].value, expected, 5 * found.standard_errors[0].value);
    EXPECT_LT(found.standard_errors[0].value, 0.01 * expected);
    EXPECT_GT(found.standard_errors[0].value, 0);
}

/// One bright lamp in sight, sixty dim ones behind a screen that together would give a twentieth: they must not be
/// taken to be as visible as the one that was tested.
TEST(Stages, DimLampsThatAScreenHidesAddNothingWhereOnlyShadowRaysAreTraced)
{
    Scene scene;
    const ModifierId bright = scene.add_material("bright", Light{Spectrum::grey(1000)});
    const ModifierId dim = scene.add_material("dim", Light{Spectrum::grey(1)});
    constexpr double radius = 0.1, height = 2;
    scene.root.add_ring({{0, 0, height}, {0, 0, -1}, 0, radius}, bright, "lamp");
    for (int i = 0; i < 60; ++i)
        scene.root.add_ring({{4, 0.25 * (i - 30), height}, {-0.8, 0, -0.6}, 0, radius}, dim, "row");
    const ModifierId black = scene.add_material("black", Plastic{});
    scene.root.add_polygon({{2, -20, -1}, {2, 20, -1}, {2, 20, 3}, {2, -20, 3}}, black, "screen");
    SensorGrid grid;
    grid.sensors = {{{0, 0, 0}, {0, 0, 1}}};
    const GridResult found = Simulation(std::move(scene)).illuminance(grid, {});
    EXPECT_EQ(found.work.ambient_rays.total(), 0);
    const double expected = pi * 1000 * lumens_per_watt * radius * radius / (radius * radius + height * height);
    EXPECT_NEAR(found.values[0].value, expected, 1e-9 * expected);
}

TEST(Stages, WhatThePlanSwitchesOffIsNotBuilt)
{
    const auto mirrored = [] {
        Scene scene = plain_room();
        add_square(scene, Mirror{Spectrum::grey(0.9)}, -2);
        return scene;
    };
    Preparation none;
    none.virtual_sources = false;
    const Simulation without(mirrored(), none);
    EXPECT_FALSE(without.plan().uses(StageKind::virtual_sources));
    EXPECT_EQ(without.prepared().mirrors, 0u);
    const Simulation with(mirrored());
    EXPECT_TRUE(with.plan().uses(StageKind::virtual_sources));
    EXPECT_EQ(with.prepared().mirrors, 1u);
}

/// A plain room costs no ray more for what other scenes need: with techniques off that it has no use for, each ray is
/// the same.
TEST(Stages, OfOthersCostAPlainRoomNothing)
{
    Preparation none;
    none.virtual_sources = false;
    none.direct.tree = false;
    const GridResult with = light_on_a_desk(Simulation(plain_room()));
    const GridResult without = light_on_a_desk(Simulation(plain_room(), none));
    EXPECT_EQ(with.work.rays(), without.work.rays());
    EXPECT_EQ(with.values[0].value, without.values[0].value);
}

} // namespace
} // namespace lightwell
