#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/random.h"
#include "engine/base/text.h"
#include "tests/unit/import_measures/measure.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

namespace lightwell {
namespace {

using Json = nlohmann::json;

const std::filesystem::path fixtures = LIGHTWELL_ROOT "/tests/fixtures/obj";

Json truth_of(const std::string& stem)
{
    return Json::parse(std::ifstream(fixtures / (stem + ".truth.json")));
}

const Material& material_named(const Imported& imported, const std::string& name)
{
    for (const auto& [known, material] : imported.file_materials)
        if (known == name)
            return material;
    throw std::runtime_error("no material " + name);
}

/// Imports a text through a file of its own, which is removed afterwards.
Imported import_text(const std::string& text, const ImportOptions& options = {})
{
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / (std::string("lightwell_") + test->name() + ".obj");
    write_text_atomically(file, text);
    struct Remove {
        std::filesystem::path path;
        ~Remove() { std::filesystem::remove(path); }
    } remove{file};
    return import_obj(file, options);
}

void expect_layers(const Imported& imported, const Json& truth)
{
    const MeasuredModel found = measure(imported);
    EXPECT_EQ(found.layers.size(), truth["layers"].size());
    for (const auto& [layer, expected] : truth["layers"].items()) {
        SCOPED_TRACE(layer);
        ASSERT_TRUE(found.layers.count(layer));
        EXPECT_EQ(found.layers.at(layer).surfaces, expected["surfaces"].get<std::size_t>());
        EXPECT_NEAR(found.layers.at(layer).area_m2, expected["area_m2"].get<double>(), 1e-9);
    }
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(found.bounds.low[axis], truth["bounds_m"][0][static_cast<std::size_t>(axis)].get<double>(), 1e-12);
        EXPECT_NEAR(found.bounds.high[axis], truth["bounds_m"][1][static_cast<std::size_t>(axis)].get<double>(), 1e-12);
    }
}

TEST(Obj, ARoomInMillimetresKeepsItsLayersAreasAndMaterials)
{
    const Imported room = import_obj(fixtures / "room.obj", {});
    const Json truth = truth_of("room");
    expect_layers(room, truth);
    EXPECT_EQ(room.ledger.made_count(), truth["faces"].get<std::size_t>());
    for (const auto& [type, count] : truth["skipped"].items())
        EXPECT_EQ(skipped_of_type(room, type), count.get<std::size_t>()) << type;
    EXPECT_EQ(room.ledger.read_count(), 14u);
    for (std::size_t i = 0; i < room.keys.size(); ++i)
        EXPECT_EQ(room.keys[i].material, truth["layers"][room.keys[i].layer]["material"].get<std::string>());
    EXPECT_EQ(room.unit, "mm (from a comment of the file)");
    EXPECT_FALSE(room.report.has(Finding::assumed));
    validate(room.scene);
}

TEST(Obj, AConcaveFloorStaysOnePolygonOfSixCorners)
{
    const Imported room = import_obj(fixtures / "room.obj", {});
    ASSERT_EQ(room.scene.root.surfaces[0].shape, Shape::polygon);
    EXPECT_EQ(room.scene.root.polygons[0].count, 6u);
    EXPECT_EQ(room.scene.root.surfaces[0].name, "f1");
}

TEST(Obj, GroupsObjectAndMaterialAreSeparateWordsOfTheKey)
{
    const Imported room = import_obj(fixtures / "room.obj", {});
    const SurfaceKey& ceiling = room.keys[1];
    EXPECT_EQ(ceiling.layer, "A-CLNG");
    EXPECT_EQ(ceiling.group, "A-CLNG ceiling");
    EXPECT_EQ(ceiling.block, "Room");
    EXPECT_EQ(ceiling.entity, "face");
    ASSERT_TRUE(ceiling.colour.has_value());
    EXPECT_DOUBLE_EQ(ceiling.colour->r, 0.75);
}

TEST(Obj, MaterialsOfTheLibraryFollowTheStatedRule)
{
    const Imported room = import_obj(fixtures / "room.obj", {});
    const auto& paint = std::get<Plastic>(material_named(room, "Wall paint (white) 0.75"));
    EXPECT_NEAR(paint.colour.g, 0.75, 1e-6);
    EXPECT_EQ(paint.specularity, 0);
    const auto& lamp = std::get<Light>(material_named(room, "Lamp"));
    EXPECT_NEAR(to_rec709(lamp.radiance).r, 12, 1e-9);
    EXPECT_NEAR(to_rec709(lamp.radiance).b, 10, 1e-9);
    const auto& pane = std::get<Glass>(material_named(room, "Pane"));
    EXPECT_NEAR(to_rec709(pane.transmissivity).g, 0.92, 1e-9);
    EXPECT_EQ(pane.index, 1.5);
    const auto& chrome = std::get<Metal>(material_named(room, "Chrome"));
    EXPECT_NEAR(chrome.colour.r, 0.6, 1e-6);
    EXPECT_NEAR(chrome.roughness, 0.1, 1e-12); // sqrt(2 / 200)
    const auto& brushed = std::get<Metal>(material_named(room, "Brushed"));
    EXPECT_NEAR(brushed.roughness, 0.16, 1e-12);
    EXPECT_NEAR(to_rec709(brushed.colour).r, 0.5, 1e-9);
    const auto& varnish = std::get<Plastic>(material_named(room, "Varnish"));
    EXPECT_NEAR(varnish.specularity, 0.04, 1e-6); // 0.5 * 8 / 100
    EXPECT_NEAR(to_rec709(varnish.colour * (1 - varnish.specularity)).r, 0.4, 1e-9);
    const auto& bright = std::get<Plastic>(material_named(room, "Too bright"));
    EXPECT_NEAR(bright.specularity, 0.1, 1e-6);
    EXPECT_EQ(noted(room.report, "the highlight is weakened"), 1u);
    EXPECT_EQ(noted(room.report, "`map_Kd` names \"bright.png\", which is not there"), 1u);
    for (const auto& [name, material] : room.file_materials)
        EXPECT_NO_THROW(validate_material(material, name));
}

TEST(Obj, SmoothSidesBecomeOneMeshAndFlatEndsStayPolygons)
{
    const Imported column = import_obj(fixtures / "cylinder.obj", {});
    const Json truth = truth_of("cylinder");
    expect_layers(column, truth);
    ASSERT_EQ(column.scene.root.meshes.size(), 1u);
    const Mesh& side = *column.scene.root.meshes[0];
    EXPECT_EQ(side.triangles.size() / 3, truth["mesh_triangles"].get<std::size_t>());
    EXPECT_EQ(side.points.size(), truth["mesh_points"].get<std::size_t>());
    EXPECT_TRUE(side.texture.empty()); // no picture is laid on it
    EXPECT_EQ(column.scene.root.polygons.size(), truth["polygons"].get<std::size_t>());
    for (std::size_t i = 0; i < side.points.size(); ++i) {
        const Point& p = side.points[i];
        EXPECT_NEAR(max_abs(side.normals[i] - normalized(Vec3{p.x, p.y, 0})), 0, 1e-12);
    }
    EXPECT_EQ(column.ledger.made_count(), truth["faces"].get<std::size_t>());
    EXPECT_EQ(noted(column.report, "y is up"), 1u);
    EXPECT_EQ(noted(column.report, "unit is metre"), 1u);
}

TEST(Obj, TheFrontOfASmoothSideLooksAwayFromTheAxis)
{
    const Imported column = import_obj(fixtures / "cylinder.obj", {});
    const Mesh& side = *column.scene.root.meshes.at(0);
    for (std::size_t i = 0; i < side.triangles.size(); i += 3) {
        const Point &a = side.points[side.triangles[i]], &b = side.points[side.triangles[i + 1]],
                    &c = side.points[side.triangles[i + 2]];
        EXPECT_GT(dot(cross(b - a, c - a), side.normals[side.triangles[i]]), 0);
    }
}

TEST(Obj, WarpedFacesAreCutInsideTheirOutlineAndTheDeviationIsNoted)
{
    const Imported warped = import_obj(fixtures / "warped.obj", {});
    const Json truth = truth_of("warped");
    const MeasuredModel found = measure(warped);
    const double square = found.layers.at("square").area_m2;
    EXPECT_NEAR(std::fmin(std::fabs(square - truth["square_area_either_m2"][0].get<double>()),
                          std::fabs(square - truth["square_area_either_m2"][1].get<double>())),
                0, 1e-12);
    EXPECT_NEAR(found.layers.at("arrow").area_m2, truth["arrow_area_m2"].get<double>(), 1e-12);
    EXPECT_EQ(noted(warped.report, "corners do not lie in one plane"), 2u);
    std::size_t repaired = 0;
    for (const Ledger::Repaired& entry : warped.ledger.repaired_list())
        repaired += entry.type == "face" && entry.what == "corners out of plane: cut into triangles" ? entry.count : 0;
    EXPECT_EQ(repaired, 2u);
}

TEST(Obj, DamagedFacesAreLeftOutForANamedReasonAndTheRestIsKept)
{
    const Imported damaged = import_obj(fixtures / "damaged.obj", {});
    const Json truth = truth_of("damaged");
    EXPECT_EQ(damaged.ledger.made_count(), truth["made"].get<std::size_t>());
    EXPECT_NEAR(measure(damaged).total.area_m2, truth["area_m2"].get<double>(), 1e-12);
    for (const auto& [reason, count] : truth["skipped"].items())
        EXPECT_EQ(skipped_for(damaged, reason), count.get<std::size_t>()) << reason;
    EXPECT_EQ(noted(damaged.report, "unknown statement, the first is `frobnicate`"), 1u);
    EXPECT_EQ(noted(damaged.report, "never carried out"), 1u);
    for (const Note& note : damaged.report.notes())
        if (note.text.find("a vertex that is not there") != std::string::npos) {
            EXPECT_EQ(note.place, "damaged.obj:11");
        }
}

TEST(Obj, OptionsOverrideUnitAndUpAxis)
{
    ImportOptions options;
    options.metres_per_unit = 0.0254;
    options.up = "y";
    const Imported room = import_obj(fixtures / "room.obj", options);
    EXPECT_NEAR(measure(room).layers.at("A-FLOR").area_m2, 24e6 * 0.0254 * 0.0254, 1e-6);
    EXPECT_NEAR(measure(room).bounds.high.z, 4500 * 0.0254, 1e-9); // y of the file
    EXPECT_EQ(room.unit, "in (given)");
    options.up = "x";
    EXPECT_THROW(import_obj(fixtures / "room.obj", options), InputError);
    options.up = "";
    options.metres_per_unit = std::nan("");
    EXPECT_THROW(import_obj(fixtures / "room.obj", options), InputError);
}

TEST(Obj, AMissingLibraryIsSurvivedAndSaid)
{
    const Imported found = import_text("mtllib not there.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl Brick Wall\nf 1 2 3\n");
    EXPECT_EQ(found.keys.at(0).material, "Brick Wall");
    EXPECT_EQ(found.keys.at(0).layer, "Brick Wall");
    EXPECT_EQ(noted(found.report, "material library \"not there.mtl\" is not there"), 1u);
    EXPECT_EQ(noted(found.report, "material \"Brick Wall\" is used but not described"), 1u);
}

TEST(Obj, ATextWithoutVertexOrFaceIsRefusedWithItsName)
{
    try {
        import_text("hello\nworld\n");
        FAIL() << "expected an error";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("no vertex and no face found in 2 lines"), std::string::npos);
    }
    EXPECT_THROW(import_text(""), InputError);
    EXPECT_THROW(import_obj(fixtures / "no_such_file.obj", {}), InputError);
}

