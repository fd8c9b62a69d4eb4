#include "tests/unit/radiance/ply_writer.h"
#include "tests/unit/radiance/scene_folder.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

const std::string red = "void plastic red\n0\n0\n5 .7 .1 .1 0 0\n";
const std::string blue = "void plastic sea%20blue\n0\n0\n5 .1 .1 .7 0 0\n";

/// A concave pentagon, a triangle and a square with a square hole (a seam from corner to corner) in three planes.
PlyFaces three_faces()
{
    return {{0, 0, 0.1, 3, 0, 0.1, 3, 2, 0.1, 1.1, 0.7, 0.1, 0,   2,   0.1, // the pentagon
             0, 0, 1,   1, 0, 1,   0, 1, 1,                                 // the triangle
             0, 0, 2,   2, 0, 2,   2, 2, 2,   0,   2,   2,   0.5, 0.5, 2,   0.5, 1.5, 2, 1.5, 1.5, 2, 1.5, 0.5, 2},
            {{0, 1, 2, 3, 4}, {5, 6, 7}, {8, 9, 10, 11, 8, 12, 13, 14, 15, 12}}};
}

/// Corners at -1 and 1; faces look outwards.
PlyFaces cube()
{
    PlyFaces faces;
    for (int i = 0; i < 8; ++i)
        for (int axis = 0; axis < 3; ++axis)
            faces.points.push_back(i >> axis & 1 ? 1 : -1);
    faces.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    return faces;
}

TEST(PlyMesh, FacesOfAnyNumberOfCornersStayOnePolygonEachInDoubleAndInOrder)
{
    const SceneFolder folder;
    folder.write("parts/a.ply", three_faces().bytes());
    const Scene scene = folder.read(red + "red mesh thing 1 parts/a.ply 0 0");
    ASSERT_EQ(scene.prototypes.size(), 1u);
    const Part& part = scene.prototypes[0];
    ASSERT_EQ(part.surfaces.size(), 3u);
    const std::size_t corners[] = {5, 3, 10};
    const double areas[] = {4.05, 0.5, 3}; // 6 - 1.3 * 3 / 2, 1 / 2, 4 - 1
    for (std::uint32_t i = 0; i < 3; ++i) {
        EXPECT_EQ(part.surfaces[i].shape, Shape::polygon);
        EXPECT_EQ(part.surfaces[i].name, std::to_string(i));
        EXPECT_EQ(part.polygons[i].count, corners[i]);
        EXPECT_NEAR(surface_area_m2(part, part.surfaces[i]), areas[i], 1e-14);
    }
    EXPECT_EQ(part.points[3], (Point{1.1, 0.7, 0.1}));
    ASSERT_EQ(scene.root.surfaces.size(), 1u);
    EXPECT_EQ(scene.root.surfaces[0].name, "thing");
}

TEST(PlyMesh, EveryFaceHasTheModifierThatTheHeaderNamesOrTheOneOfTheLine)
{
    const SceneFolder folder;
    PlyFaces faces = three_faces();
    faces.comments = "comment modifier 0 sea%20blue\ncomment modifier 7 red\n";
    faces.face_properties = "property short modifier\n";
    const short modifiers[] = {7, 0, -1};
    folder.write("a.ply", faces.bytes([&](PlyWriter& ply, std::size_t i) { ply.put(modifiers[i]); }));
    const Scene scene = folder.read(red + blue + "void plastic other 0 0 5 0 0 0 0 0\nother mesh thing 1 a.ply 0 0");
    const char* expected[] = {"red", "sea blue", "other"};
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(scene.modifiers[static_cast<std::size_t>(scene.prototypes[0].surfaces[i].modifier)].name,
                  expected[i]);
}

TEST(PlyMesh, LinesThatNameOneFileShareItsPrototypeUnderAnyAffineMap)
{
    const SceneFolder folder;
    folder.write("a.ply", three_faces().bytes());
    const Scene scene = folder.read(red + "red mesh one 1 a.ply 0 0\n"
                                          "red mesh two 14 a.ply -affine 1 .5 0 10  0 2 0 20  0 .25 -3 30 0 0\n"
                                          "red mesh three 18 a.ply -t 1 0 0 -affine 0 -1 0 0 1 0 0 0 0 0 1 0 0 0");
    EXPECT_EQ(scene.prototypes.size(), 1u);
    ASSERT_EQ(scene.root.instances.size(), 3u);
    // Row by row: (3, 2, 0.1) -> 3 + 1 + 10, 4 + 20, 0.5 - 0.3 + 30
    const Point image = scene.root.instances[1].to_parent.point({3, 2, 0.1});
    EXPECT_NEAR(image.x, 14, 1e-14);
    EXPECT_NEAR(image.y, 24, 1e-14);
    EXPECT_NEAR(image.z, 30.2, 1e-14);
    // First moved to (4, 2), then turned left.
    const Point turned = scene.root.instances[2].to_parent.point({3, 2, 0.1});
    EXPECT_EQ(turned, (Point{-2, 4, 0.1}));
}

