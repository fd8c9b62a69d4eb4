#include "engine/base/text.h"
#include "tests/unit/importers/layer_maps.h"

namespace lightwell {
namespace {

/// A rectangle of a given width and a height of one metre, upright at y.
std::vector<Point> upright(double width, double y = 0)
{
    return {{0, y, 0}, {width, y, 0}, {width, y, 1}, {0, y, 1}};
}

TEST_F(LayerMaps, RulesTellSurfacesApartByAreaAndSize)
{
    const ModifierId wall = keys_.modifier_for(on("WALL"));
    for (const double width : {0.2, 1.0, 3.0, 8.0})
        imported_.scene.root.add_polygon(upright(width), wall, shortest(width));
    const std::vector<RuleHits> hits = apply_layer_map(imported_, map("[[rule]]\nlayer = \"WALL\"\nuse = \"concrete\"\n"
                                                                      "[[rule]]\narea_m2 = \"..0.5\"\nuse = \"void\"\n"
                                                                      "[[rule]]\nlayer = \"W*\"\nsize_m = \"3..\"\n"
                                                                      "area_m2 = \"2..5\"\nuse = \"oak\"\n"));
    validate(imported_.scene);
    EXPECT_EQ(by_modifier(), (std::map<std::string, int>{{"WALL/concrete", 2}, {"WALL/oak", 1}}));
    ASSERT_EQ(hits.size(), 3u);
    EXPECT_EQ(hits[0].surfaces, 2u);
    EXPECT_NEAR(hits[0].area_m2, 9, 1e-12);
    EXPECT_EQ(hits[1].surfaces, 1u);
    EXPECT_NEAR(hits[2].area_m2, 3, 1e-12);
    EXPECT_EQ(hits[2].text, "layer = \"W*\", area_m2 = \"2..5\", size_m = \"3..\" -> oak");
}

TEST_F(LayerMaps, AreaAndSizeReachIntoBlocksWhoseLayerTheInsertDecides)
{
    const ModifierId zero = keys_.inherited(on("0"));
    Part leaf, door;
    leaf.add_polygon(upright(2), zero, "leaf");
    leaf.add_polygon(upright(0.1), zero, "edge");
    door.add_instance({0, Affine{}, {{zero, zero}}}, "leaf in door");
    imported_.scene.prototypes = {leaf, door};
    for (const char* layer : {"DOOR", "GATE"})
        imported_.scene.root.add_instance({1, Affine{}, {{zero, keys_.modifier_for(on(layer))}}}, layer);
    apply("default = \"oak\"\n[[rule]]\nlayer = \"DOOR\"\narea_m2 = \"..0.5\"\nuse = \"steel\"\n");
    EXPECT_EQ(by_modifier(), (std::map<std::string, int>{{"DOOR/oak", 1}, {"DOOR/steel", 1}, {"GATE", 2}}));
}

TEST_F(LayerMaps, BadRangesAndRangesThatHoldNothingAreNamed)
{
    face(on("WALL"));
    EXPECT_NE(complaint("[[rule]]\narea_m2 = \"2\"\nuse = \"oak\"").find("area_m2 is \"2\", expected LOW..HIGH"),
              std::string::npos);
    for (const char* range : {"5..2", "..", "a..b", "nan..2"})
        EXPECT_NE(complaint(std::string("[[rule]]\nsize_m = \"") + range + "\"\nuse = \"oak\"").find("map.toml:2"),
                  std::string::npos)
            << range;
    EXPECT_NE(complaint("[[rule]]\nlayer = \"WALL\"\narea_m2 = \"10..\"\nuse = \"oak\"")
                  .find("no surface has layer = \"WALL\", the area and size of the rule together"),
              std::string::npos);
}

TEST_F(LayerMaps, TwoSheetsOfAGlazingUnitBecomeOneWhereTheMaterialStandsForAllPanes)
{
    const ModifierId glass = keys_.modifier_for(on("A-GLAZ")), far = keys_.modifier_for(on("A-GLAZ-FAR"));
    imported_.scene.root.add_polygon(upright(2, 0), glass, "outer");
    imported_.scene.root.add_polygon(upright(2, 0.024), glass, "inner");
    imported_.scene.root.add_polygon(upright(2, 5), far, "one");
    imported_.scene.root.add_polygon(upright(2, 5.2), far, "another, 200 mm away");
    imported_.ledger.made("3DFACE", "A-GLAZ", 2);
    imported_.ledger.made("3DFACE", "A-GLAZ-FAR", 2);
    apply("default = \"glass_double_clear\"\n");
    EXPECT_EQ(by_modifier(), (std::map<std::string, int>{{"A-GLAZ", 1}, {"A-GLAZ-FAR", 2}}));
    EXPECT_EQ(imported_.ledger.made_count(), 3u);
    ASSERT_EQ(imported_.ledger.skipped_list().size(), 1u);
    EXPECT_EQ(imported_.ledger.skipped_list()[0].reason, "second sheet of a glazing unit");
    EXPECT_TRUE(imported_.report.has(Finding::repaired));
}

TEST_F(LayerMaps, TwoSheetsOfASinglePaneMaterialStayTwo)
{
    const ModifierId glass = keys_.modifier_for(on("A-GLAZ"));
    imported_.scene.root.add_polygon(upright(2, 0), glass, "outer");
    imported_.scene.root.add_polygon(upright(2, 0.024), glass, "inner");
    apply("default = \"glass_single_clear\"\n");
    EXPECT_EQ(by_modifier(), (std::map<std::string, int>{{"A-GLAZ", 2}}));
}

TEST_F(LayerMaps, AnImpossibleLampIsAQuestionAndALuminousCeilingIsNone)
{
    // 5e6 lm from a square metre: L = 5e6 / pi cd/m2.
    const double radiance = 5e6 / pi / lumens_per_watt;
    imported_.file_materials = {{"Floodlight", Light{Spectrum::grey(radiance)}}};
    SurfaceKey key = on("LAMP");
    key.material = "Floodlight";
    face(key);
    imported_.scene.root.add_polygon({{0, 0, 3}, {0, 50, 3}, {50, 50, 3}, {50, 0, 3}}, keys_.modifier_for(on("CEIL")),
                                     "c");
    apply("[[rule]]\nlayer = \"CEIL\"\nuse = \"led_panel_4000cd\"\nside = \"front\"\n");
    std::size_t questions = 0;
    for (const Note& note : imported_.report.notes())
        if (note.finding == Finding::question) {
            ++questions;
            EXPECT_NE(note.text.find("lamps of layer \"LAMP\" give 5e+06 lm each"), std::string::npos) << note.text;
        }
    EXPECT_EQ(questions, 1u);
}

} // namespace
} // namespace lightwell