TEST(Obj, EveryTruncationOfAFileIsReadOrRefusedButNeverCrashes)
{
    const MappedFile room(fixtures / "room.obj");
    const std::string text(room.bytes());
    for (std::size_t size = 0; size < text.size(); size += 7) {
        try {
            const Imported part = import_text(text.substr(0, size));
            validate(part.scene);
            EXPECT_LE(part.ledger.made_count(), 10u);
        } catch (const InputError&) {
            EXPECT_LT(size, 80u) << "only a file without any vertex may be refused";
        }
    }
}

TEST(Obj, OneWrongByteAnywhereNeverCrashes)
{
    const MappedFile room(fixtures / "room.obj");
    const std::string text(room.bytes());
    std::size_t read = 0;
    for (std::size_t at = 0; at < text.size(); ++at) {
        std::string bytes = text;
        bytes[at] = static_cast<char>(bytes[at] ^ (at % 2 ? 0x01 : 0x1e));
        const Imported imported = import_text(bytes);
        EXPECT_NO_THROW(validate(imported.scene)) << at;
        read += imported.ledger.made_count() > 0 ? 1 : 0;
    }
    EXPECT_GT(read, text.size() * 9 / 10);
}

TEST(Obj, AHugeConcaveOutlineThatIsWarpedIsCutInReasonableTime)
{
    std::string text = "# up: z\n# unit: m\n";
    std::string face = "f";
    constexpr int teeth = 20000;
    for (int i = 0; i < teeth; ++i) {
        text += "v " + std::to_string(i) + (i % 2 ? " 1 0.5\n" : " 2 0\n");
        face.append(" ").append(std::to_string(i + 1));
    }
    text += "v " + std::to_string(teeth) + " -9 0\nv 0 -9 900\n";
    face.append(" -2 -1\n");
    const Imported imported = import_text(text + face);
    EXPECT_EQ(imported.ledger.made_count(), 1u);
    EXPECT_EQ(noted(imported.report, "corners do not lie in one plane"), 1u);
}