TEST(PlyMesh, AFaceThatIsNotPlanarIsCutAndItsDeviationIsReported)
{
    const SceneFolder folder;
    folder.write("a.ply", PlyFaces{{0, 0, 0, 1, 0, 0, 1, 1, 0.4, 0, 1, 0}, {{0, 1, 2, 3}}}.bytes());
    Report report;
    KeptMeshes kept;
    SceneOrigins origins;
    const Scene scene = read_radiance(folder.write("scene.rad", red + "red mesh m 1 a.ply 0 0"), report, kept, origins);
    const Part& part = scene.prototypes[0];
    ASSERT_EQ(part.meshes.size(), 1u);
    EXPECT_EQ(part.meshes[0]->triangles.size(), 6u);
    EXPECT_EQ(origins.mesh_files.at(0)->faces.at(part.meshes[0].get()), (std::vector<std::uint32_t>{0, 0}));
    ASSERT_EQ(report.notes().size(), 1u);
    EXPECT_EQ(report.notes()[0].finding, Finding::approximated);
    // Normal (-.2, -.2, 1) / sqrt(1.08), mean (.5, .5, .1): 0.1 / sqrt(1.08)
    EXPECT_NE(report.notes()[0].text.find("0.09622504"), std::string::npos) << report.notes()[0].text;
}

