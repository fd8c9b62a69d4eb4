#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/random.h"
#include "tests/unit/import_measures/measure.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>

namespace lightwell {
namespace {

using Json = nlohmann::json;

const std::filesystem::path fixtures = LIGHTWELL_ROOT "/tests/fixtures/gltf";

Json truth_of(const std::string& stem)
{
    return Json::parse(std::ifstream(fixtures / (stem + ".truth.json")));
}

Material material_named(const Imported& imported, const std::string& name)
{
    for (const auto& [known, material] : imported.file_materials)
        if (known == name)
            return material;
    throw std::runtime_error("no material " + name);
}

const Surface& surface_named(const Imported& imported, const std::string& name)
{
    for (const Surface& surface : imported.scene.root.surfaces)
        if (surface.name == name)
            return surface;
    throw std::runtime_error("no surface " + name);
}

Material material_of(const Imported& imported, const Surface& surface)
{
    return material_named(imported, imported.keys.at(static_cast<std::size_t>(surface.modifier)).material);
}

/// Intensity of a ball far away: radiance times the disc that it shows.
double candela_of(const Spectrum& radiance, const Sphere& ball)
{
    return lumens_per_watt * photopic(radiance) * pi * ball.radius * ball.radius;
}

TEST(GltfLights, APointLightGivesItsCandelaAtEveryPlaceWhateverTheScaleOfTheNode)
{
    const Imported imported = import_gltf(fixtures / "lights.gltf", {});
    validate(imported.scene);
    const Json truth = truth_of("lights");
    for (const auto& [name, candela] : truth["candela"].items()) {
        const Surface& lamp = surface_named(imported, name);
        ASSERT_EQ(lamp.shape, Shape::sphere);
        const auto material = std::get<Light>(material_of(imported, lamp));
        EXPECT_NEAR(candela_of(material.radiance, imported.scene.root.spheres[lamp.index]), candela.get<double>(),
                    1e-9);
    }
    const Point& bulb = imported.scene.root.spheres[surface_named(imported, "Lamp A").index].centre;
    EXPECT_NEAR(max_abs(bulb - Vec3{1, -3, 2}), 0, 1e-12);
}

TEST(GltfLights, ASpotKeepsCandelaFluxAndAimOfEachPlace)
{
    const Imported imported = import_gltf(fixtures / "lights.gltf", {});
    const Json truth = truth_of("lights");
    const std::map<std::string, Vec3> aims{{"Spot down", {0, 0, -1}}, {"Spot along", {0, 1, 0}}};
    for (const auto& [name, aim] : aims) {
        const Surface& lamp = surface_named(imported, name);
        const auto beam = std::get<Spotlight>(material_of(imported, lamp));
        const double candela = candela_of(beam.radiance, imported.scene.root.spheres[lamp.index]);
        EXPECT_NEAR(candela, truth["beam_candela"].get<double>(), 1e-9);
        const double cone_sr = 2 * pi * (1 - std::cos(0.5 * beam.full_angle_deg * radians_per_degree));
        EXPECT_NEAR(candela * cone_sr, truth["beam_lumen"].get<double>(), 1e-6);
        EXPECT_NEAR(max_abs(beam.aim - aim), 0, 1e-12) << name;
    }
    const Surface& along = surface_named(imported, "Spot along");
    const SurfaceKey& key = imported.keys.at(static_cast<std::size_t>(along.modifier));
    EXPECT_EQ(key.layer, "E-LITE");
    EXPECT_EQ(key.entity, "light");
}

TEST(GltfLights, ADirectionalLightIsADiscInTheSkyThatGivesItsLux)
{
    const Imported imported = import_gltf(fixtures / "lights.gltf", {});
    const Surface& sun = surface_named(imported, "Noon");
    ASSERT_EQ(sun.shape, Shape::source);
    const DistantSource& disc = imported.scene.root.sources[sun.index];
    EXPECT_NEAR(max_abs(disc.to_source - Vec3{0, 0, 1}), 0, 1e-12);
    const auto light = std::get<Light>(material_of(imported, sun));
    const double sine = std::sin(0.5 * disc.full_angle_deg * radians_per_degree); // E = pi L sin^2 of half the angle
    EXPECT_NEAR(pi * sine * sine * luminance_of(light.radiance).value, truth_of("lights")["sun_lux"].get<double>(),
                1e-6);
}

TEST(GltfLights, LampsThatCannotBeAreCountedWithTheirReason)
{
    const Imported imported = import_gltf(fixtures / "lights.gltf", {});
    EXPECT_EQ(imported.ledger.made_count(), truth_of("lights")["made"].get<std::size_t>());
    EXPECT_EQ(skipped_of_type(imported, "light"), truth_of("lights")["skipped"].get<std::size_t>());
    EXPECT_EQ(skipped_for(imported, "unknown type of light"), 1u);
    EXPECT_EQ(skipped_for(imported, "refers to a light that is not there"), 1u);
    EXPECT_EQ(skipped_for(imported, "a light without light, or with impossible angles"), 2u);
}

TEST(GltfPoses, ASkinnedMeshStandsWhereItsBonesAreAndNotWhereItsNodeIs)
{
    const Imported imported = import_gltf(fixtures / "poses.gltf", {});
    validate(imported.scene);
    const Json truth = truth_of("poses");
    const Surface& strip = surface_named(imported, "Skinned");
    EXPECT_NEAR(surface_area_m2(imported.scene.root, strip), truth["skinned_area_m2"].get<double>(), 1e-6);
    const Box bounds = surface_bounds(imported.scene.root, strip);
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        EXPECT_NEAR(bounds.low[axis], truth["skinned_bounds_m"][0][i].get<double>(), 1e-6);
        EXPECT_NEAR(bounds.high[axis], truth["skinned_bounds_m"][1][i].get<double>(), 1e-6);
    }
}

TEST(GltfPoses, MorphTargetsCountWithTheWeightsOfTheNodeElseOfTheMesh)
{
    const Imported imported = import_gltf(fixtures / "poses.gltf", {});
    const Json truth = truth_of("poses");
    const MeasuredModel found = measure(imported);
    for (const auto& [layer, area] : truth["areas_m2"].items())
        EXPECT_NEAR(found.layers.at(layer).area_m2, area.get<double>(), 1e-6) << layer;
    const Box moved = surface_bounds(imported.scene.root, surface_named(imported, "By node"));
    EXPECT_NEAR(moved.low.y, truth["by_node_ground_m"].get<double>(), 1e-6);
    EXPECT_NEAR(moved.high.y, truth["by_node_ground_m"].get<double>(), 1e-6);
    EXPECT_EQ(imported.ledger.made_count(), truth["made"].get<std::size_t>());
    EXPECT_EQ(noted(imported.report, "skin: the mesh stands as its bones do at rest"), 1u);
}

TEST(GltfLooks, PicturesCountWithTheirMeansWhereverTheyAreKept)
{
    const Imported imported = import_gltf(fixtures / "looks.glb", {});
    const Spectrum colour = to_rec709(std::get<Plastic>(material_named(imported, "Pictured")).colour);
    constexpr double gamut = 1e-3; // without blue, the colour lies a little outside the engine's primaries
    EXPECT_NEAR(colour.r, 0.5, gamut);
    EXPECT_NEAR(colour.g, 0.502886, gamut); // sRGB 188 in linear light
    EXPECT_NEAR(std::get<Metal>(material_named(imported, "Data")).roughness, std::pow(0.5 * 128 / 255, 2), 1e-9);
    EXPECT_EQ(noted(imported.report, "baseColorTexture: its mean, 1 0.503 0, is the average"), 1u);
    ASSERT_EQ(imported.file_textures.size(), 4u);
    const FileTexture& inside = imported.file_textures[0];
    EXPECT_EQ(inside.material, "Pictured");
    EXPECT_EQ(MappedFile(inside.file).bytes().substr(inside.offset, 4), "\x89PNG");
    EXPECT_FALSE(inside.placement.repeats);
    // u' = 2 u + 0.1; v' = 3 v + 0.2 with v down is 3 v + 1 - 3 - 0.2 with v up
    const std::array<double, 6> expected{2, 0, 0.1, 0, 3, -2.2};
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(inside.placement.to_picture[i], expected[i], 1e-12) << i;
    const FileTexture& normals = imported.file_textures[1];
    EXPECT_TRUE(normals.bytes);
    EXPECT_EQ(normals.strength[1], 0.5);
    EXPECT_TRUE(normals.laid);
    EXPECT_EQ(noted(imported.report, "normalTexture bends the normals"), 1u);
    EXPECT_FALSE(imported.file_textures[2].laid); // of roughness and metal
    EXPECT_EQ(imported.file_textures[3].file.filename(), "holes.png");
}

TEST(GltfLooks, VertexColoursMultiplyTheBaseColourWithTheirMeanOverTheArea)
{
    const Imported imported = import_gltf(fixtures / "colours.gltf", {});
    const Json truth = truth_of("colours");
    constexpr double eight_bits = 6e-3; // a step of sRGB, in linear light
    std::size_t met = 0;
    for (const SurfaceKey& key : imported.keys) {
        if (!truth["base_colours"].contains(key.layer))
            continue;
        ++met;
        SCOPED_TRACE(key.layer + ": " + key.material);
        const auto named = std::find_if(imported.file_materials.begin(), imported.file_materials.end(),
                                        [&](const auto& own) { return own.first == key.material; });
        ASSERT_NE(named, imported.file_materials.end());
        const Json& expected = truth["base_colours"][key.layer];
        ASSERT_TRUE(key.colour);
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR((*key.colour)[channel], expected[static_cast<std::size_t>(channel)].get<double>(), eight_bits);
    }
    EXPECT_EQ(met, 4u);
    EXPECT_EQ(noted(imported.report, "vertex colours: their mean"), truth["notes"].get<std::size_t>());
}

TEST(GltfLooks, CutOutAndBlendedSurfacesCoverTheirShare)
{
    const Imported imported = import_gltf(fixtures / "looks.glb", {});
    const auto holes = std::get<Trans>(material_named(imported, "Holes"));
    const double passed = photopic(holes.colour) * (1 - holes.specularity) * holes.transmission;
    EXPECT_NEAR(passed, 1 - truth_of("looks")["share_holes"].get<double>(), 1e-9);
    const auto veil = std::get<Trans>(material_named(imported, "Veil"));
    const double through = photopic(veil.colour) * (1 - veil.specularity) * veil.transmission;
    EXPECT_NEAR(through, 1 - truth_of("looks")["opacity_veil"].get<double>(), 1e-9);
}

TEST(GltfLooks, AVolumeIsABodyWhereItsMeshIsClosedAndAPaneWhereItIsNot)
{
    const Imported imported = import_gltf(fixtures / "looks.glb", {});
    const auto water = std::get<Dielectric>(material_named(imported, "Water"));
    EXPECT_NEAR(water.transmission_per_m.g, truth_of("looks")["per_metre"].get<double>(), 1e-9); // 0.25 after 2 m
    EXPECT_EQ(water.index, 1.33);
    EXPECT_TRUE(std::holds_alternative<Glass>(material_named(imported, "Open water")));
    EXPECT_EQ(noted(imported.report, "transparent body has an open mesh"), 1u);
    const Imported smaller = import_gltf(fixtures / "looks.glb", ImportOptions{.metres_per_unit = 0.5, .up = ""});
    EXPECT_NEAR(std::get<Dielectric>(material_named(smaller, "Water")).transmission_per_m.g, 0.25, 1e-9);
}

TEST(GltfLooks, LayersOverAPlasticFollowTheStatedRule)
{
    const Imported imported = import_gltf(fixtures / "looks.glb", {});
    EXPECT_NEAR(std::get<Plastic>(material_named(imported, "Cloth")).colour.g, 0.192, 1e-6);
    const auto car = std::get<Plastic>(material_named(imported, "Car"));
    EXPECT_NEAR(car.specularity, 0.0784, 1e-9);                                                   // 1 - 0.96^2
    EXPECT_NEAR(car.roughness, 0.125, 1e-9);                                                      // half of 0.5^2
    EXPECT_NEAR(std::get<Plastic>(material_named(imported, "Specular")).specularity, 0.04, 1e-6); // 0.04 * 2 * 0.5
    EXPECT_NEAR(std::get<Metal>(material_named(imported, "Brushed")).roughness, 0.5, 1e-9);       // sqrt(1 * 0.25)
    const auto shade = std::get<Trans>(material_named(imported, "Shade"));
    EXPECT_NEAR(photopic(shade.colour) * shade.transmission, 0.2, 1e-9);
    EXPECT_NEAR(photopic(shade.colour) * (1 - shade.transmission), 0.3, 1e-9);
    const auto gloss = std::get<Plastic>(material_named(imported, "Gloss"));
    EXPECT_NEAR(gloss.specularity, 0.2, 1e-9);
    EXPECT_NEAR(gloss.roughness, 0.25, 1e-9);
    EXPECT_EQ(noted(imported.report, "KHR_materials_iridescence is not modelled yet"), 1u);
    EXPECT_EQ(noted(imported.report, "variants of materials; the default is taken (beach, midnight)"), 2u);
    for (const auto& [name, material] : imported.file_materials)
        EXPECT_NO_THROW(validate_material(material, name));
}

/// Entities that a file must account for, by the numbers of its own text: primitives of shown meshes and lamps.
std::size_t entities_in(const Json& file)
{
    const auto list = [&](const char* key) { return file.contains(key) ? file[key] : Json::array(); };
    std::vector<bool> shown(list("meshes").size());
    std::size_t count = 0;
    for (const Json& node : list("nodes")) { // every node of these fixtures is in the scene
        if (node.contains("mesh"))
            shown.at(node["mesh"].get<std::size_t>()) = true;
        count += node.contains("extensions") && node["extensions"].contains("KHR_lights_punctual") ? 1 : 0;
    }
    for (std::size_t i = 0; i < shown.size(); ++i)
        count += shown[i] ? file["meshes"][i]["primitives"].size() : 0;
    return count;
}

/// The JSON of a fixture with one number, drawn at random, changed.
void change_a_number(Json& file, RandomStream& random)
{
    std::vector<Json*> numbers, open;
    for (const char* key : {"accessors", "bufferViews", "materials"})
        if (file.contains(key))
            open.push_back(&file[key]);
    for (Json& node : file["nodes"])
        for (const char* key : {"translation", "rotation", "scale", "weights"})
            if (node.contains(key))
                open.push_back(&node[key]);
    while (!open.empty()) {
        Json* at = open.back();
        open.pop_back();
        if (at->is_number())
            numbers.push_back(at);
        else if (at->is_structured())
            for (Json& item : *at)
                open.push_back(&item);
    }
    const double values[] = {0, 1, -1, 3, 255, 1e9, 5126, 0.5, 1e300, 4294967295.0};
    *numbers[random.bits() % numbers.size()] = values[random.bits() % std::size(values)];
}

TEST(GltfLedger, BalancesForFilesWithRandomlyChangedNumbers)
{
    const std::filesystem::path copy = std::filesystem::temp_directory_path() / "lightwell_ledger.gltf";
    RandomStream random(11);
    std::size_t read = 0, refused = 0;
    for (const char* name : {"lights.gltf", "poses.gltf", "nodes.gltf", "modes.gltf", "packings.gltf"}) {
        const Json whole = Json::parse(std::ifstream(fixtures / name));
        for (int round = 0; round < 200; ++round) {
            Json changed = whole;
            change_a_number(changed, random);
            write_text_atomically(copy, changed.dump());
            SCOPED_TRACE(changed.dump());
            try {
                const Imported imported = import_gltf(copy, {});
                EXPECT_NO_THROW(validate(imported.scene));
                EXPECT_EQ(imported.ledger.read_count(), entities_in(changed));
                ++read;
            } catch (const InputError&) {
                ++refused;
            }
        }
    }
    std::filesystem::remove(copy);
    EXPECT_GT(read, 500u);
    EXPECT_GT(refused, 5u);
}

TEST(GltfTree, AChainOfThousandsOfNodesIsReadInReasonableTimeAndMemory)
{
    const std::filesystem::path file = std::filesystem::temp_directory_path() / "lightwell_chain.gltf";
    Json chain = Json::parse(std::ifstream(fixtures / "nodes.gltf"));
    chain["nodes"] = Json::array();
    constexpr int length = 20000;
    for (int i = 0; i < length; ++i) {
        Json node{{"mesh", 0}};
        if (i + 1 < length)
            node["children"] = Json::array({i + 1});
        chain["nodes"].push_back(node);
    }
    chain["nodes"][0]["name"] = "Top";
    chain["scenes"][0]["nodes"] = Json::array({0});
    write_text_atomically(file, chain.dump());
    const Imported imported = import_gltf(file, {});
    std::filesystem::remove(file);
    EXPECT_EQ(imported.scene.root.instances.size(), static_cast<std::size_t>(length));
    EXPECT_EQ(measure(imported).layers.size(), 1u);
    EXPECT_EQ(imported.scene.root.surfaces.back().name.substr(0, 4), ".../");
}

} // namespace
} // namespace lightwell