TEST(Obj, AWarpedConcaveFaceIsCutWithoutCoveringItsNotch)
{
    // An L of 3 m2 with one corner 0.1 m above its plane: only triangles at that corner tilt. Seen from above they
    // still cover the L once; a fan from a corner would cover the notch too.
    const Imported found = import_text("# up: z\n# unit: m\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0.1\nv 0 0 0\n"
                                       "f 1 2 3 4 5 6\n");
    ASSERT_EQ(found.scene.root.meshes.size(), 1u);
    const Mesh& mesh = *found.scene.root.meshes[0];
    ASSERT_EQ(mesh.triangles.size(), 3u * 4);
    double seen_m2 = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        const Point& a = mesh.points[mesh.triangles[i]];
        const double twice = cross(mesh.points[mesh.triangles[i + 1]] - a, mesh.points[mesh.triangles[i + 2]] - a).z;
        EXPECT_GT(twice, 0);
        seen_m2 += 0.5 * twice;
    }
    EXPECT_NEAR(seen_m2, 3, 1e-12);
}

TEST(Obj, AWarpedFaceThatCrossesItselfKeepsItsAreaVector)
{
    // A pentagram with one raised tip: no set of ears covers it, and a fan has the outline's area vector at least.
    const Imported found = import_text("# up: z\n# unit: m\nv 0 3 0.2\nv 2 -3 0\nv -3 1 0\nv 3 1 0\nv -2 -3 0\n"
                                       "f 5 4 3 2 1\n");
    ASSERT_EQ(found.scene.root.meshes.size(), 1u);
    const Mesh& mesh = *found.scene.root.meshes[0];
    double area_m2 = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3)
        area_m2 += 0.5 * cross(mesh.points[mesh.triangles[i + 1]] - mesh.points[mesh.triangles[i]],
                               mesh.points[mesh.triangles[i + 2]] - mesh.points[mesh.triangles[i]])
                             .z;
    // Shoelace over (-2,-3), (3,1), (-3,1), (2,-3), (0,3): (-2+9) + (3+3) + (9-2) + 6 + 6 = 32, halved.
    EXPECT_NEAR(area_m2, 16, 1e-12);
}

