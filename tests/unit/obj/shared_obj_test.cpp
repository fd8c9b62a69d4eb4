#include "engine/base/errors.h"
#include "tests/unit/import_measures/deviations.h"
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

/// Faces made of each name, whether they are polygons or triangles of a mesh.
std::map<std::string, std::size_t> faces_by(const Imported& imported, std::string SurfaceKey::*name)
{
    std::map<std::string, std::size_t> faces;
    for (std::size_t i = 0; i < imported.made_with_key.size(); ++i)
        if (imported.made_with_key[i] > 0)
            faces[imported.keys[i].*name] += imported.made_with_key[i];
    return faces;
}

/// The truth calls what has no name "(none)" or "(default)"; a colour of vertices stands in for no material.
std::map<std::string, std::size_t> as_truth_names(const std::map<std::string, std::size_t>& faces, const char* none)
{
    std::map<std::string, std::size_t> named;
    for (const auto& [name, count] : faces)
        named[name.empty() || name.starts_with("vertex colour #") ? none : name] += count;
    return named;
}

std::map<std::string, std::size_t> counts_in(const Json& truth)
{
    std::map<std::string, std::size_t> counts;
    for (const auto& [name, count] : truth.items())
        if (count.get<std::size_t>() > 0)
            counts[name] = count;
    return counts;
}

/// Polygons by number of corners; what went into meshes can only be counted as triangles.
bool sizes_agree(const Imported& imported, const MeasuredModel& found, const Json& truth)
{
    std::map<std::string, std::size_t> sizes;
    for (const Polygon& polygon : imported.scene.root.polygons)
        ++sizes[std::to_string(polygon.count)];
    const std::map<std::string, std::size_t> expected = counts_in(truth.value("face_sizes", Json::object()));
    if (imported.scene.root.meshes.empty())
        return sizes == expected;
    for (const auto& [size, count] : sizes)
        if (expected.count(size) == 0 || expected.at(size) < count)
            return false;
    return found.total.triangles == truth["triangles_fan"].get<std::size_t>();
}

bool areas_agree(const MeasuredModel& found, const Json& truth)
{
    for (const auto& [name, area] : truth.items()) {
        const double expected = area.get<double>(); // given with six digits
        double sum = 0;
        for (const auto& [material, share] : found.materials) {
            const bool nameless = material.empty() || material.starts_with("vertex colour #");
            sum += (nameless ? "(none)" : material) == name ? share.area_m2 : 0;
        }
        if (!(std::fabs(sum - expected) <= 1e-5 * expected))
            return false;
    }
    return true;
}

bool bounds_agree(const Box& bounds, const Json& truth)
{
    if (truth.is_null() || bounds.empty())
        return truth.is_null() == bounds.empty();
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        const double low = truth["min"][i], high = truth["max"][i];
        const double tolerance = 1e-5 * std::fmax(1e-3, std::fmax(std::fabs(low), std::fabs(high)));
        if (std::fabs(bounds.low[axis] - low) > tolerance || std::fabs(bounds.high[axis] - high) > tolerance)
            return false;
    }
    return true;
}

/// What of the truth is not found again.
std::set<std::string> differences(const Imported& imported, const Json& truth)
{
    std::set<std::string> items;
    const MeasuredModel found = measure(imported);
    const auto check = [&](bool agrees, const char* item) {
        if (!agrees)
            items.insert(item);
    };
    const std::size_t left_out = skipped_of_type(imported, "face");
    check(imported.ledger.made_count() + left_out == truth["faces"].get<std::size_t>(), "faces");
    check(left_out == 0, "faces left out");
    check(skipped_of_type(imported, "line") == truth.value("lines", std::size_t{0}), "lines");
    check(skipped_of_type(imported, "point") == truth.value("points", std::size_t{0}), "points");
    const auto groups = as_truth_names(faces_by(imported, &SurfaceKey::group), "(default)");
    if (const Json expected = truth.value("faces_per_group", Json::object()); expected.contains("(count)"))
        check(groups.size() == expected["(count)"].get<std::size_t>(), "faces by group");
    else
        check(groups == counts_in(expected), "faces by group");
    check(as_truth_names(faces_by(imported, &SurfaceKey::material), "(none)") ==
              counts_in(truth.value("faces_per_material", Json::object())),
          "faces by material");
    check(sizes_agree(imported, found, truth), "corners of faces");
    check(areas_agree(found, truth.value("area_per_material", Json::object())), "areas");
    check(bounds_agree(found.bounds, truth.value("bbox_all_v", Json())), "bounds");
    return items;
}

