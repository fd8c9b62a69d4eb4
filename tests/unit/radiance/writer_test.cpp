#include "importers/radiance/place_surface.h"
#include "importers/radiance/transform_words.h"
#include "tests/unit/radiance/scene_folder.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

/// A prototype of one polygon and one sphere, seen through the given map.
Scene one_instance(const Affine& map, const Material& material = Plastic{Spectrum::grey(0.5)})
{
    Scene scene;
    const ModifierId paint = scene.add_material("paint", material);
    Part part;
    part.name = "chair";
    part.add_polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, paint, "seat");
    part.add_sphere({{0, 0, 1}, 0.5}, Shape::sphere, paint, "ball");
    scene.prototypes.push_back(part);
    scene.root.add_instance({0, map, {}}, "here");
    return scene;
}

Scene written_and_read(const SceneFolder& folder, const Scene& scene, Report& report, bool flat = false)
{
    write_radiance(scene, folder.path("out.rad"), {flat, 1e-3}, report);
    Scene again = read_radiance(folder.path("out.rad"), report);
    validate(again);
    return again;
}

void expect_same_world(const Scene& a, const Scene& b, double tolerance)
{
    const std::vector<WorldSurface> x = world_surfaces(a), y = world_surfaces(b);
    ASSERT_EQ(x.size(), y.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        EXPECT_EQ(x[i].type, y[i].type);
        EXPECT_EQ(x[i].modifier, y[i].modifier);
        EXPECT_EQ(x[i].material, y[i].material);
        ASSERT_EQ(x[i].numbers.size(), y[i].numbers.size());
        for (std::size_t k = 0; k < x[i].numbers.size(); ++k)
            EXPECT_NEAR(x[i].numbers[k], y[i].numbers[k], tolerance) << x[i].name << ' ' << k;
    }
}

TEST(SceneWriter, TheTextIsWhatOtherProgramsRead)
{
    const SceneFolder folder;
    Scene scene;
    scene.root.name = "room 1";
    const ModifierId white = scene.add_material("white", Plastic{{0.8, 0.8, 0.7}, 0.02, 0.05});
    const ModifierId layer = scene.add_modifier({"A WALL", Alias{white}, void_modifier});
    scene.root.add_polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0.1}}, layer, "2F#1");
    scene.root.add_cone({{{0, 0, 0}, {0, 0, 1}}, {0.25, 0.25}}, Shape::cylinder, white, "leg");
    Report report;
    write_radiance(scene, folder.path("out.rad"), {}, report);
    EXPECT_EQ(folder.text("out.rad"), "# Scene text written by Lightwell; lengths in metres, z up\n"
                                      "#@from room%201\n"
                                      "void plastic white\n0\n0\n5 0.8 0.8 0.7 0.02 0.05\n"
                                      "void alias A%20WALL white\n"
                                      "A%20WALL polygon 2F%231\n0\n0\n9\n 0 0 0\n 1 0 0\n 1 1 0.1\n"
                                      "white cylinder leg\n0\n0\n7 0 0 0 0 0 1 0.25\n");
    EXPECT_TRUE(report.notes().empty());
    EXPECT_FALSE(std::filesystem::exists(folder.path("out.parts")));
}

TEST(SceneWriter, ASimilarityIsWrittenAsAnInstanceOfAPartThatStandsBeside)
{
    const SceneFolder folder;
    const Affine map =
        compose(Affine::translate({1, 2, 3}),
                compose(Affine::rotate(2, pi / 6), compose(Affine::scale(2.0), Affine::scale({-1, 1, 1}))));
    const Scene scene = one_instance(map);
    Report report;
    const Scene again = written_and_read(folder, scene, report);
    EXPECT_NE(
        folder.text("out.rad").find("void instance here\n10 out.parts/chair.oct -mx -s 2 -rz 30 -t 1 2 3\n0\n0\n"),
        std::string::npos)
        << folder.text("out.rad");
    EXPECT_NE(folder.text("out.parts/build.sh").find("oconv -f \"out.parts/chair.rad\" > \"out.parts/chair.oct\""),
              std::string::npos);
    ASSERT_EQ(again.prototypes.size(), 1u);
    EXPECT_EQ(again.prototypes[0].name, "chair");
    expect_same_world(scene, again, 1e-12);
    EXPECT_TRUE(report.notes().empty());
}

