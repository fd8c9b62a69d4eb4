#include "importers/surfaces/recover_surfaces.h"

#include "engine/base/errors.h"
#include "tests/unit/surfaces/walls.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightwell {
namespace {

double area_of(const Part& part)
{
    double sum = 0;
    for (const Surface& surface : part.surfaces)
        sum += surface_area_m2(part, surface);
    return sum;
}

Imported imported_wall()
{
    Imported imported;
    KeyTable keys(imported);
    imported.scene.root.add_mesh(std::make_shared<const Mesh>(wall_with_window()),
                                 keys.modifier_for(key_of_layer("A-WALL")), "wall");
    imported.ledger.made();
    return imported;
}

TEST(RecoverSurfaces, TheWallWithAWindowIsTenPolygonsOfItsNameAndKey)
{
    Imported imported = imported_wall();
    recover_surfaces(imported, {});
    validate(imported.scene);
    const Part& root = imported.scene.root;
    ASSERT_EQ(root.surfaces.size(), 10u);
    std::size_t corners = 0;
    for (const Surface& surface : root.surfaces) {
        EXPECT_EQ(surface.shape, Shape::polygon);
        EXPECT_EQ(surface.name, "wall");
        EXPECT_EQ(surface.modifier, 0);
        corners += root.polygons[surface.index].count;
    }
    EXPECT_EQ(corners, 8u * 4 + 2u * (4 + 6)); // a hole of four corners and its seam: six more
    const double expected = (2. * (19 * 15 - 32) + 2 * (19 + 15) + 2 * (8 + 4)) / 16;
    EXPECT_NEAR(area_of(root), expected, 1e-12 * expected);
    EXPECT_TRUE(imported.report.has(Finding::converted));
    EXPECT_EQ(imported.ledger.made_count(), 1u);
}

TEST(RecoverSurfaces, KeepTrianglesLeavesThemAlone)
{
    Imported imported = imported_wall();
    ImportOptions options;
    options.keep_triangles = true;
    recover_surfaces(imported, options);
    ASSERT_EQ(imported.scene.root.surfaces.size(), 1u);
    EXPECT_EQ(imported.scene.root.meshes[0]->triangles.size(), 3u * 1196);
    EXPECT_TRUE(imported.report.notes().empty());
}

TEST(RecoverSurfaces, EntitiesOfTheirOwnAreJoinedOnlyWhereTheLedgerCountsByKey)
{
    for (const bool by_key : {false, true}) {
        SCOPED_TRACE(by_key);
        Imported imported;
        KeyTable keys(imported);
        const ModifierId layer = keys.modifier_for(key_of_layer("floor"));
        imported.scene.root.add_polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, layer, "f1");
        imported.scene.root.add_polygon({{0, 0, 0}, {1, 1, 0}, {0, 1, 0}}, layer, "f2");
        imported.scene.root.add_ring({{0, 0, 3}, {0, 0, 1}, 0, 1}, layer, "disc");
        if (by_key)
            imported.made_with_key = {3};
        recover_surfaces(imported, {});
        const Part& root = imported.scene.root;
        ASSERT_EQ(root.surfaces.size(), by_key ? 2u : 3u);
        EXPECT_EQ(root.surfaces[0].name, "f1");
        EXPECT_EQ(root.surfaces.back().shape, Shape::ring);
        EXPECT_NEAR(area_of(root), 1 + pi, 1e-12);
        validate(imported.scene);
    }
}

TEST(RecoverSurfaces, CurvedMeshesAndThoseWithNormalsStayWhole)
{
    Mesh terrain;
    for (int i = 0; i < 12; ++i)
        for (int j = 0; j < 12; ++j) {
            const auto at = [](int x, int y) { return Point{double(x), double(y), 0.1 * x * x + 0.07 * x * y}; };
            add_cells(terrain, at(i, j), at(i + 1, j) - at(i, j), at(i, j + 1) - at(i, j), 1, 1);
            terrain.points.back().z += 0.01;
        }
    Mesh shaded = wall_with_window();
    shaded.normals.assign(shaded.points.size(), {0, 0, 1});
    Imported imported;
    KeyTable keys(imported);
    imported.scene.root.add_mesh(std::make_shared<const Mesh>(terrain), keys.modifier_for(key_of_layer("hill")), "a");
    imported.scene.root.add_mesh(std::make_shared<const Mesh>(shaded), keys.modifier_for(key_of_layer("wall")), "b");
    recover_surfaces(imported, {});
    ASSERT_EQ(imported.scene.root.meshes.size(), 2u);
    EXPECT_EQ(imported.scene.root.meshes[1]->triangles.size(), 3u * 1196);
}

