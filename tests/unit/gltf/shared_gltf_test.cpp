#include "engine/base/errors.h"
#include "engine/base/files.h"
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

void expect_truth(const Imported& imported, const Json& truth)
{
    const Measured found = measure(imported);
    const std::size_t dropped = noted(imported.report, "triangle without area") + skipped_for(imported, "zero area");
    const Json& scene = truth["default_scene"];
    if (dropped == 0) {
        EXPECT_EQ(found.total.triangles, scene["triangles"].get<std::size_t>());
        for (const auto& [name, count] : scene["triangles_per_material"].items()) {
            const auto share = found.materials.find(our_name(name));
            ASSERT_NE(share, found.materials.end()) << name;
            EXPECT_EQ(share->second.triangles, count.get<std::size_t>()) << name;
        }
    }
    // The truth's box holds points and lines too, and corners of triangles without area.
    const bool all_taken =
        imported.ledger.read_count() == imported.ledger.made_count() + skipped_of_type(imported, "light");
    if (!all_taken || dropped > 0 || !scene.value("bbox_exact", false) || scene["world_bbox"].is_null() ||
        found.bounds.empty())
        return;
    for (int axis = 0; axis < 3; ++axis) { // given with six digits
        const auto i = static_cast<std::size_t>(axis);
        const double low = scene["world_bbox"]["min"][i], high = scene["world_bbox"]["max"][i];
        const double tolerance = 2e-5 * std::fmax(1e-2, std::fmax(std::fabs(low), std::fabs(high)));
        EXPECT_NEAR(found.bounds.low[axis], low, tolerance);
        EXPECT_NEAR(found.bounds.high[axis], high, tolerance);
    }
}

TEST(SharedGltf, EveryFileAgreesWithCountsAndBoundsFoundByIndependentScripts)
{
    const Json entries = manifest("gltf");
    if (entries.is_null())
        GTEST_SKIP() << "the files from elsewhere are not at hand";
    std::size_t read = 0;
    for (const Json& entry : entries) {
        const std::string file = entry["file"];
        SCOPED_TRACE(file);
        const std::filesystem::path path = shared_fixtures() / "gltf" / file;
        EXPECT_TRUE(recognize_gltf(path));
        const Json& truth = entry["ground_truth"];
        const bool without_geometry =
            entry.contains("companions_absent") && file.find("vertex_count_32bit") != std::string::npos;
        if (without_geometry || truth.value("asset_version", "2.0") == "1.0") {
            EXPECT_THROW(import_gltf(path, as_written()), InputError);
            continue;
        }
        try {
            const Imported imported = import_gltf(path, as_written());
            EXPECT_NO_THROW(validate(imported.scene));
            if (truth.contains("default_scene"))
                expect_truth(imported, truth);
            ++read;
        } catch (const InputError& error) {
            ADD_FAILURE() << error.what();
        }
    }
    EXPECT_GE(read, 60u);
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
double area_of(const Measured& found, const std::string& start)
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
        const Measured found = measure(office);
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
    const Measured found = measure(building);
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
