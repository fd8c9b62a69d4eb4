#include "engine/base/errors.h"
#include "importers/dxf/block_plan.h"
#include "tests/unit/dxf/dxf_text.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace lightwell::test {
namespace {

using nlohmann::json;
using Counts = std::map<std::string, std::size_t>;

std::filesystem::path shared_folder()
{
    const char* const named = std::getenv("LIGHTWELL_SHARED");
    return named ? named : LIGHTWELL_ROOT "/../shared";
}

json manifest()
{
    std::ifstream in{shared_folder() / "fixtures/dxf/MANIFEST.json"};
    return in ? json::parse(in) : json{};
}

void count_expanded(const dxf::Drawing& drawing, const dxf::EntityRange& range, std::size_t copies, Counts& counts)
{
    for (std::size_t i = range.first; i < range.first + range.count; ++i) {
        const dxf::Entity& entity = drawing.entities[i];
        if (entity.in_paper_space)
            continue;
        dxf::BlockUse use;
        if (entity.kind != dxf::Kind::insert) {
            counts[drawing.types[entity.type]] += copies;
        } else if (!find_inserted(drawing, entity, nullptr, use)) {
            const dxf::InsertFrame frame = insert_frame(drawing, entity);
            count_expanded(drawing, drawing.blocks[use.block].entities, copies * frame.columns * frame.rows, counts);
        }
    }
}

TEST(DxfCorpus, EveryFileHasTheEntitiesThatIndependentScriptsCounted)
{
    const json all = manifest();
    if (all.empty())
        GTEST_SKIP() << "the collection of files from other programs is not here";
    for (const json& entry : all["entries"]) {
        const std::string name = entry["file"].get<std::string>();
        SCOPED_TRACE(name);
        Report report;
        try {
            const dxf::Drawing drawing = dxf::read_drawing(shared_folder() / "fixtures/dxf" / name, report);
            Counts counts, expanded;
            for (const dxf::EntityRange& range : drawing.model) {
                for (std::size_t i = range.first; i < range.first + range.count; ++i)
                    ++counts[drawing.types[drawing.entities[i].type]];
                count_expanded(drawing, range, 1, expanded);
            }
            EXPECT_EQ(counts, entry["ground_truth"]["own_tag_reader"]["entities_section"].get<Counts>());
            const json& reference = entry["ground_truth"]["ezdxf"];
            if (reference.contains("types_after_expanding_inserts")) {
                EXPECT_EQ(expanded, reference["types_after_expanding_inserts"].get<Counts>());
            }
        } catch (const InputError& error) {
            ADD_FAILURE() << error.what();
        }
    }
}

TEST(DxfCorpus, EveryFileImportsIntoAValidSceneWithABalancedLedger)
{
    const json all = manifest();
    if (all.empty())
        GTEST_SKIP() << "the collection of files from other programs is not here";
    for (const json& entry : all["entries"]) {
        const std::filesystem::path file = shared_folder() / "fixtures/dxf" / entry["file"].get<std::string>();
        SCOPED_TRACE(file);
        try {
            EXPECT_TRUE(recognize_dxf(file));
            const Imported imported = import_dxf(file, {});
            EXPECT_NO_THROW(validate(imported.scene));
            std::size_t skipped = 0;
            for (const Ledger::Skipped& line : imported.ledger.skipped_list())
                skipped += line.count;
            EXPECT_EQ(imported.ledger.read_count(), imported.ledger.made_count() + skipped);
            std::cout << file.filename().string() << ": " << imported.unit << ", read " << imported.ledger.read_count()
                      << ", made " << imported.ledger.made_count() << ", surfaces " << expanded_count(imported.scene)
                      << "\n";
        } catch (const InputError& error) {
            ADD_FAILURE() << error.what();
        }
    }
}

TEST(DxfCorpus, ADrawingOfBlenderHasTheAreaThatTheReferenceLibraryFinds)
{
    const std::filesystem::path file = shared_folder() / "fixtures/hosts/blender_office/office.dxf";
    if (!std::filesystem::exists(file))
        GTEST_SKIP() << "the collection of files from other programs is not here";
    const Imported imported = import_dxf(file, {}); // no unit in the file: metres, from its size
    EXPECT_NEAR(layer_areas(imported).at("0").area_m2, 134.70965105247572, 1e-7); // 3DFACEs summed by ezdxf
    EXPECT_EQ(imported.ledger.made_count(), 1154u);
}

TEST(DxfCorpus, DrawingsOfBlenderAndFreecadImport)
{
    const std::filesystem::path folder = shared_folder() / "fixtures/hosts";
    if (!std::filesystem::exists(folder))
        GTEST_SKIP() << "the collection of files from other programs is not here";
    for (const auto& item : std::filesystem::recursive_directory_iterator{folder}) {
        if (item.path().extension() != ".dxf")
            continue;
        SCOPED_TRACE(item.path());
        const Imported imported = import_dxf(item.path(), {});
        EXPECT_NO_THROW(validate(imported.scene));
        EXPECT_GT(imported.ledger.read_count(), 1000u);
    }
}

} // namespace
} // namespace lightwell::test
