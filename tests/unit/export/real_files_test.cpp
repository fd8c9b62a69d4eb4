#include "engine/base/errors.h"
#include "importers/export/export.h"
#include "importers/formats/formats.h"
#include "importers/layers.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <map>

namespace lightwell {
namespace {

std::map<std::string, double> areas(const Imported& imported)
{
    std::map<std::string, double> result;
    for (const LayerSummary& layer : summarize_layers(imported))
        result[layer.name] = layer.area_m2;
    return result;
}

/// @param tolerance  relative to the largest area
void expect_equal_areas(const Imported& wanted, const Imported& found, double tolerance)
{
    const std::map<std::string, double> before = areas(wanted), after = areas(found);
    double largest = 0;
    for (const auto& entry : before)
        largest = std::fmax(largest, entry.second);
    for (const auto& [layer, area] : before) {
        const auto entry = after.find(layer);
        EXPECT_NEAR(entry == after.end() ? 0 : entry->second, area, tolerance * largest) << layer;
    }
}

/// Face for face as in the file: joined triangles would be fewer entities when written again.
Imported as_written(const std::filesystem::path& file)
{
    ImportOptions options;
    options.keep_triangles = true;
    return import_file(file, options);
}

/// Exports to each format and reads back: layers keep their areas.
void check_file(const std::filesystem::path& file, bool with_meshes)
{
    SCOPED_TRACE(file.string());
    const Imported model = as_written(file);
    if (model.scene.root.surfaces.empty())
        return; // lines only
    const std::filesystem::path folder =
        std::filesystem::path(testing::TempDir()) / ("exported-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    Report report;
    struct Target {
        const char* name;
        double tolerance;
    };
    for (const auto& [name, tolerance] : {Target{"m.obj", 1e-9}, Target{"m.glb", 1e-5}, Target{"m.dxf", 1e-9}}) {
        if (std::string(name) == "m.dxf" && !with_meshes)
            continue;
        SCOPED_TRACE(name);
        // Discs and columns become facets with a sagitta of ten micrometres.
        export_file(model, folder / name, {1e-5}, report);
        const Imported again = as_written(folder / name);
        const bool round = report.has(Finding::approximated);
        expect_equal_areas(model, again, round ? 1e-4 : tolerance);
        Report second;
        const std::filesystem::path other = folder / ("second_" + std::string(name)); // a file replaced is flushed
        export_file(again, other, {1e-5}, second);
        const Imported third = as_written(other);
        expect_equal_areas(again, third, tolerance);
        // Instances that a reader of GLB tells apart may share a mesh the second time.
        if (std::string(name) != "m.glb") {
            EXPECT_EQ(third.ledger.made_count(), again.ledger.made_count());
        }
    }
    std::filesystem::remove_all(folder);
}

bool reads_meshes()
{
    Imported cage;
    KeyTable keys{cage};
    SurfaceKey key;
    key.layer = "A";
    cage.scene.root.add_polygon({{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 2, 0}, {0, 1, 0}}, keys.modifier_for(key), "p");
    const std::filesystem::path file =
        std::filesystem::path(testing::TempDir()) / ("cage-" + std::to_string(getpid()) + ".dxf");
    Report report;
    export_dxf(cage, file, {}, report);
    const bool read = import_file(file).ledger.made_count() == 1;
    std::filesystem::remove(file);
    return read;
}

TEST(ExportRealFiles, TheFixturesOfEachFormatKeepTheAreasOfTheirLayers)
{
    const bool with_meshes = reads_meshes();
    for (const char* name : {"dxf/entities.dxf", "dxf/inserts.dxf", "obj/room.obj", "obj/cylinder.obj",
                             "gltf/nodes.gltf", "gltf/materials.glb"})
        check_file(std::filesystem::path(LIGHTWELL_ROOT "/tests/fixtures") / name, with_meshes);
}

TEST(ExportRealFiles, ModelsOfHostsKeepTheAreasOfTheirLayers)
{
    const char* set = std::getenv("LIGHTWELL_SHARED");
    const std::filesystem::path folder =
        std::filesystem::path(set ? set : LIGHTWELL_ROOT "/../shared") / "fixtures/hosts";
    if (!std::filesystem::exists(folder))
        GTEST_SKIP() << "no models beside the repository";
    const bool with_meshes = reads_meshes();
    for (const char* name :
         {"blender_office/office.dxf", "blender_office/office.obj", "blender_office/office.glb",
          "freecad_building/building.dxf", "freecad_building/building.obj", "freecad_building/building.glb"})
        check_file(folder / name, with_meshes);
}

} // namespace
} // namespace lightwell
