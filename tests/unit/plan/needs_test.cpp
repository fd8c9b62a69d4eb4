#include "engine/plan/needs.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightwell {
namespace {

/// A square of side 2 at height z.
void add_square(Part& part, ModifierId modifier, double z)
{
    part.add_polygon({{0, 0, z}, {2, 0, z}, {2, 2, z}, {0, 2, z}}, modifier, "square");
}

Scene grey_room()
{
    Scene scene;
    add_square(scene.root, scene.add_material("white", Plastic{Spectrum::grey(0.8)}), 0);
    add_square(scene.root, scene.add_material("grey", Plastic{Spectrum::grey(0.4)}), 2);
    add_square(scene.root, scene.add_material("lamp", Light{Spectrum::grey(10)}), 1);
    return scene;
}

TEST(SceneNeeds, APlainRoomNeedsDiffuseSurfacesAndLampsAlone)
{
    const SceneNeeds needs = needs_of(grey_room());
    EXPECT_EQ(needs.surfaces, 3);
    EXPECT_DOUBLE_EQ(needs.area_m2, 12);
    EXPECT_EQ(needs.diffuse_reflection.usage.surfaces, 2);
    EXPECT_DOUBLE_EQ(needs.diffuse_reflection.reflectance, 0.6);
    EXPECT_DOUBLE_EQ(needs.mean_reflectance, 0.6);
    EXPECT_DOUBLE_EQ(needs.highest_reflectance, 0.8);
    EXPECT_EQ(needs.lamps.surfaces, 1);
    EXPECT_NEAR(needs.lamp_flux_lm, 179 * pi * 10 * 4, 1e-9);
    EXPECT_TRUE(needs.grey);
    for (const Need* none : {&needs.diffuse_transmission, &needs.glossy, &needs.smooth, &needs.panes, &needs.bodies,
                             &needs.planar_mirrors, &needs.curved_mirrors})
        EXPECT_FALSE(*none);
    EXPECT_EQ(needs.suns + needs.wide_sources, 0);
    EXPECT_FALSE(needs.patterned);
}

TEST(SceneNeeds, EachKindOfMaterialIsToldApart)
{
    Scene scene = grey_room();
    add_square(scene.root, scene.add_material("pane", Glass{Spectrum::grey(0.9)}), 3);
    add_square(scene.root, scene.add_material("glossy", Plastic{Spectrum::grey(0.5), 0.05, 0.1}), 4);
    add_square(scene.root, scene.add_material("varnish", Plastic{Spectrum::grey(0.5), 0.05, 0}), 5);
    add_square(scene.root, scene.add_material("paper", Trans{Spectrum::grey(0.5), 0, 0, 0.6, 0}), 6);
    scene.root.add_sphere({{9, 9, 9}, 1}, Shape::sphere, scene.add_material("body", Dielectric{Spectrum::grey(1)}),
                          "b");
    const ModifierId mirror = scene.add_material("mirror", Mirror{Spectrum::grey(0.9)});
    add_square(scene.root, mirror, 7);
    scene.root.add_sphere({{9, 9, 0}, 1}, Shape::sphere, mirror, "ball");
    const SceneNeeds needs = needs_of(scene);
    EXPECT_EQ(needs.panes.usage.surfaces, 1);
    EXPECT_EQ(needs.glossy.usage.surfaces, 1);
    EXPECT_EQ(needs.smooth.usage.surfaces, 1);
    EXPECT_EQ(needs.diffuse_transmission.usage.surfaces, 1);
    EXPECT_NEAR(needs.diffuse_transmission.reflectance, 0.3, 1e-12); // 0.5 colour, 0.6 of it passes
    EXPECT_EQ(needs.bodies.usage.surfaces, 1);
    EXPECT_EQ(needs.planar_mirrors.usage.surfaces, 1);
    EXPECT_DOUBLE_EQ(needs.planar_mirrors.usage.area_m2, 4);
    EXPECT_EQ(needs.curved_mirrors.usage.surfaces, 1);
    EXPECT_NEAR(needs.curved_mirrors.usage.area_m2, 4 * pi, 1e-9);
    EXPECT_NEAR(needs.curved_mirrors.reflectance, 0.9, 1e-12);
}

TEST(SceneNeeds, AFlatMeshIsAPlanarMirrorAndABentOneIsNot)
{
    for (const double lift : {0.0, 0.1}) {
        Scene scene;
        const ModifierId mirror = scene.add_material("mirror", Mirror{Spectrum::grey(0.9)});
        auto mesh = std::make_shared<Mesh>();
        mesh->points = {{0, 0, 0}, {1, 0, 0}, {1, 1, lift}, {0, 1, 0}};
        mesh->triangles = {0, 1, 2, 0, 2, 3};
        scene.root.add_mesh(mesh, mirror, "m");
        const SceneNeeds needs = needs_of(scene);
        EXPECT_EQ(needs.planar_mirrors.usage.surfaces, lift == 0 ? 1 : 0);
        EXPECT_EQ(needs.curved_mirrors.usage.surfaces, lift == 0 ? 0 : 1);
    }
}

TEST(SceneNeeds, SunSkyAndPatternAreFoundAndTheirColourCounts)
{
    Scene scene;
    const ModifierId bright = scene.add_modifier({"bright", SkyBrightness{}});
    const ModifierId sky = scene.add_material("sky", Glow{Spectrum::grey(1)}, bright);
    scene.root.add_source({{0, 0, 1}, 180}, sky, "dome");
    scene.root.add_source({{0, 0, 1}, 0.533}, scene.add_material("solar", Light{{9, 8, 7}}), "sun");
    scene.root.add_source({{0, 0, 1}, 0.533}, scene.add_material("dark", Light{}), "eclipse");
    const SceneNeeds needs = needs_of(scene);
    EXPECT_EQ(needs.suns, 1);
    EXPECT_EQ(needs.wide_sources, 1);
    EXPECT_TRUE(needs.patterned);
    EXPECT_FALSE(needs.grey);
    EXPECT_EQ(needs.lamps.surfaces, 0) << "distant sources are no lamps";
    EXPECT_TRUE(needs.lit());
}

TEST(SceneNeeds, ASpotlightSendsTheFluxOfItsConeAlone)
{
    Scene scene;
    const ModifierId spot = scene.add_material("spot", Spotlight{Spectrum::grey(100), 60});
    scene.root.add_ring({{0, 0, 3}, {0, 0, -1}, 0, 0.1}, spot, "spot");
    const SceneNeeds needs = needs_of(scene);
    EXPECT_EQ(needs.spotlights.surfaces, 1);
    // L A pi sin^2(30 degrees)
    EXPECT_NEAR(needs.lamp_flux_lm, 179 * 100 * pi * 0.01 * pi * 0.25, 1e-9);
}

TEST(SceneNeeds, ABillionCopiesAreCountedWithoutVisitingThem)
{
    Scene scene;
    const ModifierId inherited = scene.add_modifier({"0", Inherited{}});
    const ModifierId leaf = scene.add_material("leaf", Plastic{{0.1, 0.3, 0.1}});
    scene.prototypes.resize(9);
    add_square(scene.prototypes[0], inherited, 0);
    for (std::uint32_t level = 1; level < 9; ++level)
        for (int copy = 0; copy < 14; ++copy)
            scene.prototypes[level].add_instance({level - 1, Affine::scale(0.5), {}}, "copy");
    scene.root.add_instance({8, Affine{}, {{inherited, leaf}}}, "forest");
    const SceneNeeds needs = needs_of(scene);
    EXPECT_EQ(needs.diffuse_reflection.usage.surfaces, std::pow(14, 8));
    EXPECT_NEAR(needs.area_m2, 4 * std::pow(14 * 0.25, 8), 1e-6 * std::pow(3.5, 8));
    EXPECT_FALSE(needs.grey);
}

TEST(SceneNeeds, DirectLightIsAllThereIsUntilASurfaceSendsLightOn)
{
    Scene black;
    add_square(black.root, black.add_material("black", Plastic{}), 0);
    add_square(black.root, black.add_material("lamp", Light{Spectrum::grey(10)}), 1);
    EXPECT_TRUE(needs_of(black).only_direct());
    EXPECT_FALSE(needs_of(grey_room()).only_direct());
    for (const Material& sends_on :
         {Material{Plastic{Spectrum{}, 0.05, 0.1}}, Material{Mirror{Spectrum::grey(0.9)}}, Material{Glass{}},
          Material{Dielectric{Spectrum::grey(1)}}, Material{Mist{}}, Material{Illum{Spectrum::grey(1), {}}}}) {
        Scene scene = black;
        add_square(scene.root, scene.add_material("other", sends_on), 2);
        EXPECT_FALSE(needs_of(scene).only_direct()) << sends_on.index();
    }
}

TEST(SceneNeeds, AnEmptySceneNeedsNothing)
{
    const SceneNeeds needs = needs_of(Scene{});
    EXPECT_FALSE(needs.lit());
    EXPECT_FALSE(needs.scatters());
    EXPECT_EQ(needs.mean_reflectance, 0);
}

TEST(BouncesThatMatter, FollowTheGeometricSeries)
{
    EXPECT_EQ(bounces_that_matter(0.5, 0.01), 7); // 0.5^7 = 0.0078 <= 0.01 < 0.5^6
    EXPECT_EQ(bounces_that_matter(0.9, 0.01), 44);
    EXPECT_EQ(bounces_that_matter(0, 0.01), 0);
    EXPECT_EQ(bounces_that_matter(0.5, 1), 0);
    EXPECT_EQ(bounces_that_matter(1, 0.01), bounces_that_matter(0.5, 0));
    EXPECT_EQ(bounces_that_matter(std::nan(""), 0.01), 0);
}

} // namespace
} // namespace lightwell
