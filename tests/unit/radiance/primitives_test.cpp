#include "tests/unit/radiance/scene_folder.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

const std::string red = "void plastic red\n0\n0\n5 .7 .1 .1 .02 .05\n";

TEST(ScenePrimitives, APolygonKeepsItsCornersTheirOrderAndItsNames)
{
    const SceneFolder folder;
    const Scene scene = folder.read(red + "red polygon quad 0 0 12\n 0 0 0 1 0 0 1 2 .5 0 2 .5");
    ASSERT_EQ(scene.root.surfaces.size(), 1u);
    EXPECT_EQ(scene.root.surfaces[0].name, "quad");
    EXPECT_EQ(scene.modifiers[0].name, "red");
    ASSERT_EQ(scene.root.points.size(), 4u);
    EXPECT_EQ(scene.root.points[2], (Point{1, 2, 0.5}));
    // sqrt(2^2 + 0.5^2) wide, 1 long
    EXPECT_NEAR(surface_area_m2(scene.root, scene.root.surfaces[0]), 2.0615528128088303, 1e-15);
}

TEST(ScenePrimitives, EveryRoundShapeKeepsItsNumbers)
{
    const SceneFolder folder;
    const Scene scene = folder.read(red + R"(
red sphere s 0 0 4 1 2 3 .5
red bubble b 0 0 4 1 2 3 .25
red cone c 0 0 8 0 0 0 0 0 1 .5 .2
red cup u 0 0 8 3 0 0 3 .5 1 .2 .7
red cylinder y 0 0 7 0 0 0 1 2 2 .05
red tube t 0 0 7 2 0 0 2 0 2 .3
red ring r 0 0 8 1 1 1 0 0 2 .4 .1
red source q 0 0 4 0 0 -3 .5)");
    const Part& part = scene.root;
    ASSERT_EQ(part.surfaces.size(), 8u);
    const Shape expected[] = {Shape::sphere,   Shape::bubble, Shape::cone, Shape::cup,
                              Shape::cylinder, Shape::tube,   Shape::ring, Shape::source};
    for (std::size_t i = 0; i < 8; ++i)
        EXPECT_EQ(part.surfaces[i].shape, expected[i]) << part.surfaces[i].name;
    EXPECT_EQ(part.spheres[1].radius, 0.25);
    EXPECT_EQ(part.cones[1].ends[1], (Point{3, 0.5, 1}));
    EXPECT_EQ(part.cones[1].radii[1], 0.7);
    EXPECT_EQ(part.cones[2].radii[0], 0.05);
    EXPECT_EQ(part.cones[2].radii[1], 0.05);
    EXPECT_EQ(part.rings[0].inner_radius, 0.1); // smaller first, whatever the order in the text
    EXPECT_EQ(part.rings[0].outer_radius, 0.4);
    EXPECT_EQ(part.rings[0].normal, (Direction{0, 0, 1}));
    EXPECT_EQ(part.sources[0].to_source, (Direction{0, 0, -1}));
    EXPECT_EQ(part.sources[0].full_angle_deg, 0.5);
}

TEST(ScenePrimitives, ANegativeRadiusTurnsARoundShapeInsideOut)
{
    const SceneFolder folder;
    const Scene scene = folder.read(red + "red sphere s 0 0 4 0 0 0 -2 red bubble b 0 0 4 0 0 0 -2 "
                                          "red cylinder c 0 0 7 0 0 0 0 0 1 -1 red cup u 0 0 8 0 0 0 0 0 1 -1 0");
    EXPECT_EQ(scene.root.surfaces[0].shape, Shape::bubble);
    EXPECT_EQ(scene.root.surfaces[1].shape, Shape::sphere);
    EXPECT_EQ(scene.root.surfaces[2].shape, Shape::tube);
    EXPECT_EQ(scene.root.surfaces[3].shape, Shape::cone);
    EXPECT_EQ(scene.root.spheres[0].radius, 2);
}