const char* const without_area = "faces without area are left out, each in the ledger";
const char* const other_letters = "a name with letters of Windows-1252 becomes UTF-8; the truth has its bytes replaced";
const char* const bad_indices = "faces that name a vertex that is not there are left out, each in the ledger";
const char* const no_numbers = "coordinates such as 3.1+e2 are no numbers; faces that use them are left out";
const char* const unused_vertices = "the truth's box holds vertices of lines and points, or of nothing";
const char* const nothing = "a file without vertex and face";

const std::vector<Deviation> meant_to_differ = {
    {"assimp/number_formats.obj", "bounds", no_numbers},
    {"assimp/number_formats.obj", "corners of faces", no_numbers},
    {"assimp/number_formats.obj", "faces by group", no_numbers},
    {"assimp/number_formats.obj", "faces by material", no_numbers},
    {"assimp/number_formats.obj", "faces left out", no_numbers},
    {"assimp/regr01.obj", "areas", other_letters},
    {"assimp/regr01.obj", "corners of faces", without_area},
    {"assimp/regr01.obj", "faces by group", without_area},
    {"assimp/regr01.obj", "faces by material", without_area},
    {"assimp/regr01.obj", "faces left out", without_area},
    {"assimp/spider.obj", "corners of faces", without_area},
    {"assimp/spider.obj", "faces by group", without_area},
    {"assimp/spider.obj", "faces by material", without_area},
    {"assimp/spider.obj", "faces left out", without_area},
    {"assimp/malformed.obj", "areas", bad_indices},
    {"assimp/malformed.obj", "corners of faces", bad_indices},
    {"assimp/malformed.obj", "faces by group", bad_indices},
    {"assimp/malformed.obj", "faces by material", bad_indices},
    {"assimp/malformed.obj", "faces left out", bad_indices},
    {"assimp/empty.obj", "refused", nothing},
    {"tinyobjloader/invalid-relative-texture-index.obj", "corners of faces", bad_indices},
    {"tinyobjloader/invalid-relative-texture-index.obj", "faces by group", bad_indices},
    {"tinyobjloader/invalid-relative-texture-index.obj", "faces by material", bad_indices},
    {"tinyobjloader/invalid-relative-texture-index.obj", "faces left out", bad_indices},
    {"tinyobjloader/issue-356-leading-spaces-newmtl.obj", "refused", nothing},
    {"tinyobjloader/issue-246-usemtl-whitespace.obj", "bounds", unused_vertices},
    {"tinyobjloader/line-prim.obj", "bounds", unused_vertices},
    {"tinyobjloader/points-prim.obj", "bounds", unused_vertices},
    {"online3dviewer/lines.obj", "bounds", unused_vertices},
    {"online3dviewer/lines_in_meshes.obj", "bounds", unused_vertices},
    {"online3dviewer/lines_triangles_colors.obj", "bounds", unused_vertices},
    {"magnum/points.obj", "bounds", unused_vertices},
};

TEST(SharedObj, EveryFileAgreesWithCountsSizesBoundsAndAreasFoundByIndependentScripts)
{
    const Json entries = manifest();
    if (entries.is_null())
        GTEST_SKIP() << "the files from elsewhere are not at hand";
    Deviations deviations(meant_to_differ);
    for (const Json& entry : entries) {
        const std::string file = entry["file"];
        SCOPED_TRACE(file);
        if (file.ends_with(".zip"))
            continue;
        const std::filesystem::path path = shared_fixtures() / "obj" / file;
        EXPECT_EQ(recognize_obj(path), entry["ground_truth"]["v"] > 0);
        try {
            const Imported imported = import_obj(path, as_written());
            EXPECT_NO_THROW(validate(imported.scene));
            deviations.file(file, differences(imported, entry["ground_truth"]));
        } catch (const InputError& error) {
            deviations.file(file, {"refused"});
        }
    }
    EXPECT_EQ(deviations.finish(std::cout), std::vector<std::string>{});
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
        if (entry["file"].get<std::string>().ends_with(".zip")) {
            // Triangles without area are left out, each in the ledger; areas and bounds agree.
            const std::set<std::string> left_out{"corners of faces", "faces by group", "faces by material",
                                                 "faces left out"};
            EXPECT_EQ(differences(imported, entry["ground_truth"]["staircase.obj"]), left_out);
            EXPECT_EQ(skipped_for(imported, "zero area"), skipped_of_type(imported, "face"));
        }
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
        const MeasuredModel found = measure(office);
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
