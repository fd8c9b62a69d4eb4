#include "engine/base/errors.h"
#include "importers/dxf/block_plan.h"
#include "tests/unit/dxf/balance.h"
#include "tests/unit/dxf/dxf_text.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <set>

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

/// Where the collection's counts and ours differ, and why.
const std::string escapes = "the collection leaves escapes (\\U+039B) as they are; we give the character";
const std::string arrow_blocks = "the reference library adds arrow blocks of its own";
const std::string inserts_left_out = "the collection's bounds leave out what inserts show";
const std::map<std::pair<std::string, std::string>, std::string> known_deviations{
    {{"ezdxf/ASCII_R12.dxf", "entities on layers"}, escapes},
    {{"ezdxf/ASCII_R12.dxf", "layer table"}, escapes},
    {{"ezdxf/dxf_unicode.dxf", "layer table"}, escapes},
    {{"ezdxf/small_r13.dxf", "entities of blocks"}, arrow_blocks},
    {{"ezdxf/duplicate_handles.dxf", "entities of blocks"}, arrow_blocks},
    {{"ezdxf/custom_blocks.dxf", "bounds"}, inserts_left_out},
    {{"libredwg/example_2000.dxf", "bounds"}, inserts_left_out},
    {{"libredwg/2004_Surface.dxf", "bounds"}, "the collection's bounds leave out ellipses"},
    {{"libredwg/r2.6_entities.dxf", "bounds"}, "the reference library does not know 3DLINE, the old name of LINE"},
    {{"libredwg/r10_entities.dxf", "bounds"}, "the reference library does not know 3DLINE, the old name of LINE"},
    {{"dxf-parser/api-cw750-details.dxf", "bounds"}, "most layers are off; the collection's bounds show them"},
    {{"ezdxf/POLI-ALL210_12.DXF", "bounds"},
     "bands of unequal width that meet at a sharp angle stay square; the reference library lets their borders meet"},
};

/// What one file holds, counted from the reader's and the importer's results, beside the collection's counts.
class FileCheck {
public:
    FileCheck(const json& entry, const std::filesystem::path& file)
        : name_(entry["file"].get<std::string>()), tags_(entry["ground_truth"]["own_tag_reader"]),
          reference_(entry["ground_truth"]["ezdxf"]), file_(file), drawing_(dxf::read_drawing(file, report_))
    {
    }
    /// @return whether all agrees
    bool run()
    {
        check_entities();
        check_layer_table();
        check_units();
        check_blocks();
        check_ledger();
        check_bounds();
        return agrees_;
    }

private:
    template <class T>
    void compare(const char* what, const T& found, const T& expected)
    {
        if (found == expected)
            return;
        agrees_ = false;
        const auto reason = known_deviations.find({name_, what});
        if (reason == known_deviations.end())
            ADD_FAILURE() << name_ << ": " << what << "\n  found    " << json(found) << "\n  expected "
                          << json(expected);
        else
            std::cout << name_ << ": " << what << " differs: " << reason->second << "\n";
    }
    template <class Use>
    void for_each_model_entity(Use use) const
    {
        for (const dxf::EntityRange& range : drawing_.model)
            for (std::size_t i = range.first; i < range.first + range.count; ++i)
                use(drawing_.entities[i]);
    }
    void check_entities();
    void check_layer_table();
    void check_units();
    void check_blocks();
    void check_ledger();
    void check_bounds();
    void count_expanded(const dxf::EntityRange& range, std::size_t copies, Counts& counts) const;

    std::string name_;
    const json& tags_;
    const json& reference_;
    std::filesystem::path file_;
    Report report_;
    dxf::Drawing drawing_;
    bool agrees_ = true;
};

void FileCheck::check_entities()
{
    Counts types, layers;
    std::size_t in_paper_space = 0;
    for_each_model_entity([&](const dxf::Entity& entity) {
        ++types[drawing_.types[entity.type]];
        ++layers[drawing_.layers[entity.layer].name];
        in_paper_space += entity.in_paper_space;
    });
    compare("entity types", types, tags_["entities_section"].get<Counts>());
    compare("entities on layers", layers, tags_["entities_per_layer"].get<Counts>());
    compare("entities in paper space", in_paper_space, tags_.value("entities_in_paper_space", std::size_t{0}));
}

void FileCheck::check_layer_table()
{
    constexpr int frozen = 1;
    std::set<std::string> found, expected;
    for (const dxf::Layer& layer : drawing_.layers)
        if (layer.is_defined)
            found.insert(layer.name + (layer.is_off ? " off " : " ") + std::to_string(layer.colour) +
                         (layer.is_frozen ? " frozen" : ""));
    for (const json& layer : tags_["layer_table_in_file"]) {
        const int colour = layer["color"].get<int>();
        expected.insert(layer["name"].get<std::string>() + (colour < 0 ? " off " : " ") +
                        std::to_string(std::abs(colour)) + (layer["flags"].get<int>() & frozen ? " frozen" : ""));
    }
    compare("layer table", found, expected);
}

void FileCheck::check_units()
{
    const auto number = [&](const char* variable) {
        const json& value = tags_.value(variable, json{});
        return value.is_null() ? -1 : value.is_string() ? std::stoi(value.get<std::string>()) : value.get<int>();
    };
    compare("$INSUNITS", drawing_.insunits.value_or(-1), number("$INSUNITS"));
    compare("$MEASUREMENT", drawing_.measurement.value_or(-1), number("$MEASUREMENT"));
}

