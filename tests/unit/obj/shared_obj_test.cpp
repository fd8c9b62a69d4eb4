#include "engine/base/errors.h"
#include "tests/unit/import_measures/measure.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <fstream>
#include <iostream>

namespace lightwell {
namespace {

using Json = nlohmann::json;

Json manifest()
{
    std::ifstream in(shared_fixtures() / "obj" / "MANIFEST.json");
    return in ? Json::parse(in)["entries"] : Json();
}

/// File coordinates as they are, so that the truth's numbers compare.
ImportOptions as_written()
{
    return ImportOptions{.metres_per_unit = 1, .up = "z"};
}

/// Faces of the file in this share: polygons, and triangles of meshes where the file has nothing but triangles.
void expect_faces(const std::map<std::string, Share>& found, const Json& expected, const std::string& none,
                  bool only_triangles)
{
    for (const auto& [name, faces] : expected.items()) {
        const auto share = found.find(name == none ? std::string() : name);
        ASSERT_NE(share, found.end()) << name;
        EXPECT_EQ(only_triangles ? share->second.triangles : share->second.surfaces, faces.get<std::size_t>()) << name;
    }
}

void expect_truth(const Imported& imported, const Json& truth)
{
    const Measured found = measure(imported);
    const bool only_triangles = truth["face_sizes"].size() == 1 && truth["face_sizes"].contains("3");
    EXPECT_EQ(imported.ledger.made_count() + skipped_of_type(imported, "face"), truth["faces"].get<std::size_t>());
    if (skipped_of_type(imported, "face") > 0 || truth["faces"] == 0)
        return;
    if (only_triangles || imported.scene.root.meshes.empty()) {
        EXPECT_EQ(found.total.triangles, truth["triangles_fan"].get<std::size_t>());
        expect_faces(found.materials, truth["faces_per_material"], "(none)", only_triangles);
        if (!truth["faces_per_group"].contains("(count)"))
            expect_faces(found.groups, truth["faces_per_group"], "(default)", only_triangles);
        else
            EXPECT_EQ(found.groups.size(), truth["faces_per_group"]["(count)"].get<std::size_t>());
    }
    for (const auto& [name, area] : truth["area_per_material"].items()) {
        const double expected = area.get<double>(); // given with six digits
        EXPECT_NEAR(found.materials.at(name == "(none)" ? std::string() : name).area_m2, expected, 1e-5 * expected)
            << name;
    }
}

TEST(SharedObj, EveryFileAgreesWithCountsAndAreasFoundByIndependentScripts)
{
    const Json entries = manifest();
    if (entries.is_null())
        GTEST_SKIP() << "the files from elsewhere are not at hand";
    std::size_t read = 0;
    for (const Json& entry : entries) {
        const std::string file = entry["file"];
        SCOPED_TRACE(file);
        if (file.ends_with(".zip"))
            continue;
        const Json& truth = entry["ground_truth"];
        if (truth["faces"] == 0 && truth["v"] == 0) {
            EXPECT_THROW(import_obj(shared_fixtures() / "obj" / file, as_written()), InputError);
            continue;
        }
        EXPECT_EQ(recognize_obj(shared_fixtures() / "obj" / file), truth["v"] > 0);
        const Imported imported = import_obj(shared_fixtures() / "obj" / file, as_written());
        EXPECT_NO_THROW(validate(imported.scene));
        expect_truth(imported, truth);
        EXPECT_EQ(skipped_of_type(imported, "line"), truth.value("lines", std::size_t{0}));
        EXPECT_EQ(skipped_of_type(imported, "point"), truth.value("points", std::size_t{0}));
        ++read;
    }
    EXPECT_GE(read, 60u);
}

TEST(SharedObj, TheHallWithAStaircaseKeepsItsGroupsMaterialsAndAreas)
{
    const std::filesystem::path archive = shared_fixtures() / "obj/interiors/staircase/staircase.zip";
    if (!std::filesystem::exists(archive))
        GTEST_SKIP() << "the hall with a staircase is not at hand";
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "lightwell_staircase";
    std::string unpack = "/usr/bin/python3 -m zipfile -e";
    for (const std::filesystem::path& path : {archive, folder})
        unpack.append(" ").append(path.string());
    if (std::system(unpack.c_str()) != 0)
        GTEST_SKIP() << "python3 cannot unpack the archive";
    const auto start = std::chrono::steady_clock::now();
    const Imported imported = import_obj(folder / "staircase.obj", as_written());
    std::cout << "read in " << std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()
              << " s\n";
    std::filesystem::remove_all(folder);
    for (const Json& entry : manifest())
        if (entry["file"].get<std::string>().ends_with(".zip"))
            expect_truth(imported, entry["ground_truth"]["staircase.obj"]);
    EXPECT_EQ(imported.file_materials.size(), 24u);
    validate(imported.scene);
}

/// The office, without what the exporter leaves out or adds (see the table beside the files).
TEST(SharedObj, TheOfficeKeepsEveryRoomSurfaceWithItsArea)
{
    const std::filesystem::path folder = shared_fixtures() / "hosts/blender_office";
    if (!std::filesystem::exists(folder))
        GTEST_SKIP() << "the office is not at hand";
    for (const char* name : {"office.obj", "office_legacy.obj"}) {
        SCOPED_TRACE(name);
        const Imported office = import_obj(folder / name, as_written());
        validate(office.scene);
        const Measured found = measure(office);
        const auto layer_area = [&](const std::string& start) {
            double area = 0;
            for (const auto& [layer, share] : found.layers)
                if (layer.rfind(start, 0) == 0)
                    area += share.area_m2;
            return area;
        };
        EXPECT_NEAR(layer_area("Floor"), 24, 1e-4);
        EXPECT_NEAR(layer_area("Ceiling"), 24, 1e-4);
        EXPECT_NEAR(layer_area("Wall_") + layer_area("Door_leaf"), 53.55, 1e-4);
        EXPECT_NEAR(layer_area("Window_pane"), 5.25, 1e-4);
        EXPECT_NEAR(layer_area("LED_panel"), 0.72, 1e-4);
    }
}

TEST(SharedObj, TheBuildingInMillimetresComesInMetresWithItsBounds)
{
    const std::filesystem::path folder = shared_fixtures() / "hosts/freecad_building";
    if (!std::filesystem::exists(folder))
        GTEST_SKIP() << "the building is not at hand";
    const Json truth = Json::parse(std::ifstream(folder / "truth.json"));
    const Imported building = import_obj(folder / "building.obj", {});
    validate(building.scene);
    EXPECT_EQ(building.unit, "mm (as FreeCAD writes)");
    const Box bounds = measure(building).bounds;
    for (int axis = 0; axis < 3; ++axis) { // curved parts are cut into chords, 5 mm at most
        EXPECT_NEAR(bounds.low[axis], truth["bbox_m"][0][static_cast<std::size_t>(axis)].get<double>(), 5e-3);
        EXPECT_NEAR(bounds.high[axis], truth["bbox_m"][1][static_cast<std::size_t>(axis)].get<double>(), 5e-3);
    }
}

} // namespace
} // namespace lightwell
