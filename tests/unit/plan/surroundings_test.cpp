#include "engine/plan/surroundings.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

Surroundings around_centre(const Scene& scene, Direction towards = {0, 0, 1})
{
    return look_around(scene, RayQueries(scene), {{{0, 0, 0}, towards, 0}});
}

TEST(Surroundings, AClosedSphereKeepsItsReflectanceAtEachBounce)
{
    for (const double reflectance : {0.0, 0.3, 0.9}) {
        Scene scene;
        scene.root.add_sphere({{0, 0, 0}, 2}, Shape::bubble,
                              scene.add_material("wall", Plastic{Spectrum::grey(reflectance)}), "shell");
        const Surroundings found = around_centre(scene);
        EXPECT_TRUE(found.enclosed());
        EXPECT_NEAR(found.kept_per_bounce, reflectance, 1e-9);
        EXPECT_NEAR(found.distance_m, 2, 1e-9);
    }
}

TEST(Surroundings, NothingAroundIsOpen)
{
    Scene scene; // far below, behind the lookout
    scene.root.add_sphere({{0, 0, -9}, 1}, Shape::sphere, scene.add_material("m", Plastic{}), "ball");
    const Surroundings found = around_centre(scene);
    EXPECT_EQ(found.open_share, 1);
    EXPECT_EQ(found.kept_per_bounce, 0);
}

TEST(Surroundings, ADiscAboveCoversItsShareOfTheCosine)
{
    Scene scene; // form factor R^2 / (R^2 + h^2) = 1/2
    scene.root.add_ring({{0, 0, 1}, {0, 0, -1}, 0, 1}, scene.add_material("m", Plastic{Spectrum::grey(0.5)}), "disc");
    EXPECT_NEAR(around_centre(scene).open_share, 0.5, 0.09); // four standard errors of 512 walks
    EXPECT_EQ(around_centre(scene).kept_per_bounce, 0) << "what it reflects escapes";
}

TEST(Surroundings, PanesAndMirrorsArePassedAtTheirPrice)
{
    for (const bool mirror : {false, true}) {
        Scene scene;
        scene.root.add_sphere({{0, 0, 0}, 2}, Shape::bubble, scene.add_material("wall", Plastic{Spectrum::grey(0.5)}),
                              "shell");
        const ModifierId extra = mirror ? scene.add_material("mirror", Mirror{Spectrum::grey(0.5)})
                                        : scene.add_material("pane", Glass{Spectrum::grey(0.5)});
        scene.root.add_sphere({{0, 0, 0}, 1}, Shape::sphere, extra, "inner");
        const Surroundings found =
            mirror ? look_around(scene, RayQueries(scene), {{{0, 0, 1.5}, {0, 0, 1}, 0}}) : around_centre(scene);
        EXPECT_LT(found.kept_per_bounce, 0.5);
        EXPECT_GT(found.kept_per_bounce, 0.2);
        EXPECT_TRUE(found.enclosed());
    }
}

TEST(Surroundings, AnEndlessRowOfMirrorsEnds)
{
    Scene scene;
    scene.root.add_sphere({{0, 0, 0}, 1}, Shape::bubble, scene.add_material("m", Mirror{Spectrum::grey(1)}), "trap");
    EXPECT_EQ(around_centre(scene).kept_per_bounce, 0);
}

} // namespace
} // namespace lightwell
