#include "tests/unit/assimp/long_tail.h"

#include "engine/base/errors.h"

#include <gtest/gtest.h>

#include <set>

namespace lightwell {
namespace {

const std::string two_triangles = "solid lamp\n"
                                  "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 900 0 0\nvertex 900 600 0\n"
                                  "endloop\nendfacet\n"
                                  "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 900 600 0\nvertex 0 600 0\n"
                                  "endloop\nendfacet\nendsolid lamp\n";

TEST(LongTail, StlStatesNoUnitAndNoAxisSoBothAreAssumedAloudOrGiven)
{
    const Imported assumed = import_text("a.stl", two_triangles);
    EXPECT_EQ(assumed.unit, "mm (assumed)");
    EXPECT_NEAR(total_area_m2(assumed), 0.54, 1e-9);
    EXPECT_EQ(assumed.keys.at(0).layer, "lamp");
    std::size_t assumptions = 0;
    for (const Note& note : assumed.report.notes())
        assumptions += note.finding == Finding::assumed;
    EXPECT_EQ(assumptions, 2u);

    ImportOptions given;
    given.metres_per_unit = 0.0254;
    given.up = "y";
    const Imported told = import_text("a.stl", two_triangles, given);
    EXPECT_EQ(told.unit, "in (given)");
    EXPECT_NEAR(bounds(told.scene).high.z, 600 * 0.0254, 1e-6); // y of the file points up
    EXPECT_FALSE(told.report.has(Finding::assumed));
}

TEST(LongTail, AnOffFileKeepsItsConcavePolygonWhole)
{
    const Imported arrow = import_text("arrow.off", "OFF\n4 1 0\n0 0 0\n2 1 0\n0 2 0\n1 1 0\n4 0 1 2 3\n");
    ASSERT_EQ(arrow.scene.root.polygons.size(), 1u);
    EXPECT_EQ(arrow.scene.root.polygons[0].count, 4u);
    EXPECT_NEAR(total_area_m2(arrow), 1, 1e-12);
    EXPECT_EQ(arrow.ledger.read_count(), 1u);
}

TEST(LongTail, X3dIsInMetresWithYUp)
{
    const Imported plate =
        import_text("plate.x3d", "<?xml version=\"1.0\"?>\n<X3D version=\"3.2\"><Scene>"
                                 "<Transform DEF=\"Table\" translation=\"0 0.75 0\"><Shape DEF=\"Top\"><IndexedFaceSet "
                                 "coordIndex=\"0 1 2 3 -1\"><Coordinate point=\"0 0 0 0 0 1 2 0 1 2 0 0\"/>"
                                 "</IndexedFaceSet></Shape></Transform></Scene></X3D>\n");
    EXPECT_EQ(plate.unit, "m (X3D)");
    EXPECT_NEAR(total_area_m2(plate), 2, 1e-9);
    EXPECT_NEAR(bounds(plate.scene).low.z, 0.75, 1e-6);
    EXPECT_NEAR(bounds(plate.scene).high.z, 0.75, 1e-6);
}

TEST(LongTail, PlyFacesStayWholeAndPointsAloneHaveNoArea)
{
    const std::string head = "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
                             "property double z\n";
    const Imported quad =
        import_text("quad.ply", head + "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                                       "0 0 0\n2 0 0\n2 3 0\n0 3 0\n4 0 1 2 3\n");
    ASSERT_EQ(quad.scene.root.polygons.size(), 1u);
    EXPECT_NEAR(total_area_m2(quad), 6, 1e-12);
}

TEST(LongTail, NodesThatRepeatAMeshAreInstances)
{
    const std::filesystem::path file = shared_cad() / "3ds/cube_four_instances.3ds";
    if (!std::filesystem::exists(file))
        GTEST_SKIP() << "the shared CAD files are not here";
    const Imported cubes = import_assimp(file, {});
    EXPECT_EQ(cubes.scene.prototypes.size(), 5u); // a mesh for each of its five materials
    EXPECT_EQ(cubes.scene.root.instances.size(), 4u * 5);
    std::set<std::string> layers;
    for (const SurfaceKey& key : cubes.keys)
        layers.insert(key.layer);
    EXPECT_TRUE(layers.contains("cube_inst_3"));
    const Box box = bounds(cubes.scene); // cubes of 1 at (0,0) (2,0) (2,2) (0,2)
    EXPECT_NEAR(box.high.x - box.low.x, 3, 1e-6);
    EXPECT_NEAR(box.high.y - box.low.y, 3, 1e-6);
    EXPECT_NEAR(box.high.z - box.low.z, 1, 1e-6);
}

TEST(LongTail, UnitsAndAxesOfFbxAndColladaComeFromTheFile)
{
    if (!std::filesystem::exists(shared_cad()))
        GTEST_SKIP() << "the shared CAD files are not here";
    const Imported box = import_assimp(shared_cad() / "fbx/box.FBX", {}); // 47.244 inches, node scale 0.0254, metres
    EXPECT_EQ(box.unit, "m (from UnitScaleFactor)");
    EXPECT_NEAR(bounds(box.scene).high.z, 1.2, 1e-6);
    EXPECT_EQ(import_assimp(shared_cad() / "fbx/cubes_with_names.fbx", {}).unit, "cm (from UnitScaleFactor)");
    const Imported teapot = import_assimp(shared_cad() / "collada/teapot_instancenodes.DAE", {});
    EXPECT_EQ(teapot.unit, "in (from <unit>)");
    EXPECT_NEAR(bounds(teapot.scene).low.z, 0, 1e-6);
    EXPECT_EQ(teapot.scene.root.instances.size(), 2u);
    ImportOptions millimetres;
    millimetres.metres_per_unit = 0.001;
    const Imported small = import_assimp(shared_cad() / "collada/teapot_instancenodes.DAE", millimetres);
    EXPECT_NEAR(bounds(small.scene).high.z * 25.4, bounds(teapot.scene).high.z, 1e-6);
}

TEST(LongTail, IfcGivesPresentationLayersElementTypesAndMetres)
{
    const std::filesystem::path file = shared_cad() / "ifc/SimpleWall.ifc";
    if (!std::filesystem::exists(file))
        GTEST_SKIP() << "the shared CAD files are not here";
    const Imported wall = import_assimp(file, {});
    EXPECT_EQ(wall.unit, "mm (from IfcUnitAssignment)");
    std::set<std::string> seen;
    for (const SurfaceKey& key : wall.keys)
        seen.insert(key.layer + "|" + key.entity + "|" + key.material);
    EXPECT_EQ(seen,
              (std::set<std::string>{"A-DOOR-____-OTLN|IfcDoor|Door - Frame", "A-DOOR-____-OTLN|IfcDoor|Door - Panel",
                                     "A-WALL-____-OTLN|IfcWallStandardCase|Default Wall"}));
    const Box box = bounds(wall.scene); // a wall of 4 m by 4 m; the file says Length 4000, Area 14.0474 with its door
    EXPECT_NEAR(box.high.x - box.low.x, 4, 1e-6);
    EXPECT_NEAR(box.high.z - box.low.z, 4, 1e-6);
    double front_m2 = 0;
    for (const Surface& surface : wall.scene.root.surfaces) {
        const Polygon& polygon = wall.scene.root.polygons[surface.index];
        const Vec3 area = polygon_area_vector(&wall.scene.root.points[polygon.first], polygon.count);
        if (wall.keys[static_cast<std::size_t>(surface.modifier)].entity == "IfcWallStandardCase" && area.y > 0.01)
            front_m2 += area.y;
    }
    EXPECT_NEAR(front_m2, 14.0474, 0.001);
}

TEST(LongTail, WhatIsNotReadIsRefusedByNameWithAWayOut)
{
    const auto refusal = [](const std::string& name, const std::string& text) -> std::string {
        try {
            import_text(name, text);
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    };
    EXPECT_NE(refusal("a.stp", "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN'));").find("STEP is not read"),
              std::string::npos);
    EXPECT_NE(
        refusal("a.ifc", "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('IFC4'));").find("IFC of another version than 2x3"),
        std::string::npos);
    EXPECT_NE(refusal("a.usda", "#usda 1.0\n").find("USD is not read"), std::string::npos);
    EXPECT_NE(refusal("a.txt", "hello").find("none of FBX"), std::string::npos);
    EXPECT_NE(
        refusal("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty flout x\nend_header\n").find("a.ply:4: "),
        std::string::npos);
    EXPECT_NE(refusal("b.ply", "ply\nformat ascii 1.0\nelement vertex 4000000000\nend_header\n")
                  .find("an element count that the file is too short for"),
              std::string::npos);
    ImportOptions bad;
    bad.metres_per_unit = -1;
    EXPECT_THROW(import_text("a.stl", two_triangles, bad), InputError);
}

} // namespace
} // namespace lightwell