void FileCheck::count_expanded(const dxf::EntityRange& range, std::size_t copies, Counts& counts) const
{
    for (std::size_t i = range.first; i < range.first + range.count; ++i) {
        const dxf::Entity& entity = drawing_.entities[i];
        dxf::BlockUse use;
        if (entity.in_paper_space)
            continue;
        if (entity.kind != dxf::Kind::insert) {
            counts[drawing_.types[entity.type]] += copies;
        } else if (!find_inserted(drawing_, entity, nullptr, use)) {
            const dxf::InsertFrame frame = insert_frame(drawing_, entity);
            count_expanded(drawing_.blocks[use.block].entities, copies * frame.columns * frame.rows, counts);
        }
    }
}

void FileCheck::check_blocks()
{
    if (reference_.contains("types_after_expanding_inserts")) {
        Counts expanded;
        for (const dxf::EntityRange& range : drawing_.model)
            count_expanded(range, 1, expanded);
        compare("types with inserts expanded", expanded, reference_["types_after_expanding_inserts"].get<Counts>());
    }
    if (!reference_.contains("block_entities"))
        return;
    Counts blocks;
    const Counts expected = reference_["block_entities"].get<Counts>();
    for (std::size_t i = 0; i < drawing_.block_names.size(); ++i)
        if (drawing_.block_of_name[i] != dxf::no_index && expected.count(drawing_.block_names[i]))
            blocks[drawing_.block_names[i]] = drawing_.blocks[drawing_.block_of_name[i]].entities.count;
    compare("entities of blocks", blocks, expected);
}

void FileCheck::check_ledger()
{
    EXPECT_TRUE(recognize_dxf(file_));
    const Imported imported = import_dxf(file_, {});
    EXPECT_NO_THROW(validate(imported.scene));
    expect_balanced(imported, file_);
    EXPECT_GE(imported.ledger.read_count(), tags_["entities_total"].get<std::size_t>());
    std::cout << name_ << ": " << imported.unit << ", read " << imported.ledger.read_count() << ", made "
              << imported.ledger.made_count() << ", surfaces " << expanded_count(imported.scene) << "\n";
}

/// Lines become surfaces when all layers are raised: then their bounds must be those of the collection, seen from
/// above.
void FileCheck::check_bounds()
{
    if (!reference_.contains("bbox_lines_faces"))
        return;
    ImportOptions options;
    options.metres_per_unit = 1;
    options.raised = {{"*", 1}};
    const Box box = exact_bounds(import_dxf(file_, options));
    const json &low = reference_["bbox_lines_faces"]["min"], &high = reference_["bbox_lines_faces"]["max"];
    const double size =
        std::hypot(high[0].get<double>() - low[0].get<double>(), high[1].get<double>() - low[1].get<double>());
    const double within = 1e-5 * (size + std::fabs(low[0].get<double>()) + std::fabs(low[1].get<double>())) + 0.0005;
    const auto near = [&](double found, const json& expected) {
        return std::fabs(found - expected.get<double>()) < within;
    };
    const std::vector<double> found{box.low.x, box.low.y, box.high.x, box.high.y};
    const std::vector<double> expected{low[0].get<double>(), low[1].get<double>(), high[0].get<double>(),
                                       high[1].get<double>()};
    const bool same =
        near(found[0], low[0]) && near(found[1], low[1]) && near(found[2], high[0]) && near(found[3], high[1]);
    compare("bounds", same ? expected : found, expected);
}

TEST(DxfCorpus, EveryFileHasWhatIndependentScriptsCountedOrAKnownReason)
{
    const json all = manifest();
    if (all.empty())
        GTEST_SKIP() << "the collection of files from other programs is not here";
    std::size_t agree = 0, differ = 0, refused = 0;
    for (const json& entry : all["entries"]) {
        const std::filesystem::path file = shared_folder() / "fixtures/dxf" / entry["file"].get<std::string>();
        SCOPED_TRACE(file);
        try {
            ++(FileCheck{entry, file}.run() ? agree : differ);
        } catch (const InputError& error) {
            ++refused;
            ADD_FAILURE() << error.what();
        }
    }
    std::cout << "files " << all["entries"].size() << ", agree " << agree << ", differ " << differ << ", refused "
              << refused << "\n";
    EXPECT_EQ(agree + differ, all["entries"].size());
}

TEST(DxfCorpus, ADrawingOfBlenderHasTheAreaThatTheReferenceLibraryFinds)
{
    const std::filesystem::path file = shared_folder() / "fixtures/hosts/blender_office/office.dxf";
    if (!std::filesystem::exists(file))
        GTEST_SKIP() << "the collection of files from other programs is not here";
    const Imported imported = import_dxf(file, {}); // no unit in the file: metres, from its size
    EXPECT_NEAR(layer_areas(imported).at("0").area_m2, 134.70965105247572, 1e-7); // 3DFACEs summed by ezdxf
    EXPECT_EQ(imported.ledger.made_count(), 1154u);
    expect_balanced(imported, file);
}

TEST(DxfCorpus, ADrawingOfFreecadHasTheLinesThatTheReferenceLibraryFinds)
{
    const std::filesystem::path file = shared_folder() / "fixtures/hosts/freecad_building/building.dxf";
    if (!std::filesystem::exists(file))
        GTEST_SKIP() << "the collection of files from other programs is not here";
    const Imported imported = import_dxf(file, {});
    EXPECT_EQ(imported.unit, "mm (from $INSUNITS)");
    EXPECT_EQ(imported.ledger.made_count(), 0u); // edges only
    EXPECT_EQ(imported.ledger.read_count(), 1002u);
    expect_balanced(imported, file);
}

} // namespace
} // namespace lightwell::test
