#include "importers/layer_report.h"
#include "importers/layers.h"
#include "importers/surface_amounts.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace lightwell {
namespace {

SurfaceKey on(const std::string& layer)
{
    SurfaceKey key;
    key.layer = layer;
    key.entity = "3DFACE";
    return key;
}

/// Two walls of 2 m2 and a block with a unit sphere on layer 0, inserted three times: as it is, twice as large and
/// mirrored, and flattened to half its height.
Imported building()
{
    Imported imported;
    imported.unit = "mm (from $INSUNITS)";
    KeyTable keys{imported};
    const ModifierId wall = keys.modifier_for(on("A-WALL"));
    imported.scene.root.add_polygon({{0, 0, 0}, {2, 0, 0}, {2, 0, 1}, {0, 0, 1}}, wall, "1");
    imported.scene.root.add_polygon({{0, 3, 0}, {2, 3, 0}, {2, 3, 1}, {0, 3, 1}}, wall, "2");
    const ModifierId zero = keys.inherited(on("0"));
    Part part;
    part.add_sphere({{0, 0, 0}, 1}, Shape::sphere, zero, "s");
    imported.scene.prototypes.push_back(part);
    const ModifierId lamp = keys.modifier_for(on("E-LITE"));
    for (const Affine& map : {Affine{}, Affine::scale(Vec3{-2, 2, 2}), Affine::scale(Vec3{1, 1, 0.5})})
        imported.scene.root.add_instance({0, map, {{zero, lamp}}}, "i");
    imported.ledger.made(6);
    imported.ledger.skipped("TEXT", "A-ANNO", "has no area", 3);
    return imported;
}

/// Area of the unit sphere flattened to half: oblate, e^2 = 3/4.
double oblate()
{
    const double e = std::sqrt(0.75);
    return 2 * pi * (1 + 0.25 / e * std::atanh(e));
}

TEST(Summary, CountsInstancesAndMeasuresThemInTheWorld)
{
    const std::vector<LayerSummary> layers = summarize_layers(building());
    ASSERT_EQ(layers.size(), 2u);
    EXPECT_EQ(layers[0].name, "A-WALL");
    EXPECT_EQ(layers[0].surfaces, 2u);
    EXPECT_NEAR(layers[0].area_m2, 4, 1e-12);
    EXPECT_EQ(layers[0].material, "generic_wall");
    EXPECT_EQ(layers[1].name, "E-LITE");
    EXPECT_EQ(layers[1].surfaces, 3u);
    EXPECT_NEAR(layers[1].area_m2, 4 * pi + 16 * pi + oblate(), 1e-9);
    EXPECT_EQ(layers[1].material, "luminaire_panel");
}

TEST(Summary, AForestOfAHundredMillionSurfacesIsCountedAtOnce)
{
    Imported imported;
    KeyTable keys{imported};
    Part leaf;
    leaf.add_polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, keys.modifier_for(on("LEAF")), "l");
    imported.scene.prototypes.push_back(leaf);
    for (std::uint32_t level = 1; level <= 8; ++level) {
        Part part;
        for (int i = 0; i < 10; ++i)
            part.add_instance({level - 1, Affine::translate({10. * i, 0, 0}), {}}, "i");
        imported.scene.prototypes.push_back(part);
    }
    imported.scene.root.add_instance({8, Affine::scale(0.1), {}}, "forest");
    const std::vector<LayerSummary> layers = summarize_layers(imported);
    ASSERT_EQ(layers.size(), 1u);
    EXPECT_EQ(layers[0].surfaces, 100000000u);
    EXPECT_NEAR(layers[0].area_m2, 1e6, 1e-3);
}

TEST(LayersJson, HasExactlyThePromisedShape)
{
    const auto json = nlohmann::json::parse(layers_json(building(), "house.dxf"));
    ASSERT_EQ(json.size(), 5u);
    EXPECT_EQ(json["file"], "house.dxf");
    EXPECT_EQ(json["unit"], "mm (from $INSUNITS)");
    EXPECT_EQ(json["bounds_m"], nlohmann::json::parse("[[-2,-2,-2],[2,3,2]]"));
    ASSERT_EQ(json["layers"].size(), 2u);
    EXPECT_EQ(json["layers"][0],
              nlohmann::json::parse(R"({"name":"A-WALL","surfaces":2,"area_m2":4.0,"material":"generic_wall"})"));
    EXPECT_EQ(json["entities"], nlohmann::json::parse(R"({"read":9,"made":6,"skipped":[
        {"type":"TEXT","layer":"A-ANNO","reason":"has no area","count":3}]})"));
}