TEST(Obj, AFaceMayComeBeforeItsVerticesAndCommentsMayEndALine)
{
    const Imported found = import_text("f 1 2 3 # before\nv 0 0 0 # a\nv 2 0 0\nv 0 2 0\ng Cube # inline\n");
    EXPECT_NEAR(measure(found).total.area_m2, 2, 1e-15);
    EXPECT_EQ(found.keys.at(0).layer, "default");
}

TEST(Obj, RoundedNormalsOfAFlatFaceDoNotMakeItSmooth)
{
    const Imported found = import_text("v 0 0 0\nv 1 0 0\nv 0 1 1\nv 5 0 0\nv 6 0 0\nv 5 1 1\n"
                                       "vn 0 -0.707 0.707\nvn 0 -0.71 0.72\nf 1//1 2//1 3//1\nf 4//2 5//2 6//2\n");
    EXPECT_EQ(found.scene.root.polygons.size(), 1u);
    EXPECT_EQ(found.scene.root.meshes.size(), 1u);
}

TEST(Obj, FacesWithoutAMaterialTakeTheMeanColourOfTheirVertices)
{
    // The lower triangle is red (sRGB 1, 0, 0); the quad above is half 0.5 and half black, area 2 against 0.5.
    const Imported found = import_text("v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nf 1 2 3\n"
                                       "g wall\nv 0 0 1 0.5 0.5 0.5\nv 2 0 1 0 0 0\nv 2 1 1 0.5 0.5 0.5\n"
                                       "v 0 1 1 1.0 0 0 0\nv 5 5 5\nf 4 5 6 7\nusemtl Named\nf 4 5 6\n");
    ASSERT_EQ(found.file_materials.size(), 3u);
    const auto colour_of = [&](std::size_t key) {
        for (const auto& [name, material] : found.file_materials)
            if (name == found.keys.at(key).material)
                return to_rec709(std::get<Plastic>(material).colour);
        return Spectrum{-1, -1, -1};
    };
    EXPECT_EQ(found.keys.at(0).material, "vertex colour #ff0000");
    EXPECT_NEAR(colour_of(0).r, 1, 1e-2); // a primary of Rec.709 lies a little outside the engine's
    const double half = std::pow((0.5 + 0.055) / 1.055, 2.4);
    EXPECT_NEAR(colour_of(1).g, half / 2, 1e-6);
    EXPECT_NEAR(colour_of(2).g, half * 2 / 3, 1e-6);
    EXPECT_EQ(found.keys.at(2).material, "Named");
    EXPECT_EQ(noted(found.report, "vertex colours, read as sRGB"), 3u);
}