TEST(ScenePrimitives, EveryMaterialKeepsItsNumbers)
{
    const SceneFolder folder;
    const Scene scene = folder.read(R"(
void plastic a 0 0 5 .1 .2 .3 .04 .05
void metal b 0 0 5 .1 .2 .3 .4 .05
void trans c 0 0 7 .1 .2 .3 .04 .05 .6 .7
void dielectric d 0 0 5 .1 .2 .3 1.5 -7
void glass e 0 0 3 .1 .2 .3
void glass f 0 0 4 .1 .2 .3 1.4
void mirror g 0 0 3 .1 .2 .3
void light h 0 0 3 10 20 30
void illum i 1 a 0 3 1 2 3
void illum j 0 0 3 1 2 3
void glow k 0 0 4 1 2 3 -4
void spotlight l 0 0 7 1 2 3 25 0 .6 -.8
)");
    const auto material = [&](std::size_t i) { return std::get<Material>(scene.modifiers[i].what); };
    EXPECT_EQ(std::get<Plastic>(material(0)).roughness, 0.05);
    EXPECT_EQ(std::get<Metal>(material(1)).specularity, 0.4);
    EXPECT_EQ(std::get<Trans>(material(2)).transmission, 0.6);
    EXPECT_EQ(std::get<Trans>(material(2)).transmitted_specular, 0.7);
    EXPECT_EQ(std::get<Dielectric>(material(3)).index, 1.5);
    EXPECT_EQ(std::get<Dielectric>(material(3)).hartmann, -7);
    EXPECT_EQ(std::get<Glass>(material(4)).index, 1.52);
    EXPECT_EQ(std::get<Glass>(material(5)).index, 1.4);
    EXPECT_EQ(std::get<Mirror>(material(6)).reflectance, (Spectrum{0.1, 0.2, 0.3}));
    EXPECT_EQ(std::get<Light>(material(7)).radiance, (Spectrum{10, 20, 30}));
    EXPECT_EQ(std::get<Illum>(material(8)).alternate, "a");
    EXPECT_EQ(std::get<Illum>(material(9)).alternate, "");
    EXPECT_EQ(std::get<Glow>(material(10)).max_radius_m, -4);
    EXPECT_EQ(std::get<Spotlight>(material(11)).full_angle_deg, 25);
    EXPECT_EQ(std::get<Spotlight>(material(11)).aim, (Vec3{0, 0.6, -0.8}));
}

TEST(SceneModifiers, TheLastDefinitionBeforeItsUseCounts)
{
    const SceneFolder folder;
    const Scene scene = folder.read("void plastic m 0 0 5 .1 .1 .1 0 0 m sphere one 0 0 4 0 0 0 1 "
                                    "void plastic m 0 0 5 .2 .2 .2 0 0 m sphere two 0 0 4 5 0 0 1");
    const auto colour = [&](std::size_t i) {
        return std::get<Plastic>(*resolve(scene, scene.root.surfaces[i].modifier).material).colour.r;
    };
    EXPECT_EQ(colour(0), 0.1);
    EXPECT_EQ(colour(1), 0.2);
}

TEST(SceneModifiers, AnAliasNamesALayerAndNamesAreDecoded)
{
    const SceneFolder folder;
    const Scene scene = folder.read(red + "void alias A%20WALL%C3%9C red\nA%20WALL%C3%9C sphere s%231 0 0 4 0 0 0 1");
    const Surface& surface = scene.root.surfaces[0];
    EXPECT_EQ(surface.name, "s#1");
    EXPECT_EQ(scene.modifiers[static_cast<std::size_t>(surface.modifier)].name, "A WALL\xC3\x9C");
    EXPECT_EQ(std::get<Plastic>(*resolve(scene, surface.modifier).material).colour.r, 0.7);
}

TEST(SceneModifiers, AnAliasKeepsAPatternOnlyWhenItInherits)
{
    const SceneFolder folder;
    const Scene scene = folder.read("void brightfunc skyfunc 2 skybr skybright.cal 0 3 2 40 6 "
                                    "skyfunc glow g 0 0 4 1 1 1 0 inherit alias with g void alias without g "
                                    "with source a 0 0 4 0 0 1 180 without source b 0 0 4 0 0 1 180");
    const ResolvedMaterial with = resolve(scene, scene.root.surfaces[0].modifier);
    const ResolvedMaterial without = resolve(scene, scene.root.surfaces[1].modifier);
    ASSERT_NE(with.brightness, nullptr);
    EXPECT_EQ(with.brightness->kind, SkyBrightness::Kind::overcast);
    EXPECT_EQ(with.brightness->zenith, 40);
    EXPECT_EQ(with.brightness->ground, 6);
    EXPECT_EQ(without.brightness, nullptr);
    EXPECT_TRUE(std::holds_alternative<Glow>(*without.material));
}