TEST(PlyMesh, NormalsMakeAMeshOnlyWhereTheySayMoreThanThePlane)
{
    const SceneFolder folder;
    PlyFaces faces{{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, {{0, 1, 2}, {1, 3, 2}}};
    faces.face_properties = "property list uchar float normals\n";
    folder.write("a.ply", faces.bytes([](PlyWriter& ply, std::size_t face) {
        ply.put(static_cast<unsigned char>(9));
        for (int corner = 0; corner < 3; ++corner)
            ply.all(face == 1 && corner == 1 ? std::vector<float>{0.6f, 0, 0.8f} : std::vector<float>{0, 0, 1});
    }));
    const Part part = folder.read(red + "red mesh m 1 a.ply 0 0").prototypes[0];
    ASSERT_EQ(part.surfaces.size(), 2u);
    EXPECT_EQ(part.surfaces[0].shape, Shape::polygon);
    EXPECT_EQ(part.surfaces[1].shape, Shape::mesh);
    EXPECT_EQ(part.surfaces[1].name, "1+");
    ASSERT_EQ(part.meshes[0]->normals.size(), 3u);
    EXPECT_NEAR(part.meshes[0]->normals[1].x, 0.6, 1e-7);
}

TEST(PlyMesh, TexturePlacesAreKeptForAModifierThatVaries)
{
    const SceneFolder folder;
    PlyFaces faces{{0, 0, 0, 1, 0, 0, 0, 1, 0}, {{0, 1, 2}}};
    faces.face_properties = "property list uchar float s_t\n";
    folder.write("a.ply", faces.bytes([](PlyWriter& ply, std::size_t) {
        ply.put(static_cast<unsigned char>(6)).all(std::vector<float>{0, 0, 2, 0, 0, 3});
    }));
    const std::string patterned = "void brightfunc stripes 2 Lu . 0 0\nstripes plastic cloth 0 0 5 1 1 1 0 0\n";
    const Scene scene = folder.read(patterned + red + "red mesh plain 1 a.ply 0 0 cloth mesh striped 1 a.ply 0 0");
    ASSERT_EQ(scene.prototypes.size(), 2u);
    EXPECT_EQ(scene.prototypes[0].surfaces[0].shape, Shape::polygon);
    EXPECT_EQ(scene.prototypes[1].meshes.at(0)->texture, (std::vector<double>{0, 0, 2, 0, 0, 3}));
}

TEST(PlySubdivision, ACageBecomesItsLimitSurface)
{
    const SceneFolder folder;
    folder.write("cube.ply", cube().bytes());
    const Scene scene = folder.read(red + "red subdivision ball 1 cube.ply 0 1 1e-4");
    const Mesh& mesh = *scene.prototypes[0].meshes.at(0);
    EXPECT_EQ(mesh.normals.size(), mesh.points.size());
    const Box box = surface_bounds(scene.prototypes[0], scene.prototypes[0].surfaces[0]);
    // Catmull and Clark, by hand: one step gives the face point (0, 0, 1), edge points (3/4, 0, 3/4), corners 5/9;
    // the limit of the face point is (16 * 1 + 4 * 4 * 3/4 + 4 * 5/9) / 36.
    EXPECT_NEAR(box.high.z, 272.0 / 324, 1e-9);
    EXPECT_NEAR(box.low.x, -272.0 / 324, 1e-9);
    double nearest = 1;
    for (const Point& point : mesh.points)
        nearest = std::fmin(nearest, length(point - Point{0.5, 0.5, 0.5})); // (9 * 1 + 4 * 1 - 1) / 24
    EXPECT_LT(nearest, 1e-4);
}

TEST(PlySubdivision, CreasesAndTipsStaySharp)
{
    const SceneFolder folder;
    PlyFaces faces = cube();
    faces.more_elements = "element edge 4\nproperty int vertex1\nproperty int vertex2\nproperty float sharpness\n"
                          "element corner 4\nproperty int vertex\nproperty float sharpness\n";
    const int top[] = {4, 5, 7, 6};
    std::string bytes = faces.bytes();
    PlyWriter tail("");
    const std::size_t header = tail.bytes().size();
    for (int i = 0; i < 4; ++i)
        tail.put(top[i]).put(top[(i + 1) % 4]).put(10.f);
    for (const int vertex : top)
        tail.put(vertex).put(10.f);
    folder.write("cube.ply", bytes + tail.bytes().substr(header));
    const Scene scene = folder.read(red + "red subdivision box 1 cube.ply 0 1 1e-3");
    const Box box = surface_bounds(scene.prototypes[0], scene.prototypes[0].surfaces[0]);
    EXPECT_NEAR(box.high.z, 1, 1e-9);
    EXPECT_NEAR(box.high.x, 1, 1e-9);
    EXPECT_GT(box.low.z, -0.95); // the lower half is round
}

TEST(PlySubdivision, FacesOfOneCageMayDifferInTheirModifierWithoutAGap)
{
    const SceneFolder folder;
    PlyFaces faces = cube();
    faces.comments = "comment modifier 0 sea%20blue\ncomment boundary smooth\n";
    faces.face_properties = "property int modifier\n";
    folder.write("cube.ply", faces.bytes([](PlyWriter& ply, std::size_t i) { ply.put(i == 1 ? 0 : -1); }));
    Report report;
    KeptMeshes kept;
    SceneOrigins origins;
    const Scene scene = read_radiance(folder.write("scene.rad", red + blue + "red subdivision b 1 cube.ply 0 1 1e-3"),
                                      report, kept, origins);
    const Part& part = scene.prototypes[0];
    ASSERT_EQ(part.surfaces.size(), 2u);
    const auto& by_mesh = origins.mesh_files.at(0)->faces;
    for (const std::uint32_t face : by_mesh.at(part.meshes[1].get()))
        EXPECT_EQ(face, 1u);
    // The face (0, 0, 1) alone; a sixth of the whole by symmetry.
    const double all = surface_area_m2(part, part.surfaces[0]) + surface_area_m2(part, part.surfaces[1]);
    EXPECT_NEAR(surface_area_m2(part, part.surfaces[1]), all / 6, 1e-9);
    EXPECT_EQ(scene.modifiers[static_cast<std::size_t>(part.surfaces[1].modifier)].name, "sea blue");
}

TEST(KeptMeshes, OnlyFilesWhoseBytesChangedAreReadAgain)
{
    const SceneFolder folder;
    KeptMeshes kept;
    SceneOrigins origins;
    Report report;
    folder.write("a.ply", cube().bytes());
    folder.write("b.ply", three_faces().bytes());
    const std::string lines = "red subdivision a 1 a.ply 0 1 1e-2 red mesh b 1 b.ply 0 0 red mesh c 1 b.ply 0 0";
    const Scene first = read_radiance(folder.write("scene.rad", red + lines), report, kept, origins);
    EXPECT_EQ(kept.counts().read, 2u);
    const Scene second =
        read_radiance(folder.write("scene.rad", "void metal red 0 0 5 1 1 1 0 0 " + lines), report, kept, origins);
    EXPECT_EQ(kept.counts().read, 0u);
    EXPECT_EQ(kept.counts().kept, 2u);
    EXPECT_EQ(first.prototypes[0].meshes[0], second.prototypes[0].meshes[0]); // the same object
    EXPECT_EQ(second.modifiers.size(), 1u);
    PlyFaces changed = three_faces();
    changed.points[0] = -1;
    folder.write("b.ply", changed.bytes());
    const Scene third = read_radiance(folder.path("scene.rad"), report, kept, origins);
    EXPECT_EQ(kept.counts().read, 1u);
    EXPECT_EQ(third.prototypes[1].points[0].x, -1);
}

TEST(SceneOrigins, AnObjectIsWhatFromNamesBeforeThePrimitive)
{
    const SceneFolder folder;
    folder.write("a.ply", three_faces().bytes());
    KeptMeshes kept;
    SceneOrigins origins;
    Report report;
    read_radiance(
        folder.write("scene.rad", "#@from whole%20scene\n" + red +
                                      "#@from Room/Desk%20%231\nred mesh m 1 a.ply 0 0\n"
                                      "red sphere s 0 0 4 0 0 0 1\n#@from Lamp\nred sphere t 0 0 4 5 0 0 1\n"),
        report, kept, origins);
    EXPECT_EQ(origins.objects, (std::vector<std::string>{"Room/Desk #1", "", "Lamp"}));
}

} // namespace
} // namespace lightwell
