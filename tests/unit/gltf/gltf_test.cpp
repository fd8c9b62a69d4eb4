#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "importers/layers.h"
#include "tests/unit/import_measures/measure.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>
#include <fstream>
#include <set>

namespace lightwell {
namespace {

using Json = nlohmann::json;

const std::filesystem::path fixtures = LIGHTWELL_ROOT "/tests/fixtures/gltf";

Json truth_of(const std::string& stem)
{
    return Json::parse(std::ifstream(fixtures / (stem + ".truth.json")));
}

/// Imports bytes through a file of its own, which is removed afterwards.
Imported import_bytes(const std::string& bytes, const ImportOptions& options = {})
{
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / (std::string("lightwell_") + test->name() + ".gltf");
    write_text_atomically(file, bytes);
    struct Remove {
        std::filesystem::path path;
        ~Remove() { std::filesystem::remove(path); }
    } remove{file};
    return import_gltf(file, options);
}

std::string message_of(const std::string& bytes)
{
    try {
        import_bytes(bytes);
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

const Material& material_named(const Imported& imported, const std::string& name)
{
    for (const auto& [known, material] : imported.file_materials)
        if (known == name)
            return material;
    throw std::runtime_error("no material " + name);
}

/// Area vector of each layer in the world: its direction is the front side.
std::map<std::string, Vec3> fronts(const Imported& imported)
{
    std::map<std::string, Vec3> sums;
    visit_expanded(imported.scene, [&](const Part& part, const Surface& surface, const Affine& to_world,
                                       ModifierId modifier) {
        const Mesh& mesh = *part.meshes.at(surface.index);
        for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
            const Point& a = mesh.points[mesh.triangles[i]];
            const Vec3 front = cross(mesh.points[mesh.triangles[i + 1]] - a, mesh.points[mesh.triangles[i + 2]] - a);
            sums[imported.keys.at(static_cast<std::size_t>(modifier)).layer] +=
                transform_normal(to_world, normalized(front));
        }
    });
    return sums;
}

TEST(Gltf, LayersComeFromExtrasThenNodesAndAreasSurviveMirroringAndStretching)
{
    const Imported imported = import_gltf(fixtures / "nodes.gltf", {});
    validate(imported.scene);
    const Json truth = truth_of("nodes");
    const MeasuredModel found = measure(imported);
    EXPECT_EQ(found.layers.size(), truth["layers"].size());
    for (const auto& [layer, area] : truth["layers"].items()) {
        ASSERT_TRUE(found.layers.count(layer)) << layer;
        EXPECT_NEAR(found.layers.at(layer).area_m2, area.get<double>(), 1e-6) << layer;
    }
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        EXPECT_NEAR(found.bounds.low[axis], truth["bounds_m"][0][i].get<double>(), 1e-6);
        EXPECT_NEAR(found.bounds.high[axis], truth["bounds_m"][1][i].get<double>(), 1e-6);
    }
    EXPECT_EQ(imported.unit, "m (glTF)");
    EXPECT_EQ(noted(imported.report, "mesh that no node of the scene shows"), 1u);
}

TEST(Gltf, AMeshUsedByManyNodesIsStoredOnce)
{
    const Imported imported = import_gltf(fixtures / "nodes.gltf", {});
    const Json truth = truth_of("nodes");
    EXPECT_EQ(imported.scene.prototypes.size(), truth["prototypes"].get<std::size_t>());
    EXPECT_EQ(imported.scene.root.instances.size(), truth["instances"].get<std::size_t>());
    EXPECT_EQ(imported.scene.root.meshes.size(), 1u);
    EXPECT_EQ(imported.ledger.made_count(), 2u); // primitives of shown meshes, each once
}

TEST(Gltf, TheFrontStaysTheFrontUnderMirroringAndTurning)
{
    const Imported imported = import_gltf(fixtures / "nodes.gltf", {});
    const std::map<std::string, Vec3> found = fronts(imported);
    for (const auto& [layer, front] : truth_of("nodes")["fronts"].items()) {
        const Vec3 expected{front[0].get<double>(), front[1].get<double>(), front[2].get<double>()};
        EXPECT_NEAR(max_abs(normalized(found.at(layer)) - expected), 0, 1e-6) << layer;
    }
}

TEST(Gltf, TheKeyHoldsNodePathMeshAndMaterial)
{
    const Imported imported = import_gltf(fixtures / "nodes.gltf", {});
    for (const SurfaceKey& key : imported.keys) {
        if (key.layer != "A-WALL")
            continue;
        EXPECT_EQ(key.group, "A-WALL/node2");
        EXPECT_EQ(key.block, "Panel");
        EXPECT_EQ(key.material, "Paint");
        EXPECT_EQ(key.entity, "mesh");
        return;
    }
    FAIL() << "no key of layer A-WALL";
}

TEST(Gltf, EveryPackingOfNumbersGivesTheSamePanel)
{
    const Imported imported = import_gltf(fixtures / "packings.gltf", {});
    validate(imported.scene);
    const Json truth = truth_of("packings");
    const MeasuredModel found = measure(imported);
    std::set<std::string> with_normals;
    for (const Surface& surface : imported.scene.root.surfaces)
        if (!imported.scene.root.meshes[surface.index]->normals.empty())
            with_normals.insert(surface.name);
    for (const std::string layer : truth["layers"]) {
        ASSERT_TRUE(found.layers.count(layer)) << layer;
        EXPECT_NEAR(found.layers.at(layer).area_m2, truth["area_each_m2"].get<double>(), 2e-4) << layer; // 15 bits
    }
    EXPECT_EQ(with_normals, truth["with_normals"].get<std::set<std::string>>());
}

TEST(Gltf, InterpolatedNormalsAreTurnedIntoTheWorld)
{
    const Imported imported = import_gltf(fixtures / "packings.gltf", {});
    for (const Surface& surface : imported.scene.root.surfaces) {
        if (surface.name != "interleaved")
            continue;
        for (const Direction& normal : imported.scene.root.meshes[surface.index]->normals)
            EXPECT_NEAR(max_abs(normal - Vec3{0, -0.8, 0.6}), 0, 1e-6); // (0, .6, .8) of the file, y up
    }
}

TEST(Gltf, StripsAndFansUnrollAndPointsAndLinesAreCounted)
{
    const Imported imported = import_gltf(fixtures / "modes.gltf", {});
    const Json truth = truth_of("modes");
    const MeasuredModel found = measure(imported);
    const std::map<std::string, Vec3> front = fronts(imported);
    EXPECT_EQ(found.layers.size(), truth["area_m2"].size());
    for (const auto& [layer, area] : truth["area_m2"].items()) {
        EXPECT_NEAR(found.layers.at(layer).area_m2, area.get<double>(), 1e-6) << layer;
        const double along_file_z = -normalized(front.at(layer)).y;
        EXPECT_NEAR(along_file_z, truth["front_z_file"][layer].get<double>(), 1e-6) << layer;
    }
    for (const auto& [type, count] : truth["skipped"].items())
        EXPECT_EQ(skipped_of_type(imported, type), count.get<std::size_t>()) << type;
    EXPECT_EQ(imported.ledger.read_count(), 9u);
}

TEST(Gltf, MaterialsFollowTheStatedRule)
{
    const Imported imported = import_gltf(fixtures / "materials.glb", {});
    validate(imported.scene);
    const auto& matt = std::get<Plastic>(material_named(imported, "Matt"));
    EXPECT_NEAR(to_rec709(matt.colour).g, 0.4, 1e-9);
    EXPECT_EQ(matt.specularity, 0);
    const auto& metal = std::get<Metal>(material_named(imported, "Metal"));
    EXPECT_NEAR(metal.roughness, 0.25, 1e-12);
    EXPECT_NEAR(to_rec709(metal.colour).b, 0.7, 1e-9);
    const auto& plastic = std::get<Plastic>(material_named(imported, "Plastic"));
    EXPECT_NEAR(plastic.specularity, 1.0 / 36, 1e-12); // (0.4 / 2.4)^2
    EXPECT_NEAR(plastic.roughness, 0.09, 1e-12);
    const auto& window = std::get<Glass>(material_named(imported, "Window"));
    EXPECT_NEAR(to_rec709(window.transmissivity).g, 0.95, 1e-9);
    EXPECT_EQ(window.index, 1.52);
    EXPECT_NEAR(std::get<Glass>(material_named(imported, "Blend")).transmissivity.g, 0.75, 1e-12);
    const auto& lamp = std::get<Light>(material_named(imported, "Lamp"));
    EXPECT_NEAR(luminance_of(lamp.radiance).value, truth_of("materials")["lamp_luminance_cd_per_m2"].get<double>(),
                1e-3);
    EXPECT_EQ(noted(imported.report, "its file \"not there.png\" is not there"), 1u);
    EXPECT_EQ(noted(imported.report, "animation"), 1u);
    EXPECT_NO_THROW(material_named(imported, "material6"));
    for (const auto& [name, material] : imported.file_materials)
        EXPECT_NO_THROW(validate_material(material, name));
}

TEST(Gltf, CamerasBecomeViewsLightsBecomeSourcesAndCopiesAreInstances)
{
    const Imported imported = import_gltf(fixtures / "materials.glb", {});
    const Json truth = truth_of("materials");
    ASSERT_EQ(imported.scene.views.size(), 2u);
    const View& eye = imported.scene.views[0];
    EXPECT_EQ(eye.name, "Eye");
    EXPECT_NEAR(max_abs(eye.position - Vec3{1, -3, 2}), 0, 1e-12);
    EXPECT_NEAR(max_abs(eye.direction - Vec3{0, 1, 0}), 0, 1e-12);
    EXPECT_NEAR(eye.vertical, truth["eye_vertical_deg"].get<double>(), 1e-9);
    EXPECT_NEAR(eye.horizontal, truth["eye_horizontal_deg"].get<double>(), 1e-9);
    const View& plan = imported.scene.views[1];
    EXPECT_EQ(plan.kind, View::Kind::parallel);
    EXPECT_NEAR(plan.horizontal, 6, 1e-12);
    EXPECT_NEAR(max_abs(plan.direction - Vec3{0, 0, -1}), 0, 1e-12);
    EXPECT_EQ(imported.scene.root.spheres.size(), 1u);
    EXPECT_EQ(imported.scene.root.instances.size(), 3u);
    EXPECT_NEAR(measure(imported).layers.at("Chairs").area_m2, truth["chairs_area_m2"].get<double>(), 1e-6);
}

TEST(Gltf, ALayerMapReachesEachInstanceOfASharedMesh)
{
    Imported imported = import_gltf(fixtures / "nodes.gltf", {});
    LayerMap map;
    LayerRule wall, floor;
    wall.layer = "A-WALL";
    wall.use = "Paint";
    floor.layer = "A-FLOR*";
    floor.use = "void";
    map.rules = {wall, floor};
    apply_layer_map(imported, map);
    validate(imported.scene);
    double area = 0;
    visit_expanded(imported.scene,
                   [&](const Part& part, const Surface& surface, const Affine& to_world, ModifierId modifier) {
                       EXPECT_NE(resolve(imported.scene, modifier).material, nullptr);
                       Share share;
                       Box bounds;
                       measure_surface(part, surface, to_world, share, bounds);
                       area += share.area_m2;
                   });
    EXPECT_NEAR(area, 2 + 2 + 6 + 2, 1e-6); // all but the panel of A-FLOR-2
}

TEST(Gltf, OptionsOverrideUnitAndUpAxis)
{
    const Imported imported = import_gltf(fixtures / "nodes.gltf", ImportOptions{.metres_per_unit = 0.01, .up = "z"});
    EXPECT_NEAR(measure(imported).bounds.high.y, 0.2, 1e-9);
    EXPECT_EQ(imported.unit, "cm (given)");
    EXPECT_THROW(import_gltf(fixtures / "nodes.gltf", ImportOptions{.metres_per_unit = -1, .up = ""}), InputError);
    EXPECT_THROW(import_gltf(fixtures / "nodes.gltf", ImportOptions{.metres_per_unit = {}, .up = "w"}), InputError);
}

/// The panel of one triangle, with one thing in it replaced.
std::string small_file(const std::string& from = "", const std::string& to = "")
{
    std::string text =
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"children":[1]},{"name":"b"}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
    const std::size_t at = from.empty() ? std::string::npos : text.find(from);
    if (at != std::string::npos)
        text.replace(at, from.size(), to);
    return text;
}

TEST(Gltf, AbsurdNumbersEndInOneClearErrorThatNamesTheAccessor)
{
    EXPECT_NEAR(measure(import_bytes(small_file())).total.area_m2, 0.5, 1e-7);
    const auto error_with = [](const std::string& from, const std::string& to) {
        return message_of(small_file(from, to));
    };
    EXPECT_NE(error_with("\"count\":3", "\"count\":2147483648").find("accessor 0: 2147483648 elements"),
              std::string::npos);
    EXPECT_NE(error_with("\"count\":3", "\"count\":4").find("do not fit the buffer view of 36 bytes"),
              std::string::npos);
    EXPECT_NE(error_with("\"bufferView\":0", "\"bufferView\":99").find("buffer view 99 of 1"), std::string::npos);
    EXPECT_NE(error_with("\"buffer\":0", "\"buffer\":7").find("buffer 7 of 1"), std::string::npos);
    EXPECT_NE(error_with("\"byteLength\":36}]", "\"byteLength\":1099511627776}]").find("1099511627776"),
              std::string::npos);
    EXPECT_NE(error_with("\"byteLength\":36,", "\"byteLength\":999,").find("it says 999 bytes and has 36"),
              std::string::npos);
    EXPECT_NE(error_with("\"mesh\":0", "\"mesh\":77").find("mesh 77 of 1"), std::string::npos);
    EXPECT_NE(error_with("\"POSITION\":0", "\"POSITION\":-5").find("accessor -5 of 1"), std::string::npos);
    EXPECT_NE(error_with("VEC3", "VEC2").find("has 2 components, expected 3"), std::string::npos);
    EXPECT_NE(error_with("AACAPw", "AACAfw").find("not finite"), std::string::npos);
    EXPECT_NE(error_with("base64,", "base64,!").find("not base64"), std::string::npos);
    EXPECT_NE(error_with("\"2.0\"", "\"1.0\"").find("version is \"1.0\", expected 2.0"), std::string::npos);
}

TEST(Gltf, NodesThatFormACircleOrHaveTwoParentsAreRefused)
{
    EXPECT_NE(message_of(small_file("{\"name\":\"b\"}", "{\"children\":[0]}")).find("has a parent"), std::string::npos);
    EXPECT_NE(message_of(small_file("\"children\":[1]", "\"children\":[1,1]")).find("two parents"), std::string::npos);
    EXPECT_NE(message_of(small_file("\"children\":[1]", "\"children\":[8]")).find("child 8 of 2"), std::string::npos);
    EXPECT_NE(message_of(small_file("\"nodes\":[0]", "\"nodes\":[0,0]")).find("twice"), std::string::npos);
}

TEST(Gltf, BracketsNestedBeyondReasonAreRefusedBeforeAnyParserSeesThem)
{
    const std::string deep = "{\"asset\":{\"version\":\"2.0\"},\n\"extras\":" + std::string(200000, '[');
    EXPECT_NE(message_of(deep).find(":2: brackets nest deeper than 128"), std::string::npos);
}

TEST(Gltf, ATruncatedFileIsRefusedAtEveryLengthOrGivesAValidScene)
{
    const MappedFile mapped(fixtures / "materials.glb");
    const std::string whole(mapped.bytes());
    for (std::size_t size = 0; size < whole.size(); size += 13)
        EXPECT_THROW(import_bytes(whole.substr(0, size)), InputError) << size;
    const std::string text = small_file();
    for (std::size_t size = 0; size < text.size(); ++size)
        EXPECT_THROW(import_bytes(text.substr(0, size)), InputError) << size;
}

TEST(Gltf, OneWrongByteAnywhereNeverCrashes)
{
    const MappedFile mapped(fixtures / "materials.glb");
    const std::string whole(mapped.bytes());
    std::size_t refused = 0, read = 0;
    for (std::size_t at = 0; at < whole.size(); at += 3) {
        std::string bytes = whole;
        bytes[at] = static_cast<char>(bytes[at] ^ (at % 2 ? 0x15 : 0xff));
        try {
            validate(import_bytes(bytes).scene);
            ++read;
        } catch (const InputError&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 0u);
    EXPECT_GT(read, 0u);
}

TEST(Gltf, ADamagedPrimitiveIsLeftOutAndTheRestIsKept)
{
    const std::string two = "\"primitives\":[{\"attributes\":{\"POSITION\":9}},{\"attributes\":{\"POSITION\":0}}]";
    const Imported imported = import_bytes(small_file("\"primitives\":[{\"attributes\":{\"POSITION\":0}}]", two));
    EXPECT_EQ(imported.ledger.made_count(), 1u);
    EXPECT_EQ(skipped_for(imported, "damaged"), 1u);
    EXPECT_EQ(noted(imported.report, "accessor 9 of 1"), 1u);
}

TEST(Gltf, PrimitivesThatShareVerticesKeepOnlyTheirOwn)
{
    const Imported imported = import_gltf(fixtures / "modes.gltf", {});
    for (const Surface& surface : imported.scene.root.surfaces) {
        const Mesh& mesh = *imported.scene.root.meshes[surface.index];
        const std::set<std::uint32_t> used(mesh.triangles.begin(), mesh.triangles.end());
        EXPECT_EQ(used.size(), mesh.points.size()) << surface.name;
    }
    const Imported small = import_bytes(small_file("\"count\":3,", "\"count\":2,"));
    EXPECT_TRUE(measure(small).bounds.empty()) << "two vertices make no triangle";
}

TEST(Gltf, ThousandsOfPrimitivesThatRepeatOneAccessorAreRefused)
{
    std::string text = R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"accessors":[{"bufferView":0,"componentType":5126,"count":10000,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":120000}],
"buffers":[{"byteLength":120000,"uri":"data:application/octet-stream;base64,)";
    text.append(160000, 'A').append("\"}],\"meshes\":[{\"primitives\":[");
    for (int i = 0; i < 4000; ++i)
        text.append(i ? "," : "").append("{\"attributes\":{\"POSITION\":0}}");
    EXPECT_NE(message_of(text + "]}]}").find("repeat the same accessors"), std::string::npos);
}

TEST(Gltf, ContentDecidesWhetherAFileIsGltf)
{
    EXPECT_TRUE(recognize_gltf(fixtures / "nodes.gltf"));
    EXPECT_TRUE(recognize_gltf(fixtures / "materials.glb"));
    EXPECT_FALSE(recognize_gltf(fixtures / "nodes.truth.json"));
    EXPECT_FALSE(recognize_gltf(fixtures / "make_fixtures.py"));
    EXPECT_THROW(import_gltf(fixtures / "make_fixtures.py", {}), InputError);
}

} // namespace
} // namespace lightwell