TEST(SceneModifiers, TheClearSkyOfGenskyIsRead)
{
    // As written by gensky -ang 35 20 +s; the numbers are those of the text.
    const SceneFolder folder;
    const Scene scene = folder.read(R"(# gensky -ang 35 20 +s
# Ground ambient level: 13.7

void light solar
0
0
3 6.423e+06 6.423e+06 6.423e+06

solar source sun
0
0
4 -0.280166 -0.769751 0.573576 0.5

void brightfunc skyfunc
2 skybr skybright.cal
0
7 1 7.257e+00 1.681e+01 4.437e-01 -0.280166 -0.769751 0.573576
)");
    const auto& sky = std::get<SkyBrightness>(scene.modifiers.back().what);
    EXPECT_EQ(sky.kind, SkyBrightness::Kind::clear);
    EXPECT_EQ(sky.zenith, 7.257);
    EXPECT_EQ(sky.ground, 16.81);
    EXPECT_EQ(sky.normalization, 0.4437);
    EXPECT_NEAR(sky.to_sun.z, 0.573576, 1e-6);
    EXPECT_NEAR(length(sky.to_sun), 1, 1e-15);
}

TEST(SceneModifiers, APatternThatCannotBeReadIsNotedAndRefusedWhereASurfaceUsesIt)
{
    const SceneFolder folder;
    Report report;
    const std::string carpet = "void specpict carpet 5 noneg carpet.hsr . U V 0 0\n"
                               "carpet plastic floor 0 0 5 .3 .3 .3 0 0\n";
    folder.read(carpet, report);
    ASSERT_EQ(report.notes().size(), 1u);
    EXPECT_EQ(report.notes()[0].finding, Finding::unsupported);
    EXPECT_NE(report.notes()[0].text.find("carpet.hsr"), std::string::npos);
    const std::string message = folder.error(carpet + "floor sphere s 0 0 4 0 0 0 1");
    EXPECT_TRUE(message.starts_with("scene.rad:3: sphere \"s\": uses ")) << message;
}

TEST(SceneModifiers, SurfacesOfVoidAreLeftOutWithANote)
{
    const SceneFolder folder;
    Report report;
    const Scene scene = folder.read("void sphere s 0 0 4 0 0 0 1\nvoid ring r 0 0 8 0 0 0 0 0 1 0 1", report);
    EXPECT_TRUE(scene.root.surfaces.empty());
    ASSERT_EQ(report.notes().size(), 1u);
    EXPECT_EQ(report.notes()[0].finding, Finding::ignored);
    EXPECT_EQ(report.notes()[0].count, 2u);
}

TEST(ScenePrimitives, DegenerateSurfacesAreLeftOutAndOddOnesAreKeptEachWithANote)
{
    const SceneFolder folder;
    Report report;
    const Scene scene = folder.read(red + "red polygon line 0 0 9 0 0 0 1 1 1 2 2 2\n"
                                          "red polygon sliver 0 0 9 0 0 0 1 0 0 0.5 1e-7 0\n"
                                          "red polygon bent 0 0 12 0 0 0 1 0 0 1 1 .1 0 1 0\n"
                                          "red sphere dot 0 0 4 0 0 0 0\nred ring thin 0 0 8 0 0 0 0 0 1 1 1\n"
                                          "red source wide 0 0 4 0 0 1 400\n",
                                    report);
    ASSERT_EQ(scene.root.surfaces.size(), 3u);
    EXPECT_EQ(scene.root.surfaces[0].name, "sliver");
    EXPECT_EQ(scene.root.surfaces[1].name, "bent");
    EXPECT_EQ(scene.root.sources[0].full_angle_deg, 360);
    EXPECT_EQ(report.notes().size(), 6u);
}

TEST(SceneComments, ViewsGridsAndOriginsAreKept)
{
    const SceneFolder folder;
    const Scene scene =
        folder.read("#@from room%20one\n#@view south%201 -vtl -vp 1 2 3 -vd 0 1 0 -vu 0 0 1 -vh 4 -vv 3\n"
                    "#@grid desk 1 2 0.5\n#@grid-sensor 1 2 .75 0 0 1\n#@grid-cells -1 0\n# free text\n");
    EXPECT_EQ(scene.root.name, "room one");
    ASSERT_EQ(scene.views.size(), 1u);
    EXPECT_EQ(scene.views[0].name, "south 1");
    EXPECT_EQ(scene.views[0].kind, View::Kind::parallel);
    EXPECT_EQ(scene.views[0].position, (Point{1, 2, 3}));
    EXPECT_EQ(scene.views[0].horizontal, 4);
    ASSERT_EQ(scene.grids.size(), 1u);
    EXPECT_EQ(scene.grids[0].cells, (std::vector<int>{-1, 0}));
    EXPECT_EQ(scene.grids[0].sensors[0].position.z, 0.75);
}

} // namespace
} // namespace lightwell
