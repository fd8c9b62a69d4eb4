#include "engine/simulate/simulate.h"
#include "importers/surfaces/recover_surfaces.h"
#include "tests/unit/surfaces/walls.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

constexpr double radiance = 10; // W/(m^2 sr)

/// A lamp of 6 x 4 m in front of the wall, the wall, and a floor behind it.
Scene scene_with(const Mesh& wall, bool recover)
{
    Imported imported;
    KeyTable keys(imported);
    imported.scene.root.add_mesh(std::make_shared<const Mesh>(wall), keys.modifier_for(key_of_layer("wall")), "wall");
    if (recover)
        recover_surfaces(imported, {});
    Scene scene = std::move(imported.scene);
    scene.modifiers[0] = {"wall", Plastic{Spectrum::grey(0.7), 0, 0}, void_modifier};
    const ModifierId grey = scene.add_material("grey", Plastic{Spectrum::grey(0.3), 0, 0});
    const ModifierId lamp = scene.add_material("lamp", Light{Spectrum::grey(radiance)});
    scene.root.add_polygon({{-2, 0.25, 0}, {7, 0.25, 0}, {7, 6, 0}, {-2, 6, 0}}, grey, "floor");
    scene.root.add_polygon({{-1, -2, 0}, {-1, -2, 4}, {6, -2, 4}, {6, -2, 0}}, lamp, "lamp");
    return scene;
}

GridResult floor_light(const Mesh& wall, bool recover, std::uint64_t seed)
{
    SensorGrid grid;
    for (const double x : {1.5, 2.25, 3.0})
        for (const double y : {0.75, 1.5, 2.5})
            grid.sensors.push_back({{x, y, 0.001}, {0, 0, 1}});
    GridSettings settings;
    settings.samples = 1 << 13;
    settings.seed = seed;
    settings.unbiased = true;
    return Simulation(scene_with(wall, recover)).illuminance(grid, settings);
}

/// Beyond 6 standard errors of their difference with probability below 1e-5 each (t, 14 degrees of freedom); the mean
/// is known well enough to notice a twentieth.
void expect_same_light(const GridResult& a, const GridResult& b)
{
    ASSERT_EQ(a.values.size(), b.values.size());
    double sum_a = 0, sum_b = 0, squares = 0;
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        const double error = std::hypot(a.standard_errors[i].value, b.standard_errors[i].value);
        EXPECT_GT(a.values[i].value, 0);
        EXPECT_NEAR(a.values[i].value, b.values[i].value, 6 * error);
        sum_a += a.values[i].value;
        sum_b += b.values[i].value;
        squares += error * error;
    }
    const double most_off = 6 * std::sqrt(squares); // paths of different sensors are independent
    EXPECT_NEAR(sum_a, sum_b, most_off);
    EXPECT_LT(most_off, 0.05 * sum_a) << "too coarse to notice a twentieth";
}

TEST(SurfacesLight, TheFloorBehindTheWindowGetsTheSameLightThroughTenPolygonsAsThrough1196Triangles)
{
    expect_same_light(floor_light(wall_with_window(), false, 1), floor_light(wall_with_window(), true, 2));
}

TEST(SurfacesLight, AWallDrawnInsideOutGivesTheSameLight)
{
    for (const bool recover : {false, true}) {
        SCOPED_TRACE(recover);
        expect_same_light(floor_light(wall_with_window(), recover, 3),
                          floor_light(inside_out(wall_with_window()), recover, 4));
    }
}

} // namespace
} // namespace lightwell