TEST(Obj, VertexColoursAboveOneAreCountsTo255)
{
    const Imported found = import_text("v 0 0 0 255 255 255\nv 1 0 0 255 255 255\nv 0 1 0 255 255 255\nf 1 2 3\n");
    EXPECT_NEAR(std::get<Plastic>(material_named(found, "vertex colour #ffffff")).colour.g, 1, 1e-9);
}

/// A column of so many sides between z = 0 and 1, in one smoothing group, without normals.
std::string column(int sides, const std::string& smoothing)
{
    std::string text = "# up: z\n# unit: m\n" + smoothing;
    for (int i = 0; i < sides; ++i) {
        const std::string x = shortest(std::cos(2 * pi * i / sides)), y = shortest(std::sin(2 * pi * i / sides));
        text += "v " + x + " " + y + " 0\nv " + x + " " + y + " 1\n";
    }
    for (int i = 0; i < sides; ++i) {
        const int a = 2 * i + 1, b = 2 * ((i + 1) % sides) + 1;
        for (const int corner : {a, b, b + 1, a + 1})
            text += (corner == a ? "f " : " ") + std::to_string(corner);
        text += "\n";
    }
    return text;
}

TEST(Obj, ASmoothingGroupWithoutNormalsBendsARoundColumn)
{
    const Imported found = import_text(column(12, "s 1\n"));
    ASSERT_EQ(found.scene.root.meshes.size(), 1u);
    const Mesh& mesh = *found.scene.root.meshes[0];
    EXPECT_EQ(mesh.points.size(), 24u);
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
        EXPECT_NEAR(max_abs(mesh.normals[i] - Vec3{mesh.points[i].x, mesh.points[i].y, 0}), 0, 1e-9);
    EXPECT_EQ(noted(found.report, "smoothing group without vertex normals"), 12u);
    EXPECT_EQ(import_text(column(12, "s off\n")).scene.root.polygons.size(), 12u);
    EXPECT_EQ(import_text(column(12, "")).scene.root.polygons.size(), 12u);
}

TEST(Obj, AnEdgeOfMoreThan66DegreesStaysAnEdgeInItsSmoothingGroup)
{
    EXPECT_EQ(import_text(column(4, "s 1\n")).scene.root.polygons.size(), 4u);
    EXPECT_EQ(import_text(column(5, "s 1\n")).scene.root.polygons.size(), 5u); // 72 degrees
    EXPECT_EQ(import_text(column(6, "s 1\n")).scene.root.meshes.size(), 1u);   // 60 degrees
}