TEST(SceneWriter, TransformWordsGiveEverySimilarityBackAlsoWhereAnglesAreIllDefined)
{
    for (const double about_y : {0.0, 10.0, 89.999999999, 90.0, 90.00000001, -90.0, 180.0, 271.0})
        for (const double about_x : {0.0, 33.3, -120.0, 180.0})
            for (const double mirror : {1.0, -1.0})
                for (const double scale : {1.0, 1e-6, 0.3, 1e6}) {
                    const double degree = radians_per_degree;
                    Affine map =
                        compose(Affine::rotate(0, about_x * degree), Affine::scale({scale, scale, mirror * scale}));
                    map = compose(Affine::rotate(2, 77 * degree), compose(Affine::rotate(1, about_y * degree), map));
                    map.translation = {1e6, -0.1, 1e-9};
                    const auto words = scene_text::words_of(map);
                    ASSERT_TRUE(words) << about_x << ' ' << about_y << ' ' << mirror << ' ' << scale;
                    std::size_t begin = 0;
                    const Affine again = scene_text::read_placements(*words, begin, "test").front().map;
                    EXPECT_EQ(begin, words->size());
                    EXPECT_LT(max_abs(again.x - map.x) + max_abs(again.y - map.y) + max_abs(again.z - map.z),
                              3e-12 * scale);
                    EXPECT_EQ(again.translation, map.translation);
                }
    EXPECT_FALSE(scene_text::words_of(Affine::scale({1, 1, 1.001})));
    EXPECT_FALSE(scene_text::words_of(Affine{{1, 0, 0}, {0.001, 1, 0}, {0, 0, 1}, {}}));
}

TEST(SceneWriter, AMapThatIsNoSimilarityIsWrittenOutWithFacetsWithinTheTolerance)
{
    const SceneFolder folder;
    Report report;
    const Scene again = written_and_read(folder, one_instance(Affine::scale({1, 2, 3})), report);
    EXPECT_TRUE(again.prototypes.empty());
    EXPECT_TRUE(report.has(Finding::approximated));
    EXPECT_EQ(again.root.points[2], (Point{0, 2, 0})); // the polygon is exact
    // x^2/a^2 + y^2/b^2 + z^2/c^2 = 1 with half axes .5, 1, 1.5 about (0, 0, 3): corners lie on it, and the middle
    // of no facet is further inside than the tolerance.
    const auto level = [](const Point& p) { return std::hypot(p.x / 0.5, p.y / 1.0, (p.z - 3) / 1.5); };
    double area = 0, deepest = 0;
    for (const Surface& surface : again.root.surfaces) {
        if (!surface.name.starts_with("here/ball"))
            continue;
        const Polygon& polygon = again.root.polygons[surface.index];
        Point middle;
        for (std::uint32_t i = 0; i < polygon.count; ++i) {
            EXPECT_NEAR(level(again.root.points[polygon.first + i]), 1, 1e-12);
            middle += again.root.points[polygon.first + i] / polygon.count;
        }
        deepest = std::fmax(deepest, (1 - level(middle)) * 1.5);
        area += surface_area_m2(again.root, surface);
        const Vec3 front = polygon_area_vector(&again.root.points[polygon.first], polygon.count);
        EXPECT_GT(dot(front, middle - Point{0, 0, 3}), 0) << surface.name;
    }
    EXPECT_LT(deepest, 1e-3);
    // Area of the ellipsoid by the incomplete elliptic integrals: 12.2167 m^2 (half axes .5, 1, 1.5).
    EXPECT_NEAR(area, 12.2167, 0.03);
}

TEST(SceneWriter, PartsOfRoundShapesAreWrittenAsFacetsWithinTheToleranceAndTold)
{
    const SceneFolder folder;
    Scene scene;
    const ModifierId paint = scene.add_material("paint", Plastic{Spectrum::grey(0.5)});
    const Sector third{{0, 1, 0}, 2 * pi / 3};
    scene.root.add_cone({{{0, 0, 0}, {0, 0, 2}}, {3, 3}, third}, Shape::cylinder, paint, "wall");
    scene.root.add_ring({{0, 0, 2}, {0, 0, 1}, 1, 3, third}, paint, "lid");
    Report report;
    const Scene again = written_and_read(folder, scene, report);
    double wall = 0, lid = 0;
    for (const Surface& surface : again.root.surfaces)
        (surface.name.starts_with("wall") ? wall : lid) += surface_area_m2(again.root, surface);
    // Chords within 1 mm of an arc of 3 m: its length loses less than a part in 2,000, areas less than in 1,000.
    EXPECT_NEAR(wall / (2 * pi / 3 * 3 * 2), 1, 5e-4);
    EXPECT_NEAR(lid / (8 * pi / 3), 1, 1e-3);
    EXPECT_TRUE(report.has(Finding::approximated));
}