TEST(LayersJson, AnEmptyFileHasNoBounds)
{
    const auto json = nlohmann::json::parse(layers_json({}, "empty.dxf"));
    EXPECT_TRUE(json["bounds_m"].is_null());
    EXPECT_TRUE(json["layers"].is_array() && json["layers"].empty());
    EXPECT_EQ(json["entities"]["read"], 0);
}

TEST(LayersJson, NamesInAnyScriptAndWithBrokenBytesAreWritten)
{
    Imported imported;
    KeyTable keys{imported};
    for (const char* layer : {"墙\n\"1\"", "bad\xFF"})
        imported.scene.root.add_polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, keys.modifier_for(on(layer)), "p");
    const auto json = nlohmann::json::parse(layers_json(imported, "f"));
    ASSERT_EQ(json["layers"].size(), 2u);
    EXPECT_EQ(json["layers"][1]["name"], "墙\n\"1\"");
}

TEST(LayersTable, ShowsEveryLayerWithAlignedColumns)
{
    Imported imported = building();
    KeyTable keys{imported};
    imported.scene.root.add_polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, keys.modifier_for(on("Wände")), "p");
    const std::string text = layers_table(imported);
    EXPECT_NE(text.find("area m2  proposed material\n"), std::string::npos) << text;
    EXPECT_NE(text.find("A-WALL           2             4  generic_wall\n"), std::string::npos) << text;
    EXPECT_NE(text.find("Wände            1           0.5  generic_wall\n"), std::string::npos) << text;
    EXPECT_NE(text.find("9 entities read, 6 made into surfaces, 3 skipped\n"), std::string::npos) << text;
    EXPECT_NE(text.find("skipped 3 x TEXT on layer \"A-ANNO\": has no area"), std::string::npos) << text;
}

/// As building(), with the types and layers of what was made.
Imported counted_building()
{
    Imported imported = building();
    imported.ledger = {};
    imported.ledger.made("3DFACE", "A-WALL", 2);
    imported.ledger.made("SPHERE", "0");
    imported.ledger.made("INSERT", "E-LITE", 3);
    imported.ledger.skipped("TEXT", "A-ANNO", "has no area", 3);
    imported.ledger.skipped("3DFACE", "A-WALL", "zero area");
    imported.ledger.repaired("3DFACE", "A-WALL", "cut into triangles");
    return imported;
}

const LedgerRow& row_of(const std::vector<LedgerRow>& rows, const std::string& layer, const std::string& type)
{
    for (const LedgerRow& row : rows)
        if (row.layer == layer && row.type == type)
            return row;
    throw std::runtime_error("no row " + layer + ' ' + type);
}

TEST(LedgerRows, BalanceAndMeasureEachTypeOnEachLayer)
{
    const std::vector<LedgerRow> rows = ledger_rows(counted_building());
    const LedgerRow& wall = row_of(rows, "A-WALL", "3DFACE");
    EXPECT_EQ(wall.read, 3u);
    EXPECT_EQ(wall.made, 2u);
    EXPECT_EQ(wall.skipped.at("zero area"), 1u);
    EXPECT_EQ(wall.repaired.at("cut into triangles"), 1u);
    EXPECT_EQ(wall.surfaces, 2u);
    EXPECT_NEAR(wall.area_m2, 4, 1e-12);
    EXPECT_EQ(wall.bounds.low, (Point{0, 0, 0}));
    EXPECT_EQ(wall.bounds.high, (Point{2, 3, 1}));
    EXPECT_EQ(row_of(rows, "0", "SPHERE").made, 1u);
    EXPECT_EQ(row_of(rows, "0", "SPHERE").surfaces, 0u) << "they appear on the layer of the inserts";
    const LedgerRow& lamps = row_of(rows, "E-LITE", "3DFACE");
    EXPECT_EQ(lamps.surfaces, 3u);
    EXPECT_EQ(lamps.bounds.high, (Point{2, 2, 2}));
    std::size_t read = 0;
    for (const LedgerRow& row : rows) {
        std::size_t skipped = 0;
        for (const auto& entry : row.skipped)
            skipped += entry.second;
        EXPECT_EQ(row.read, row.made + skipped) << row.layer << ' ' << row.type;
        read += row.read;
    }
    EXPECT_EQ(read, 10u);
}

