// What has no number: scenes that are odd, empty, ambiguous or wrong.

#include "tests/extremes/extremes.h"

#include "engine/base/errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lightwell {
namespace {

constexpr double base_luminance = 1000;
constexpr int direct_samples = 64;

/// One rule for surfaces in one place: every ray meets the same one of them, whoever asks.
TEST(Extremes, CoincidentSurfacesAnswerAsOne)
{
    for (const int copies : {2, 8, 200}) {
        Scene scene;
        scene.root.add_source({{0, 0, 1}, 360}, scene.add_material("glow", Glow{Spectrum::grey(1), 0}), "all_around");
        const ModifierId dark = scene.add_material("dark", Plastic{{0.2, 0.2, 0.2}, 0, 0});
        const ModifierId bright = scene.add_material("bright", Plastic{{0.8, 0.8, 0.8}, 0, 0});
        for (int i = 0; i < copies; ++i)
            scene.root.add_polygon({{-1, -1, 0.3}, {1, -1, 0}, {1, 1, -0.3}, {-1, 1, 0}}, i % 2 == 0 ? dark : bright,
                                   "s");
        const Simulation simulation(std::move(scene));
        View view;
        view.position = {0, 0, 3};
        view.direction = {0, 0, -1};
        view.up = {0, 1, 0};
        view.horizontal = view.vertical = 20;
        PictureSettings settings;
        settings.width = settings.height = 16;
        settings.samples = 64;
        settings.unbiased = true;
        settings.threads = 1;
        const Picture one = simulation.render(view, settings).picture;
        settings.threads = 3;
        EXPECT_EQ(simulation.render(view, settings).picture.channels.at("G"), one.channels.at("G"));
        const std::vector<float>& seen = one.channels.at("G");
        const float first = seen[0] > 0.5F ? 0.8F : 0.2F;
        for (const float value : seen)
            EXPECT_NEAR(value, first, 0.05) << copies;
    }
}

Scene with_polygon(const std::vector<Point>& corners)
{
    Scene scene;
    add_lamp(scene, base_square(), base_luminance, {0, 0, 0});
    scene.root.add_polygon(corners, scene.add_material("grey", Plastic{{0.5, 0.5, 0.5}, 0, 0}), "odd");
    return scene;
}

TEST(Extremes, WhatIsNotANumberOrNotPossibleIsRefusedByName)
{
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    const auto refused = [](const char* what, const Scene& scene) {
        EXPECT_THROW(Simulation{Scene(scene)}, InputError) << what;
    };
    refused("NaN corner", with_polygon({{0, 0, 0}, {1, nan, 0}, {1, 1, 0}}));
    refused("infinite corner", with_polygon({{0, 0, 0}, {1, inf, 0}, {1, 1, 0}}));
    refused("two corners", with_polygon({{0, 0, 0}, {1, 0, 0}}));
    const auto ball = [](double radius, const Material& material) {
        Scene scene;
        scene.root.add_sphere({{0, 0, 0}, radius}, Shape::sphere, scene.add_material("m", material), "ball");
        return scene;
    };
    refused("infinite radius", ball(inf, Light{Spectrum::grey(1)}));
    refused("negative radius", ball(-1, Light{Spectrum::grey(1)}));
    refused("luminance NaN", ball(1, Light{Spectrum::grey(nan)}));
    refused("infinite luminance", ball(1, Light{Spectrum::grey(inf)}));
    refused("reflectance 1.2", ball(1, Plastic{Spectrum::grey(1.2), 0, 0}));
    Scene unknown;
    unknown.root.add_sphere({{0, 0, 0}, 1}, Shape::sphere, 7, "ball");
    refused("unknown material", unknown);
    Scene circular;
    circular.prototypes.resize(1);
    circular.prototypes[0].add_instance({0, Affine{}, {}}, "itself");
    refused("instance of itself", circular);
    const Simulation good(with_polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}));
    View view;
    view.direction = {0, 0, 0};
    EXPECT_THROW(good.render(view, {}), InputError);
    view.direction = {0, 0, 1};
    view.up = {0, 0, 1};
    EXPECT_THROW(good.render(view, {}), InputError);
    view.up = {0, 1, 0};
    PictureSettings none;
    none.width = 0;
    EXPECT_THROW(good.render(view, none), InputError);
}

TEST(Extremes, WhatHasNoAreaAndWhatIsNotFlatIsNoTrouble)
{
    Scene alone;
    add_lamp(alone, base_square(), base_luminance, {0, 0, 0});
    const std::vector<double> plain = illuminance_at(alone, base_sensors(), direct_samples).values;
    for (const std::vector<Point>& odd : {std::vector<Point>{{5, 5, 0}, {6, 5, 0}, {7, 5, 0}},
                                          std::vector<Point>{{5, 5, 0}, {6, 5, 0.001}, {6, 6, 0}, {5, 6, 0.001}}}) {
        const ExtremeValues found = illuminance_at(with_polygon(odd), base_sensors(), direct_samples);
        for (std::size_t i = 0; i < plain.size(); ++i) {
            EXPECT_TRUE(std::isfinite(found.values[i]));
            EXPECT_NEAR(found.values[i], plain[i], 0.01 * plain[i]);
        }
    }
}

TEST(Extremes, EmptyScenesAreBlackAndScenesOfLightAloneAreLit)
{
    const Sensor up{{0, 0, 0}, {0, 0, 1}};
    EXPECT_EQ(illuminance_at(Scene{}, {up}, 8).values[0], 0);
    Scene geometry;
    geometry.root.add_sphere({{0, 0, 0}, 1}, Shape::bubble,
                             geometry.add_material("wall", Plastic{Spectrum::grey(0.5), 0, 0}), "wall");
    EXPECT_EQ(illuminance_at(geometry, {up}, 8).values[0], 0);
    Scene light;
    light.root.add_source({{0, 0, 1}, 180}, light.add_material("glow", Glow{Spectrum::grey(1 / lumens_per_watt), 0}),
                          "sky");
    const ExtremeValues lit = illuminance_at(light, {up}, 4096);
    EXPECT_NEAR(lit.values[0], pi, 4 * lit.errors[0] + 1e-3);
}

TEST(Extremes, FromMirrorsToTheRoughestMetalNoLightIsMade)
{
    constexpr double tolerance = 0.005;
    for (const double roughness : {0.0, 1e-8, 1e-4, 0.01, 0.1, 0.5, 1.0})
        for (const double degrees : {0.0, 45.0, 80.0, 89.0}) {
            double error = 0;
            const double seen = seen_in_furnace(roughness, degrees, error);
            EXPECT_LE(seen, 1 + tolerance + 4 * error) << roughness << " at " << degrees;
            if (roughness < 0.01) {
                EXPECT_NEAR(seen, 1, tolerance + 4 * error) << roughness << " at " << degrees;
            } else {
                EXPECT_GT(seen, 0.1) << roughness << " at " << degrees;
            }
        }
}

TEST(Extremes, TheNumberOfThreadsChangesNoBit)
{
    const Simulation simulation(white_box(0.8));
    SensorGrid grid;
    grid.sensors = {{{2, 2, 0}, {0, 0, 1}}, {{1.3, 2.2, 1.7}, {0, 0, 1}}};
    const auto run = [&](int threads) {
        GridSettings settings;
        settings.accuracy = 0.05;
        settings.threads = threads;
        return simulation.illuminance(grid, settings).values;
    };
    const std::vector<Illuminance> one = run(1);
    for (const int threads : {2, 7, 64})
        EXPECT_EQ(run(threads), one) << threads;
}

} // namespace
} // namespace lightwell
