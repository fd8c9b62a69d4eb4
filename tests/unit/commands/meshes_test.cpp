#include "engine/scene/varied_materials.h"
#include "importers/radiance/radiance.h"
#include "tests/unit/commands/command_run.h"

#include <gtest/gtest.h>

/// \file obj2rad and obj2mesh: Wavefront files as scene text and as mesh files.
namespace lightwell::commands {
namespace {

constexpr const char* house = "mtllib house.mtl\nv 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 .5 0\nv 0 2 0\nv 0 0 1\n"
                              "vn 0 0 1\nvn 1 0 0\nvn 0 1 0\ng floor hall\nusemtl red paint\nf 1 2 3 4 5\n"
                              "g roof\nusemtl tin\nf 1//1 2//2 6//3\nf 2 3 6\n";

TEST(ObjToScene, FacesBecomePolygonsWithTheirMaterialsAndNames)
{
    const WorkFolder folder;
    folder.write("house.obj", house);
    const Ran ran = run("obj2rad -f house.obj");
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_EQ(ran.out.rfind("# obj2rad -f house.obj\n", 0), 0u);
    folder.write("house.rad", "void plastic red_paint 0 0 5 1 0 0 0 0\nvoid plastic tin 0 0 5 .5 .5 .5 0 0\n");
    EXPECT_NE(ran.out.find("tin polygon roof.2\n"), std::string::npos) << ran.out;
    EXPECT_EQ(ran.out.find("texfunc"), std::string::npos);
    // The floor's five corners stay one polygon.
    EXPECT_NE(ran.out.find("floor.1\n0\n0\n15\n"), std::string::npos) << ran.out;
    EXPECT_EQ(run("obj2rad -f -o part", house).out.find("part.3") == std::string::npos, false);
}

TEST(ObjToScene, NormalsBecomeATextureThatGivesThemBackAtTheCorners)
{
    const WorkFolder folder;
    folder.write("one.obj",
                 "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn .6 0 .8\nvn 0 .6 .8\nusemtl grey\nf 1//1 2//2 3//3\n");
    const Ran text = run("obj2rad one.obj");
    ASSERT_EQ(text.status, 0) << text.err;
    EXPECT_NE(text.out.find("grey texfunc T-nor\n4 dx dy dz tmesh.cal\n"), std::string::npos);
    folder.write("one.rad", "void plastic grey 0 0 5 .5 .5 .5 0 0\n" + text.out);
    Report report;
    const Scene scene = read_radiance("one.rad", report);
    const std::pair<Point, Vec3> corners[] = {
        {{0, 0, 0}, {0, 0, 1}}, {{1, 0, 0}, {.6, 0, .8}}, {{0, 1, 0}, {0, .6, .8}}};
    for (const auto& [corner, normal] : corners) {
        PatternPlace place;
        place.position = corner;
        place.direction = {0, 0, -1};
        place.normal = {0, 0, 1};
        SeenMaterial seen;
        VariedMaterials(scene).look(scene.root.surfaces.at(0).modifier, place, seen);
        EXPECT_LT(length(place.normal + seen.bend - normal), 1e-9) << corner.x << corner.y;
    }
}

TEST(ObjToScene, TheLastRuleThatFitsGivesTheMaterialAndVoidLeavesOut)
{
    const WorkFolder folder;
    folder.write("house.obj", house);
    folder.write("a.map", "# all\nplain ;\nred (Group hall) (Material \"red paint\") ;\nlate (Face [3:9]) ;\n");
    const std::string out = run("obj2rad -f -m a.map house.obj").out;
    EXPECT_NE(out.find("\nred polygon floor.1"), std::string::npos) << out;
    EXPECT_NE(out.find("\nplain polygon roof.2"), std::string::npos) << out;
    EXPECT_NE(out.find("\nlate polygon roof.3"), std::string::npos) << out;
    folder.write("b.map", "plain ; void (Group roof);");
    EXPECT_EQ(run("obj2rad -f -m b.map house.obj").out.find("roof"), std::string::npos);
    const std::string names = run("obj2rad -n house.obj").out;
    EXPECT_NE(names.find("qualifier Material begin\n\"red paint\"\n\"tin\"\nend\n"), std::string::npos) << names;
    EXPECT_NE(names.find("qualifier Face begin\n[1:3]\nend\n"), std::string::npos) << names;
    for (const auto& [rules, message] : {std::pair{"a (Group b)", "a.map:1: the last rule does not end"},
                                         {"\na (Colour b) ;", "a.map:2: qualifier \"Colour\" is not known"},
                                         {"a (Face [1:x]) ;", "\"x\" where a whole number is expected"},
                                         {"a (Group \"b", "a quoted name does not end"},
                                         {"a (Group", "no value behind qualifier"},
                                         {") ;", "where a material is expected"},
                                         {"a b ;", "where ( or ; is expected"}}) {
        folder.write("a.map", rules);
        const Ran ran = run("obj2rad -m a.map house.obj");
        EXPECT_EQ(ran.status, 1) << rules;
        EXPECT_NE(ran.err.find("obj2rad: fatal - "), std::string::npos) << ran.err;
        EXPECT_NE(ran.err.find(message), std::string::npos) << ran.err;
        EXPECT_EQ(ran.out, "");
    }
}

TEST(ObjToMesh, AMeshFileIsReadWithItsMaterialsOrWithTheModifierOfTheSurface)
{
    const WorkFolder folder;
    folder.write("house.obj", house);
    folder.write("house.mat", "void plastic \"red paint\" 0 0 5 .9 .1 .1 0 0\nvoid metal tin 0 0 5 .5 .5 .5 1 0\n");
    const Ran ran = run("obj2mesh -n 7 -r 4096 -a house.mat house.obj house.rtm");
    ASSERT_EQ(ran.status, 0) << ran.err;
    std::filesystem::remove("house.obj");
    std::filesystem::remove("house.mat");
    EXPECT_NE(run("getinfo house.rtm").out.find("FORMAT=Lightwell_tmesh"), std::string::npos);
    folder.write("own.rad", "void mesh h 5 house.rtm -t 0 0 3 0 0\n");
    Report report;
    const Scene own = read_radiance("own.rad", report);
    ASSERT_EQ(own.prototypes.size(), 1u);
    const Part& part = own.prototypes[0];
    ASSERT_EQ(part.meshes.size(), 2u);
    double area[2] = {};
    for (std::size_t i = 0; i < 2; ++i)
        area[i] = surface_area_m2(part, part.surfaces[i]);
    EXPECT_NEAR(area[0], 2 * 2 - 0.5 * 2 * 1.5, 1e-12); // concave: a notch of 2 by 1.5 from above
    EXPECT_NEAR(area[1], 0.5 * 2 * 1 + 0.5 * 2 * std::sqrt(4. + 1), 1e-12);
    EXPECT_TRUE(std::holds_alternative<Metal>(*resolve(own, part.surfaces[1].modifier).material));
    // Corners with normals keep them, the others stand on their faces.
    ASSERT_EQ(part.meshes[1]->normals.size(), part.meshes[1]->points.size());
    EXPECT_TRUE(part.meshes[0]->normals.empty());

    folder.write("grey.rad", "void plastic grey 0 0 5 .5 .5 .5 0 0\ngrey mesh h 1 house.rtm 0 0\n");
    const Scene grey = read_radiance("grey.rad", report);
    EXPECT_EQ(grey.root.meshes.at(0)->triangles.size(), 3u * 5);
}

TEST(ObjToMesh, DamageIsNamedAndNothingHalfIsWritten)
{
    const WorkFolder folder;
    folder.write("house.obj", house);
    folder.write("scene.rad", "void plastic m 0 0 5 .5 .5 .5 0 0\nm mesh h 1 house.rtm 0 0\n");
    ASSERT_EQ(run("obj2mesh house.obj house.rtm").status, 0);
    std::filesystem::remove("house.obj");
    const std::string good = WorkFolder::read("house.rtm");
    for (std::size_t cut = good.find("materials triangles"); cut < good.size(); cut += 7) {
        folder.write("house.rtm", good.substr(0, cut));
        const Ran ran = run("oconv scene.rad");
        EXPECT_NE(ran.status, 0) << cut;
        EXPECT_NE(ran.err.find("is not as long as it says"), std::string::npos) << ran.err;
    }
    folder.write("house.rtm", "#?RADIANCE\nFORMAT=Radiance_tmesh\n\nx");
    EXPECT_NE(run("oconv scene.rad").err.find("\"house.obj\" is not found"), std::string::npos);
    const std::pair<const char*, const char*> calls[] = {{"obj2mesh gone.obj", "cannot open \"gone.obj\""},
                                                         {"obj2mesh -a gone.mat scene.rad", "gone.mat"},
                                                         {"obj2mesh -r 0 scene.rad", "bad number in option '-r'"},
                                                         {"obj2mesh -h", "unknown option: '-h'"},
                                                         {"obj2mesh a b c", "too many file arguments: 'c'"},
                                                         {"obj2rad gone.obj", "cannot open \"gone.obj\""},
                                                         {"obj2rad -m gone.map scene.rad", "gone.map"}};
    folder.write("scene.rad", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    for (const auto& [line, message] : calls) {
        const Ran ran = run(line);
        EXPECT_EQ(ran.status, 1) << line;
        EXPECT_EQ(ran.out, "") << line;
        EXPECT_NE(ran.err.find(message), std::string::npos) << ran.err;
    }
}

} // namespace
} // namespace lightwell::commands