TEST(LedgerRows, WhatAMapLeavesOutMovesToTheSkippedSide)
{
    Imported imported = counted_building();
    std::vector<LedgerRow> rows = ledger_rows(imported);
    LayerMap map;
    map.file = "map.toml";
    LayerRule rule;
    rule.layer = "A-WALL";
    rule.use = "void";
    map.rules = {rule};
    apply_layer_map(imported, map);
    update_counts(rows, imported.ledger);
    const LedgerRow& wall = row_of(rows, "A-WALL", "3DFACE");
    EXPECT_EQ(wall.made, 0u);
    EXPECT_EQ(wall.skipped.at("void in the layer map"), 2u);
    EXPECT_NEAR(wall.area_m2, 4, 1e-12) << "measured before the map";
}

TEST(LedgerReport, HasTheSameNumbersForPeopleAndForPrograms)
{
    const Imported imported = counted_building();
    const std::vector<LedgerRow> rows = ledger_rows(imported);
    const std::vector<RuleHits> rules{{7, "layer = \"A-*\" -> white_paint", 2, 4.0}};
    const auto json = nlohmann::json::parse(report_json(imported, "house.dxf", rows, rules));
    EXPECT_EQ(json["ledger"].size(), rows.size());
    EXPECT_EQ(json["ledger"][2], nlohmann::json::parse(R"({"layer":"A-WALL","type":"3DFACE","read":3,"made":2,
        "skipped":[{"reason":"zero area","count":1}],"repaired":[{"what":"cut into triangles","count":1}],
        "surfaces":2,"area_m2":4.0,"bounds_m":[[0,0,0],[2,3,1]]})"));
    EXPECT_EQ(json["totals"], nlohmann::json::parse(R"({"read":10,"made":6,"skipped":4})"));
    EXPECT_EQ(json["rules"][0]["line"], 7);
    const std::string text = report_table(imported, rows, rules);
    EXPECT_NE(text.find("    skipped 1: zero area\n"), std::string::npos) << text;
    EXPECT_NE(text.find("10 entities read = 6 made into surfaces + 4 skipped"), std::string::npos) << text;
    EXPECT_NE(text.find("rule in line 7: 2 surfaces, 4 m2: layer = \"A-*\" -> white_paint"), std::string::npos) << text;
}

TEST(SurfaceBoxes, OfTurnedRoundShapesAreTight)
{
    // A cylinder along x turned by 45 degrees about z: half its length and its radius, seen along each axis.
    Part part;
    part.add_cone({{{-1, 0, 0}, {1, 0, 0}}, {0.5, 0.5}}, Shape::cylinder, 0, "c");
    const Box box = surface_bounds(part, part.surfaces[0], Affine::rotate(2, pi / 4));
    const double reach = (1 + 0.5) * std::sqrt(0.5);
    EXPECT_NEAR(box.high.x, reach, 1e-12);
    EXPECT_NEAR(box.high.y, reach, 1e-12);
    EXPECT_NEAR(box.high.z, 0.5, 1e-12);
    Part ball;
    ball.add_sphere({{1, 0, 0}, 2}, Shape::sphere, 0, "s");
    const Box squashed =
        surface_bounds(ball, ball.surfaces[0], compose(Affine::rotate(2, 1), Affine::scale({1, 1, .5})));
    EXPECT_NEAR(squashed.high.x, std::cos(1.0) + 2, 1e-12);
    EXPECT_NEAR(squashed.high.z, 1, 1e-12);
}

} // namespace
} // namespace lightwell
