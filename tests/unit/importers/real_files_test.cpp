#include "engine/base/errors.h"
#include "importers/layer_report.h"
#include "importers/layers.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>

namespace lightwell {
namespace {

std::filesystem::path shared_files()
{
    const char* set = std::getenv("LIGHTWELL_SHARED");
    return std::filesystem::path(set ? set : LIGHTWELL_ROOT "/../shared") / "fixtures";
}

std::map<std::string, double> areas(const Imported& imported)
{
    std::map<std::string, double> result;
    for (const LayerSummary& layer : summarize_layers(imported))
        result[layer.name] = layer.area_m2;
    return result;
}

/// Proposes a map for a file, reads it back and applies it: layers keep their names and areas, all have a material.
void check_round_trip(Imported imported)
{
    const std::map<std::string, double> before = areas(imported);
    const std::size_t read = imported.ledger.read_count();
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) /
                                       ("proposed_map-" + std::to_string(getpid()) + ".toml"); // tests run side by side
    std::ofstream(file) << propose_layer_map(imported);
    apply_layer_map(imported, read_layer_map(file));
    std::filesystem::remove(file);
    validate(imported.scene);
    EXPECT_FALSE(imported.report.has(Finding::unmapped));
    EXPECT_EQ(imported.ledger.read_count(), read);
    const std::map<std::string, double> after = areas(imported);
    ASSERT_EQ(after.size(), before.size());
    for (const auto& [layer, area] : before)
        EXPECT_NEAR(after.at(layer), area, 1e-9 * (1 + area)) << layer;
    visit_expanded(imported.scene, [&](const Part&, const Surface& surface, const Affine&, ModifierId modifier) {
        EXPECT_TRUE(resolve(imported.scene, modifier).material) << surface.name;
    });
}

/// @return number of files that were imported and checked
std::size_t check_folder(const char* folder, const char* extension,
                         Imported (*import)(const std::filesystem::path&, const ImportOptions&))
{
    // A larger file adds time, not cases.
    constexpr std::uintmax_t most_bytes = 3 << 20;
    std::size_t checked = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(shared_files() / folder)) {
        if (entry.path().extension() != extension || entry.file_size() > most_bytes)
            continue;
        SCOPED_TRACE(entry.path().string());
        try {
            Imported imported = import(entry.path(), {});
            if (expanded_count(imported.scene) < 200000) {
                check_round_trip(std::move(imported));
                ++checked;
            }
        } catch (const InputError&) {
            // Refused by its importer, whose tests decide whether rightly.
        }
    }
    return checked;
}

TEST(RealFiles, DroppingEveryLayerLeavesNothingMade)
{
    if (!std::filesystem::exists(shared_files() / "obj"))
        GTEST_SKIP() << "no models beside the repository";
    const auto dropped = [](Imported imported) {
        const std::size_t read = imported.ledger.read_count();
        LayerMap everything;
        everything.default_material = "void";
        apply_layer_map(imported, everything);
        EXPECT_EQ(expanded_count(imported.scene), 0u);
        EXPECT_EQ(imported.ledger.read_count(), read);
        return imported.ledger.made_count();
    };
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(shared_files() / "obj")) {
        if (entry.path().extension() != ".obj" || entry.file_size() > (3u << 20))
            continue;
        SCOPED_TRACE(entry.path().string());
        try {
            EXPECT_EQ(dropped(import_obj(entry.path(), {})), 0u);
            ++files;
        } catch (const InputError&) {
            // Refused by its importer, whose tests decide whether rightly.
        }
    }
    EXPECT_GE(files, 5u);
}

TEST(RealFiles, ProposedMapsReadBackAndApplyToDrawings)
{
    if (!std::filesystem::exists(shared_files() / "dxf"))
        GTEST_SKIP() << "no drawings beside the repository";
    EXPECT_GE(check_folder("dxf", ".dxf", import_dxf), 20u);
}

TEST(RealFiles, ProposedMapsReadBackAndApplyToObjAndGltfFiles)
{
    if (!std::filesystem::exists(shared_files() / "obj"))
        GTEST_SKIP() << "no models beside the repository";
    EXPECT_GE(check_folder("obj", ".obj", import_obj), 5u);
    EXPECT_GE(check_folder("gltf", ".glb", import_gltf) + check_folder("gltf", ".gltf", import_gltf), 5u);
}

} // namespace
} // namespace lightwell