TEST(Obj, FacesOfDifferentSmoothingGroupsDoNotBendEachOther)
{
    const std::string two = "# up: z\nv 0 0 0\nv 1 0 0\nv 1 1 0.3\nv 0 1 0.3\nv 0 2 0\nv 1 2 0\n";
    const Imported apart = import_text(two + "s 1\nf 1 2 3 4\ns 2\nf 4 3 6 5\n");
    EXPECT_EQ(apart.scene.root.polygons.size(), 2u);
    const Imported together = import_text(two + "s 1\nf 1 2 3 4\nf 4 3 6 5\n");
    ASSERT_EQ(together.scene.root.meshes.size(), 1u);
    // The ridge between the roofs looks straight up: both slopes and both angles there are equal.
    const Mesh& mesh = *together.scene.root.meshes[0];
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
        if (mesh.points[i].z > 0.2) {
            EXPECT_NEAR(max_abs(mesh.normals[i] - Vec3{0, 0, 1}), 0, 1e-12);
        }
}

TEST(Obj, EachFreeFormStatementIsReportedWithItsKind)
{
    const Imported found = import_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\ncstype rat bspline\ndeg 3 2\n"
                                       "surf 0 1 0 1 1 2 3 \\\n 1 2 3\nparm u 0 1\nend\ncurv 0 1 1 2 3\nend\n"
                                       "bzp 1 2 3\ncdc 1 2 3\nsurf 0 1 0 1 1 2 3\n");
    EXPECT_EQ(skipped_of_type(found, "free-form surface"), 3u);
    EXPECT_EQ(skipped_of_type(found, "curve"), 2u);
    EXPECT_EQ(noted(found.report, "free-form surface (rat bspline of degree 3 2) left out"), 2u);
    EXPECT_EQ(noted(found.report, "free-form surface (bzp) left out"), 1u);
    EXPECT_EQ(noted(found.report, "curve (rat bspline of degree 3 2) left out"), 1u);
    EXPECT_EQ(noted(found.report, "curve (cdc) left out"), 1u);
    EXPECT_EQ(found.ledger.read_count(), 6u);
    EXPECT_EQ(noted(found.report, "unknown statement"), 0u);
}

/// How often a statement of some type stands in a text, by what a line begins with; lines may go on.
std::size_t statements_in(const std::string& text, const std::set<std::string>& words)
{
    std::size_t count = 0;
    bool goes_on = false;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::string word;
        std::istringstream(line) >> word;
        count += !goes_on && words.count(word) > 0 ? 1 : 0;
        goes_on = !line.empty() && line.back() == '\\';
    }
    return count;
}

TEST(Obj, TheLedgerBalancesForRandomlyChangedFiles)
{
    const std::set<std::string> counted = {"f", "fo", "l", "p", "curv", "curv2", "surf", "bsp", "bzp", "cdc", "cdp"};
    RandomStream random(4);
    for (const char* name : {"room.obj", "cylinder.obj", "damaged.obj", "warped.obj"}) {
        const std::string whole(MappedFile(fixtures / name).bytes());
        for (int round = 0; round < 300; ++round) {
            std::string text = whole;
            for (int change = 0; change < 5; ++change) {
                const std::size_t at = random.bits() % text.size();
                const char letters[] = "0123456789 -/.vfglspe\n";
                text[at] = letters[random.bits() % (sizeof letters - 1)];
            }
            SCOPED_TRACE(text);
            try {
                const Imported found = import_text(text);
                EXPECT_NO_THROW(validate(found.scene));
                EXPECT_EQ(found.ledger.read_count(), statements_in(text, counted));
                std::size_t by_key = 0;
                for (const std::size_t made : found.made_with_key)
                    by_key += made;
                EXPECT_EQ(by_key, found.ledger.made_count());
            } catch (const InputError&) {
                EXPECT_EQ(statements_in(text, {"v", "f"}), 0u);
            }
        }
    }
}

TEST(Obj, ContentDecidesWhetherAFileIsObj)
{
    EXPECT_TRUE(recognize_obj(fixtures / "room.obj"));
    EXPECT_TRUE(recognize_obj(fixtures / "cylinder.obj"));
    EXPECT_FALSE(recognize_obj(fixtures / "room materials.mtl"));
    EXPECT_FALSE(recognize_obj(fixtures / "room.truth.json"));
    EXPECT_FALSE(recognize_obj(fixtures / "make_fixtures.py"));
}

} // namespace
} // namespace lightwell