TEST(SceneWriter, CylindersAndRingsStayExactWhenOnlyTheirAxisIsStretched)
{
    Part part;
    part.add_cone({{{1, 1, 0}, {1, 1, 2}}, {0.3, 0.3}}, Shape::cylinder, void_modifier, "c");
    part.add_ring({{0, 0, 1}, {0, 0, 1}, 0.1, 0.2}, void_modifier, "r");
    Part image;
    Report report;
    for (const Surface& surface : part.surfaces)
        scene_text::add_image(image, part, surface, Affine::scale({2, 2, -5}), void_modifier, "x", 1e-3, report);
    EXPECT_TRUE(report.notes().empty());
    ASSERT_EQ(image.cones.size(), 1u);
    EXPECT_EQ(image.cones[0].ends[1], (Point{2, 2, -10}));
    EXPECT_EQ(image.cones[0].radii[0], 0.6);
    EXPECT_EQ(image.rings[0].normal, (Direction{0, 0, -1}));
    EXPECT_EQ(image.rings[0].outer_radius, 0.4);
}

TEST(SceneWriter, EmittersAndMirrorsAreWrittenOutSoThatOtherProgramsFindThem)
{
    const SceneFolder folder;
    for (const Material& material : {Material{Light{Spectrum::grey(10)}}, Material{Mirror{Spectrum::grey(0.9)}}}) {
        Report report;
        const Scene scene = one_instance(Affine::rotate(0, 1), material);
        const Scene again = written_and_read(folder, scene, report);
        EXPECT_TRUE(again.prototypes.empty());
        EXPECT_EQ(again.root.surfaces[0].name, "here/seat");
        EXPECT_TRUE(report.has(Finding::converted));
        expect_same_world(scene, again, 1e-12);
    }
}

TEST(SceneWriter, BeamsTurnWithTheInstanceThatIsWrittenOut)
{
    const SceneFolder folder;
    Report report;
    const Scene scene = one_instance(Affine::rotate(1, pi / 2), Spotlight{Spectrum::grey(1), 30, {0, 0, -2}});
    const Scene again = written_and_read(folder, scene, report, true);
    const Material& spot = *resolve(again, again.root.surfaces[0].modifier).material;
    EXPECT_NEAR(std::get<Spotlight>(spot).aim.x, -2, 1e-12);
}

TEST(SceneWriter, InstancesThatBindAPlaceHolderDifferentlyGetAPartEach)
{
    const SceneFolder folder;
    Scene scene;
    const ModifierId red = scene.add_material("red", Plastic{{0.7, 0.1, 0.1}});
    const ModifierId blue = scene.add_material("blue", Plastic{{0.1, 0.1, 0.7}});
    const ModifierId open = scene.add_modifier({"0", Inherited{}, void_modifier});
    Part leaf, branch;
    leaf.name = "door";
    leaf.add_sphere({{0, 0, 0}, 1}, Shape::sphere, open, "knob");
    branch.name = "wall";
    branch.add_instance({0, Affine::translate({3, 0, 0}), {}}, "inner");
    scene.prototypes = {leaf, branch};
    scene.root.add_instance({1, Affine{}, {{open, red}}}, "a");
    scene.root.add_instance({1, Affine::translate({0, 5, 0}), {{open, blue}}}, "b");
    scene.root.add_instance({1, Affine::translate({0, 9, 0}), {{open, red}}}, "c");
    validate(scene);
    Report report;
    const Scene again = written_and_read(folder, scene, report);
    EXPECT_EQ(again.prototypes.size(), 4u);
    EXPECT_TRUE(std::filesystem::exists(folder.path("out.parts/wall-2.rad")));
    expect_same_world(scene, again, 1e-12);
}

TEST(SceneWriter, APlaceHolderThatNothingStandsInForIsVoidSinceOthersTakeNoAliasOfVoid)
{
    const SceneFolder folder;
    Scene scene;
    const ModifierId open = scene.add_modifier({"0", Inherited{}, void_modifier});
    const ModifierId nothing = scene.add_modifier({"nothing", Alias{void_modifier}, void_modifier});
    scene.root.add_sphere({{0, 0, 0}, 1}, Shape::sphere, open, "a");
    scene.root.add_sphere({{3, 0, 0}, 1}, Shape::sphere, nothing, "b");
    Report report;
    write_radiance(scene, folder.path("out.rad"), {}, report);
    EXPECT_EQ(folder.text("out.rad"), "# Scene text written by Lightwell; lengths in metres, z up\n"
                                      "void sphere a\n0\n0\n4 0 0 0 1\n"
                                      "void sphere b\n0\n0\n4 3 0 0 1\n");
}