TEST(RecoverSurfaces, ACurvedRestOfAMostlyFlatMeshStaysAMesh)
{
    Imported imported;
    KeyTable keys(imported);
    Mesh mesh = wall_with_window();
    mesh.points.insert(mesh.points.end(), {{9, 9, 9}, {10, 9, 9}, {9, 10, 9}, {9, 9, 10}});
    const auto base = static_cast<std::uint32_t>(mesh.points.size() - 4);
    for (const std::uint32_t corner : {0u, 2u, 1u, 0u, 1u, 3u, 1u, 2u, 3u, 0u, 3u, 2u})
        mesh.triangles.push_back(base + corner);
    const ModifierId layer = keys.modifier_for(key_of_layer("all"));
    imported.scene.root.add_mesh(std::make_shared<const Mesh>(mesh), layer, "all");
    const double before = area_of(imported.scene.root);
    recover_surfaces(imported, {});
    ASSERT_EQ(imported.scene.root.surfaces.size(), 11u);
    ASSERT_EQ(imported.scene.root.meshes.size(), 1u);
    EXPECT_EQ(imported.scene.root.meshes[0]->triangles.size(), 12u);
    EXPECT_NEAR(area_of(imported.scene.root), before, 1e-9);
}

TEST(RecoverSurfaces, PrototypesAreRecoveredOnceForAllTheirInstances)
{
    Imported imported;
    KeyTable keys(imported);
    Part block;
    block.add_mesh(std::make_shared<const Mesh>(wall_with_window()), keys.modifier_for(key_of_layer("wall")), "w");
    imported.scene.prototypes.push_back(block);
    for (int i = 0; i < 3; ++i)
        imported.scene.root.add_instance({0, Affine::translate({9. * i, 0, 0}), {}}, "copy");
    recover_surfaces(imported, {});
    EXPECT_EQ(imported.scene.prototypes[0].surfaces.size(), 10u);
    EXPECT_EQ(imported.scene.root.instances.size(), 3u);
    EXPECT_EQ(expanded_count(imported.scene), 30u);
}

TEST(RecoverSurfaces, ACreaseAngleRoundsAMantleAndLeavesItsEndsFlat)
{
    constexpr int sides = 36;
    Mesh tin;
    const auto at = [](int i, double z) {
        return Point{std::cos(2 * pi * (i % sides) / sides), std::sin(2 * pi * (i % sides) / sides), z};
    };
    for (int i = 0; i < sides; ++i)
        for (const Point& p : {at(i, 0), at(i + 1, 0), at(i + 1, 1), at(i, 0), at(i + 1, 1), at(i, 1), Point{0, 0, 1},
                               at(i, 1), at(i + 1, 1)}) {
            tin.triangles.push_back(static_cast<std::uint32_t>(tin.points.size()));
            tin.points.push_back(p);
        }
    Imported imported;
    KeyTable keys(imported);
    imported.scene.root.add_mesh(std::make_shared<const Mesh>(tin), keys.modifier_for(key_of_layer("tin")), "tin");
    ImportOptions options;
    options.crease_angle_deg = 30;
    recover_surfaces(imported, options);
    const Part& root = imported.scene.root;
    ASSERT_EQ(root.polygons.size(), 1u);
    EXPECT_EQ(root.polygons[0].count, std::uint32_t{sides});
    ASSERT_EQ(root.meshes.size(), 1u);
    EXPECT_EQ(root.meshes[0]->normals.size(), root.meshes[0]->points.size());
    EXPECT_EQ(root.meshes[0]->triangles.size(), 3u * 2 * sides);
    for (const double bad : {0.0, 181.0, std::nan("")}) {
        options.crease_angle_deg = bad;
        EXPECT_THROW(recover_surfaces(imported, options), InputError);
    }
}

} // namespace
} // namespace lightwell
