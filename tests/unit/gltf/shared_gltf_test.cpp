#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "tests/unit/import_measures/deviations.h"
#include "tests/unit/import_measures/measure.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <fstream>
#include <iostream>
#include <set>

namespace lightwell {
namespace {

using Json = nlohmann::json;

Json manifest(const std::string& kind)
{
    std::ifstream in(shared_fixtures() / kind / "MANIFEST.json");
    return in ? Json::parse(in)["entries"] : Json();
}

/// File axes, so that the truth's numbers compare.
ImportOptions as_written()
{
    return ImportOptions{.metres_per_unit = {}, .up = "z"};
}

/// The truth calls a primitive without material "(none)" and a nameless material "#3".
std::string our_name(const std::string& name)
{
    if (name == "(none)")
        return {};
    return name[0] == '#' ? std::string("material").append(name.substr(1)) : name;
}

/// `Paint #a0b0c0` is Paint under vertex colours.
std::string without_vertex_colour(const std::string& name)
{
    constexpr std::size_t digits = 7; // #rrggbb
    if (name.size() < digits || name[name.size() - digits] != '#' ||
        name.find_first_not_of("0123456789abcdef", name.size() - digits + 1) != std::string::npos)
        return name;
    return name.substr(0, name.size() == digits ? 0 : name.size() - digits - 1);
}

bool bounds_agree(const Box& bounds, const Json& truth)
{
    if (truth.is_null() || bounds.empty())
        return truth.is_null() == bounds.empty();
    for (int axis = 0; axis < 3; ++axis) { // given with six digits
        const auto i = static_cast<std::size_t>(axis);
        const double low = truth["min"][i], high = truth["max"][i];
        const double tolerance = 2e-5 * std::fmax(1e-2, std::fmax(std::fabs(low), std::fabs(high)));
        if (std::fabs(bounds.low[axis] - low) > tolerance || std::fabs(bounds.high[axis] - high) > tolerance)
            return false;
    }
    return true;
}

/// What of the truth of the shown scene is not found again.
std::set<std::string> differences(const Imported& imported, const Json& truth)
{
    std::set<std::string> items;
    const MeasuredModel found = measure(imported);
    if (skipped_for(imported, "damaged") > 0)
        items.insert("damaged parts left out");
    if (noted(imported.report, "triangle without area") + skipped_for(imported, "zero area") > 0)
        items.insert("triangles without area left out");
    if (!truth.contains("default_scene"))
        return items;
    const Json& scene = truth["default_scene"];
    if (found.total.triangles != scene["triangles"].get<std::size_t>())
        items.insert("triangles");
    std::map<std::string, std::size_t> expected, materials;
    for (const auto& [name, count] : scene.at("triangles_per_material").items())
        if (count.get<std::size_t>() > 0)
            expected[our_name(name)] = count;
    for (const auto& [name, share] : found.materials)
        if (share.triangles > 0)
            materials[without_vertex_colour(name)] += share.triangles;
    if (materials != expected)
        items.insert("triangles by material");
    if (scene.value("bbox_exact", false) && !bounds_agree(found.bounds, scene.value("world_bbox", Json())))
        items.insert("bounds");
    return items;
}

const char* const points_and_lines = "the truth's box holds points and lines, which have no area";
const char* const without_area = "five triangles of the file have no area and are dropped with a note";

const std::vector<Deviation> meant_to_differ = {
    {"blender-io/01_vertex_count_32bit/01_vertex_count_32bit.gltf", "refused", "its companion is not among the files"},
    {"assimp/glTF/BoxTextured-glTF-Embedded/BoxTextured.gltf", "refused", "glTF 1.0"},
    {"blender-io/22_vertex_color/22_vertex_color.gltf", "bounds", points_and_lines},
    {"primitive-modes/Mesh_PrimitiveMode_00.gltf", "bounds", points_and_lines},
    {"primitive-modes/Mesh_PrimitiveMode_02.gltf", "bounds", points_and_lines},
    {"primitive-modes/Mesh_PrimitiveMode_08.gltf", "bounds", points_and_lines},
    {"primitive-modes/Mesh_PrimitiveMode_10.gltf", "bounds", points_and_lines},
    {"interiors/hall.glb", "triangles", without_area},
    {"interiors/hall.glb", "triangles by material", without_area},
    {"interiors/hall.glb", "triangles without area left out", without_area},
    {"magnum/mesh-multiple-primitives.gltf", "triangles without area left out", "its accessors have no elements"},
};

TEST(SharedGltf, EveryFileAgreesWithCountsAndBoundsFoundByIndependentScripts)
{
    const Json entries = manifest("gltf");
    if (entries.is_null())
        GTEST_SKIP() << "the files from elsewhere are not at hand";
    Deviations deviations(meant_to_differ);
    for (const Json& entry : entries) {
        const std::string file = entry["file"];
        SCOPED_TRACE(file);
        const std::filesystem::path path = shared_fixtures() / "gltf" / file;
        EXPECT_TRUE(recognize_gltf(path));
        try {
            const Imported imported = import_gltf(path, as_written());
            EXPECT_NO_THROW(validate(imported.scene));
            deviations.file(file, differences(imported, entry.at("ground_truth")));
        } catch (const InputError& error) {
            deviations.file(file, {"refused"});
        }
    }
    EXPECT_EQ(deviations.finish(std::cout), std::vector<std::string>{});
}

/// Zero errors in the Khronos report: must load; no file may crash, hang or give an invalid scene.
TEST(SharedGltf, FilesThatTheReferenceValidatorAcceptsLoadAndBrokenOnesNeverCrash)
{
    const Json entries = manifest("gltf-malformed");
    if (entries.is_null())
        GTEST_SKIP() << "the malformed files are not at hand";
    std::size_t accepted = 0, refused = 0;
    for (const Json& entry : entries) {
        const std::string file = entry["file"];
        SCOPED_TRACE(file);
        const Json& truth = entry["ground_truth"];
        const bool must_load =
            truth.contains("khronos_validator") && truth["khronos_validator"].value("errors", 1) == 0;
        try {
            const Imported imported = import_gltf(shared_fixtures() / "gltf-malformed" / file, as_written());
            EXPECT_NO_THROW(validate(imported.scene));
            ++accepted;
        } catch (const InputError& error) {
            EXPECT_FALSE(must_load) << error.what();
            ++refused;
        }
    }
    std::cout << accepted << " read, " << refused << " refused\n";
    EXPECT_GE(accepted + refused, 190u);
}

/// Imports copies of a file with one wrong byte each.  @return how many were read
std::size_t read_with_wrong_bytes(const std::filesystem::path& folder, const std::string& main_file,
                                  const std::string& damaged_file, std::size_t step)
{
    const std::filesystem::path copy = std::filesystem::temp_directory_path() / "lightwell_wrong_bytes";
    std::filesystem::remove_all(copy);
    std::filesystem::copy(folder, copy, std::filesystem::copy_options::recursive);
    const MappedFile mapped(folder / damaged_file);
    const std::string whole(mapped.bytes());
    std::size_t read = 0;
    for (std::size_t at = 0; at < whole.size(); at += step) {
        std::string bytes = whole;
        bytes[at] = static_cast<char>(bytes[at] ^ (at % 2 ? 0x15 : 0xff));
        write_text_atomically(copy / damaged_file, bytes);
        try {
            validate(import_gltf(copy / main_file, {}).scene);
            ++read;
        } catch (const InputError&) {
            continue;
        }
    }
    std::filesystem::remove_all(copy);
    return read;
}

TEST(SharedGltf, OneWrongByteInPackedDataNeverCrashes)
{
    const std::filesystem::path folder = shared_fixtures() / "gltf";
    if (!std::filesystem::exists(folder))
        GTEST_SKIP() << "the files from elsewhere are not at hand";
    const std::filesystem::path draco = folder / "online3dviewer/Box/glTF-Draco";
    std::string packed;
    for (const auto& entry : std::filesystem::directory_iterator(draco))
        if (entry.path().extension() == ".bin")
            packed = entry.path().filename().string();
    EXPECT_GT(read_with_wrong_bytes(draco, "Box.gltf", packed, 1), 0u);
    EXPECT_GT(read_with_wrong_bytes(folder / "gltf-transform", "BoxMeshopt.glb", "BoxMeshopt.glb", 3), 0u);
}

/// Area of the nodes whose layer begins so.
double area_of(const MeasuredModel& found, const std::string& start)
{
    double area = 0;
    for (const auto& [layer, share] : found.layers)
        if (layer.rfind(start, 0) == 0)
            area += share.area_m2;
    return area;
}

TEST(SharedGltf, TheOfficeKeepsItsAreasCamerasAndCopies)
{
    const std::filesystem::path folder = shared_fixtures() / "hosts/blender_office";
    if (!std::filesystem::exists(folder))
        GTEST_SKIP() << "the office is not at hand";
    const Json truth = Json::parse(std::ifstream(folder / "truth.json"));
    for (const char* name : {"office.glb", "office.gltf"}) {
        SCOPED_TRACE(name);
        const Imported office = import_gltf(folder / name, {});
        validate(office.scene);
        const MeasuredModel found = measure(office);
        EXPECT_NEAR(area_of(found, "Floor"), 24, 1e-4);
        EXPECT_NEAR(area_of(found, "Ceiling"), 24, 1e-4);
        EXPECT_NEAR(area_of(found, "Wall ") + area_of(found, "Door leaf"), 53.55, 1e-4);
        EXPECT_NEAR(area_of(found, "Window pane"), 5.25, 1e-4);
        EXPECT_NEAR(area_of(found, "LED panel"), 0.72, 1e-4);
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<std::size_t>(axis);
            EXPECT_NEAR(found.bounds.low[axis], truth["bbox_metres"][0][i].get<double>(), 1e-5);
            EXPECT_NEAR(found.bounds.high[axis], truth["bbox_metres"][1][i].get<double>(), 1e-5);
        }
        ASSERT_GE(office.scene.views.size(), 2u);
        const View& view = office.scene.views[0];
        const Json& camera = truth["cameras"][view.name];
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(view.position[axis], camera["position"][static_cast<std::size_t>(axis)].get<double>(), 1e-5);
            EXPECT_NEAR(view.direction[axis], camera["forward"][static_cast<std::size_t>(axis)].get<double>(), 1e-5);
        }
    }
}

TEST(SharedGltf, TheBuildingHasItsPlaneAreasAndBounds)
{
    const std::filesystem::path folder = shared_fixtures() / "hosts/freecad_building";
    if (!std::filesystem::exists(folder))
        GTEST_SKIP() << "the building is not at hand";
    const Json truth = Json::parse(std::ifstream(folder / "truth.json"));
    const Imported building = import_gltf(folder / "building.glb", {});
    validate(building.scene);
    const MeasuredModel found = measure(building);
    for (int axis = 0; axis < 3; ++axis) { // curved parts are cut into chords
        const auto i = static_cast<std::size_t>(axis);
        EXPECT_NEAR(found.bounds.low[axis], truth["bbox_m"][0][i].get<double>(), 5e-3);
        EXPECT_NEAR(found.bounds.high[axis], truth["bbox_m"][1][i].get<double>(), 5e-3);
    }
    EXPECT_NEAR(area_of(found, "Floor slab"), 90.64, 1e-3);
    EXPECT_NEAR(area_of(found, "Wall ") + area_of(found, "Partition"), 220.82, 1e-2);
}

} // namespace
} // namespace lightwell
