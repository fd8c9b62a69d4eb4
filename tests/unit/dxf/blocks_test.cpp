#include "importers/dxf/colours.h"
#include "importers/layers.h"
#include "tests/unit/dxf/dxf_text.h"

#include <gtest/gtest.h>

#include <set>

namespace lightwell::test {
namespace {

using dxf::palette_colour;

/// A unit triangle with layer, colour and handle.
std::string triangle(const std::string& layer, const std::string& colour, const std::string& handle)
{
    return " 0 3DFACE 5 " + handle + " 8 " + layer + (colour.empty() ? "" : " 62 " + colour) +
           " 10 0 20 0 30 0 11 1 21 0 31 0 12 0 22 1 32 0 13 0 23 1 33 0 ";
}

const std::string layers =
    "0 LAYER 2 RED 70 0 62 1 0 LAYER 2 GREEN 70 0 62 3 0 LAYER 2 BLUE 70 0 62 5 0 LAYER 2 0 70 0 62 8 ";

/// "layer colour" of each surface, by surface name.
std::multimap<std::string, std::pair<std::string, Spectrum>> looks(const Imported& imported)
{
    std::multimap<std::string, std::pair<std::string, Spectrum>> found;
    visit_expanded(imported.scene, [&](const Part&, const Surface& surface, const Affine&, ModifierId id) {
        const SurfaceKey& key = imported.keys.at(static_cast<std::size_t>(id));
        found.emplace(surface.name, std::pair{key.layer, key.colour.value_or(Spectrum{-1, -1, -1})});
    });
    return found;
}

void expect_look(const Imported& imported, const std::string& name, const std::string& layer, int colour)
{
    SCOPED_TRACE(name);
    const auto found = looks(imported);
    ASSERT_EQ(found.count(name), 1u);
    EXPECT_EQ(found.find(name)->second.first, layer);
    EXPECT_EQ(found.find(name)->second.second, palette_colour(colour));
}

TEST(DxfBlocks, SurfacesOnLayerZeroAndByBlockTakeLayerAndColourFromTheInsert)
{
    const std::string block = "0 BLOCK 2 B 10 0 20 0 30 0 " + triangle("0", "", "A") + triangle("0", "0", "B") +
                              triangle("0", "2", "C") + triangle("GREEN", "0", "D") + triangle("GREEN", "", "E") +
                              triangle("GREEN", "6", "F") + " 0 ENDBLK";
    const Imported imported = imported_text(drawing(block, "0 INSERT 2 B 8 RED 62 4", layers));
    expect_look(imported, "A", "RED", 1);   // the layer's colour, not the insert's own
    expect_look(imported, "B", "RED", 4);   // BYBLOCK: the insert's own
    expect_look(imported, "C", "RED", 2);   // its own
    expect_look(imported, "D", "GREEN", 4); // layer its own, colour of the insert
    expect_look(imported, "E", "GREEN", 3);
    expect_look(imported, "F", "GREEN", 6);
}

TEST(DxfBlocks, InheritanceReachesThroughNestedInserts)
{
    const std::string inner = "0 BLOCK 2 IN 10 0 20 0 30 0 " + triangle("0", "", "A") + triangle("0", "0", "B") +
                              triangle("GREEN", "0", "C") + " 0 ENDBLK ";
    const auto with_inner_insert = [&](const std::string& attributes) {
        const std::string outer = "0 BLOCK 2 OUT 10 0 20 0 30 0 0 INSERT 2 IN " + attributes + " 0 ENDBLK ";
        return imported_text(drawing(inner + outer, "0 INSERT 2 OUT 8 RED 62 4", layers));
    };
    const Imported both = with_inner_insert("8 0 62 0");
    expect_look(both, "A", "RED", 1);
    expect_look(both, "B", "RED", 4);
    expect_look(both, "C", "GREEN", 4);
    const Imported by_layer = with_inner_insert("8 0");
    expect_look(by_layer, "B", "RED", 1);
    expect_look(by_layer, "C", "GREEN", 1);
    const Imported own = with_inner_insert("8 BLUE");
    expect_look(own, "A", "BLUE", 5);
    expect_look(own, "B", "BLUE", 5);
    const Imported own_colour = with_inner_insert("8 BLUE 62 2");
    expect_look(own_colour, "A", "BLUE", 5);
    expect_look(own_colour, "B", "BLUE", 2);
}

TEST(DxfBlocks, TrueColourGoesBeforeThePalette)
{
    const Imported imported =
        imported_text(drawing("", triangle("RED", "3", "A") + " 420 8388736 ", layers)); // 0x800080
    const double half = srgb_to_linear(128 / 255.0);
    EXPECT_EQ(looks(imported).find("A")->second.second, (Spectrum{half, 0, half}));
}

TEST(DxfBlocks, AreStoredOnceHoweverOftenTheyAreInserted)
{
    const std::string block = "0 BLOCK 2 B 10 0 20 0 30 0 " + triangle("0", "", "A") + " 0 ENDBLK";
    const Imported imported = imported_text(
        drawing(block, "0 INSERT 2 B 8 RED 70 100 71 50 44 2 45 3 0 INSERT 2 B 8 GREEN 10 -5 20 0", layers));
    EXPECT_EQ(imported.scene.prototypes.size(), 1u);
    EXPECT_EQ(imported.scene.prototypes[0].points.size(), 3u);
    const auto areas = layer_areas(imported);
    EXPECT_EQ(areas.at("RED").surfaces, 5000u);
    EXPECT_NEAR(areas.at("RED").area_m2, 2500, 1e-9);
    EXPECT_EQ(areas.at("GREEN").surfaces, 1u);
    EXPECT_EQ(imported.ledger.read_count(), 3u); // two inserts, one face in the block
    const Box box = exact_bounds(imported);
    EXPECT_LT(length(box.high - Point{99 * 2 + 1, 49 * 3 + 1, 0}), 1e-9);
}

TEST(DxfBlocks, OfOtherFilesAndUndefinedOnesAreReported)
{
    const std::string block = "0 BLOCK 2 X 70 4 1 other.dwg 10 0 20 0 30 0 0 ENDBLK";
    const Imported imported = imported_text(drawing(block, "0 INSERT 2 X 8 RED 0 INSERT 2 NONE 8 RED 0 INSERT 8 RED"));
    EXPECT_EQ(imported.ledger.made_count(), 0u);
    EXPECT_EQ(imported.ledger.read_count(), 3u);
    std::set<std::string> reasons;
    for (const auto& line : imported.ledger.skipped_list())
        reasons.insert(line.reason);
    EXPECT_EQ(reasons, (std::set<std::string>{"its block is drawn in another file; bind the reference",
                                              "its block is not defined"}));
    EXPECT_TRUE(imported.report.has(Finding::unsupported));
}

TEST(DxfBlocks, KeepTheirLayersThroughTheLayerMap)
{
    const std::string blocks = "0 BLOCK 2 IN 10 0 20 0 30 0 " + triangle("0", "", "A") + triangle("GREEN", "0", "B") +
                               " 0 ENDBLK 0 BLOCK 2 OUT 10 0 20 0 30 0 0 INSERT 2 IN 8 0 62 0 0 INSERT 2 IN 8 BLUE " +
                               " 0 ENDBLK ";
    Imported imported = imported_text(drawing(blocks, "0 INSERT 2 OUT 8 RED 0 INSERT 2 OUT 8 GREEN", layers));
    std::map<std::string, std::size_t> surfaces;
    for (const LayerSummary& layer : summarize_layers(imported))
        surfaces[layer.name] = layer.surfaces;
    EXPECT_EQ(surfaces, (std::map<std::string, std::size_t>{{"RED", 1}, {"BLUE", 2}, {"GREEN", 5}}));
    LayerMap map;
    map.default_material = "grey_50";
    LayerRule rule;
    rule.layer = "BLUE";
    rule.use = "void";
    map.rules.push_back(rule);
    apply_layer_map(imported, map);
    EXPECT_NO_THROW(validate(imported.scene));
    std::size_t left = 0;
    visit_expanded(imported.scene, [&](const Part&, const Surface&, const Affine&, ModifierId id) {
        ++left;
        EXPECT_NE(resolve(imported.scene, id).material, nullptr);
    });
    EXPECT_EQ(left, 6u);
}

TEST(DxfBlocks, ThatAreClippedAreReported)
{
    std::string text = drawing("", triangle("RED", "", "A"));
    text.insert(text.rfind("0\nEOF"), tags("0 SECTION 2 OBJECTS 0 SPATIAL_FILTER 5 1A 0 SPATIAL_FILTER 5 1B 0 ENDSEC"));
    const Imported imported = imported_text(text);
    ASSERT_EQ(imported.report.notes().size(), 1u);
    EXPECT_EQ(imported.report.notes()[0].finding, Finding::unsupported);
    EXPECT_EQ(imported.report.notes()[0].count, 2u);
}

TEST(DxfBlocks, ThatAreClippedAreNamedAndCountedBlockByBlock)
{
    const auto insert = [](const std::string& handle, const std::string& block) {
        return " 0 INSERT 5 " + handle + " 2 " + block + " 8 A-DOOR 10 0 20 0 ";
    };
    // Each clip is owned by a dictionary that is owned by the dictionary of its insert, among owners of other kinds.
    const auto clip = [](const std::string& insert_handle, const std::string& first, const std::string& second) {
        return "0 DICTIONARY 5 " + first + " 330 " + insert_handle + " 3 ACAD_FILTER 360 " + second +
               " 0 DICTIONARY 5 " + second + " 102 {ACAD_REACTORS 330 FFFF 102 } 330 " + first +
               " 3 SPATIAL 360 99 0 SPATIAL_FILTER 5 99 102 {ACAD_REACTORS 330 FFFF 102 } 330 " + second +
               " 10 0 20 0 ";
    };
    const std::string blocks = "0 BLOCK 2 DOOR 10 0 20 0 30 0 " + triangle("RED", "", "A") +
                               " 0 ENDBLK 0 BLOCK 2 GATE 10 0 20 0 30 0 " + triangle("RED", "", "A") + " 0 ENDBLK";
    std::string text = drawing(blocks, insert("2A", "DOOR") + insert("2B", "GATE") + insert("2C", "DOOR"));
    text.insert(text.rfind("0\nEOF"), tags("0 SECTION 2 OBJECTS " + clip("2A", "10", "11") + clip("2C", "12", "13") +
                                           clip("2B", "14", "15") + clip("77", "16", "16") + "0 ENDSEC"));
    const Imported imported = imported_text(text);
    std::map<std::string, std::size_t> found;
    for (const Note& note : imported.report.notes())
        if (note.finding == Finding::unsupported)
            found[note.text] = note.count;
    EXPECT_EQ(found, (std::map<std::string, std::size_t>{
                         {"an insert is clipped (XCLIP); the whole block \"DOOR\" is shown", 2},
                         {"an insert is clipped (XCLIP); the whole block \"GATE\" is shown", 1},
                         {"an insert is clipped (XCLIP); the whole block is shown", 1}}));
    EXPECT_NE(imported.report.notes()[0].place.find("INSERT \"2A\" on layer \"A-DOOR\""), std::string::npos)
        << imported.report.notes()[0].place;
}

TEST(DxfNames, AreDecodedFromCodePagesEscapesAndUtf8)
{
    struct Case {
        std::string code_page, bytes, layer;
    };
    const Case cases[] = {
        {"ANSI_1252", "W\xE4nde", "Wände"},     {"ANSI_1251", "\xD1\xF2\xE5\xED\xFB", "Стены"},
        {"ansi_932", "\x95\xC7", "壁"},         {"dos850", "W\x84nde", "Wände"},
        {"ANSI_1252", "W\\U+00E4nde", "Wände"}, {"ANSI_1252", "Wände", "Wände"},
        {"ANSI_1251", "Стены", "Стены"},
    };
    for (const Case& c : cases) {
        SCOPED_TRACE(c.code_page + " " + c.layer);
        const std::string text =
            tags("0 SECTION 2 HEADER 9 $INSUNITS 70 6 9 $DWGCODEPAGE 3 " + c.code_page +
                 " 0 ENDSEC 0 SECTION 2 ENTITIES " + triangle(c.bytes, "", "A") + " 0 ENDSEC 0 EOF");
        EXPECT_EQ(layer_areas(imported_text(text)).count(c.layer), 1u);
    }
}

TEST(DxfNames, OfLayersAreTheSameInUpperAndLowerCase)
{
    const Imported imported = imported_text(drawing("", triangle("red", "", "A") + triangle("Red", "", "B"), layers));
    EXPECT_EQ(layer_areas(imported).at("RED").surfaces, 2u);
    expect_look(imported, "A", "RED", 1);
}

TEST(DxfNames, OfSurfacesAreHandlesOrLines)
{
    const std::string text = drawing("", "0 LINE 10 0 20 0 11 1 21 0 39 1 0 LINE 5 00a7 10 0 20 0 11 1 21 0 39 1");
    const Imported imported = imported_text(text);
    // Header 10 lines, TABLES 10, BLOCKS 6, ENTITIES 4: the first LINE begins on line 31 at the latest; count it.
    std::size_t line = 1;
    for (std::size_t at = 0; text.compare(at, 7, "0\nLINE\n") != 0; at = text.find('\n', at) + 1)
        ++line;
    EXPECT_EQ(imported.scene.root.surfaces.at(0).name, "line" + std::to_string(line));
    EXPECT_EQ(imported.scene.root.surfaces.at(1).name, "A7");
}

} // namespace
} // namespace lightwell::test