TEST(SceneWriter, MeshesKeepTheirNormalsAndTextureUnlessFlat)
{
    const SceneFolder folder;
    Scene scene;
    const ModifierId paint = scene.add_material("paint", Plastic{Spectrum::grey(0.5)});
    auto mesh = std::make_shared<Mesh>();
    mesh->points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1.0 / 3}};
    mesh->triangles = {0, 1, 2, 2, 1, 3};
    const Direction up = normalized({1, 2, 3});
    mesh->normals = {{0, 0, 1}, up, {0, 0, 1}, up};
    mesh->texture = {0, 0, 1, 0, 0, 1, 1, 1};
    scene.root.add_mesh(mesh, paint, "m");
    scene.root.add_mesh(mesh, paint, "again");
    Report report;
    const Scene again = written_and_read(folder, scene, report);
    EXPECT_TRUE(report.notes().empty());
    ASSERT_EQ(again.root.meshes.size(), 2u);
    EXPECT_EQ(again.root.meshes[0], again.root.meshes[1]);
    expect_same_world(scene, again, 0);
    const Scene flat = written_and_read(folder, scene, report, true);
    EXPECT_EQ(flat.root.polygons.size(), 4u);
    EXPECT_TRUE(report.has(Finding::approximated));
}

TEST(SceneWriter, SkiesViewsAndGridsComeBack)
{
    const SceneFolder folder;
    Scene scene;
    SkyBrightness sky{SkyBrightness::Kind::intermediate, 40.25, 6.5, 1.125, normalized({1, -2, 3})};
    const ModifierId pattern = scene.add_modifier({"skyfunc", sky, void_modifier});
    const ModifierId glow = scene.add_material("sky_glow", Glow{Spectrum::grey(1), 0}, pattern);
    scene.root.add_source({{0, 0, 1}, 180}, glow, "sky");
    View view;
    view.name = "from above";
    view.position = {0.1, 0.2, 1e-7};
    view.horizontal = 179.5;
    view.kind = View::Kind::hemispherical;
    scene.views.push_back(view);
    scene.grids.push_back({"desk", {{{1, 2, 0.75}, {0, 0, 1}}}, 1, 2, {0, -1}, 0.5});
    Report report;
    const Scene again = written_and_read(folder, scene, report);
    expect_same_world(scene, again, 1e-15);
    ASSERT_EQ(again.views.size(), 1u);
    EXPECT_EQ(to_text(again.views[0]), to_text(view));
    EXPECT_EQ(again.views[0].name, "from above");
    ASSERT_EQ(again.grids.size(), 1u);
    EXPECT_EQ(again.grids[0].cells, scene.grids[0].cells);
    EXPECT_EQ(again.grids[0].sensors[0].position, scene.grids[0].sensors[0].position);
}

TEST(SceneWriter, HardNamesComeBackAsTheyWere)
{
    const SceneFolder folder;
    Scene scene;
    for (const char* name : {"void", "inherit", "alias", "!x", "\"quoted\"", "'q", "#1", "100%", "%41", "a b\tc", "",
                             "W\xC3\xA4nde", "12.5", "polygon"}) {
        const ModifierId paint = scene.add_material(name, Plastic{Spectrum::grey(0.5)});
        scene.root.add_sphere({{0, 0, 0}, 1}, Shape::sphere, paint, name);
    }
    Report report;
    const Scene again = written_and_read(folder, scene, report);
    ASSERT_EQ(again.root.surfaces.size(), scene.root.surfaces.size());
    for (std::size_t i = 0; i < scene.root.surfaces.size(); ++i) {
        EXPECT_EQ(again.root.surfaces[i].name, scene.root.surfaces[i].name);
        EXPECT_EQ(again.modifiers[i].name, scene.modifiers[i].name);
    }
}

TEST(SceneWriter, TwoModifiersOfOneNameStayTwo)
{
    const SceneFolder folder;
    Scene scene;
    const ModifierId one = scene.add_material("m", Plastic{Spectrum::grey(0.1)});
    const ModifierId two = scene.add_material("m", Plastic{Spectrum::grey(0.2)});
    const ModifierId layer = scene.add_modifier({"m", Alias{one}, void_modifier});
    for (const ModifierId id : {one, two, layer, one})
        scene.root.add_sphere({{0, 0, 0}, 1}, Shape::sphere, id, "s");
    Report report;
    expect_same_world(scene, written_and_read(folder, scene, report), 0);
}

TEST(SceneWriter, AFlatForestIsRefusedAndABadToleranceToo)
{
    const SceneFolder folder;
    Scene scene = one_instance(Affine{});
    for (int level = 0; level < 5; ++level) {
        Part part;
        for (int i = 0; i < 100; ++i)
            part.add_instance({static_cast<std::uint32_t>(level), Affine::translate({1, 0, 0}), {}}, "i");
        scene.prototypes.push_back(part);
    }
    scene.root.add_instance({5, Affine{}, {}}, "forest");
    Report report;
    EXPECT_THROW(write_radiance(scene, folder.path("out.rad"), {true, 1e-3}, report), InputError);
    EXPECT_THROW(write_radiance(scene, folder.path("out.rad"), {false, 0}, report), InputError);
    EXPECT_THROW(write_radiance(scene, folder.path("nowhere/out.rad"), {}, report), InputError);
    EXPECT_FALSE(std::filesystem::exists(folder.path("out.rad")));
}

} // namespace
} // namespace lightwell
