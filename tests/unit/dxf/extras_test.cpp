#include "engine/base/errors.h"
#include "tests/unit/dxf/dxf_text.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace lightwell::test {
namespace {

using nlohmann::json;

const std::filesystem::path folder = std::filesystem::path{LIGHTWELL_ROOT} / "tests/fixtures/dxf";

json truth_of(const std::string& name)
{
    std::ifstream in{folder / (name + ".truth.json")};
    return json::parse(in);
}

Vec3 vector_of(const json& numbers)
{
    return {numbers[0].get<double>(), numbers[1].get<double>(), numbers[2].get<double>()};
}

/// A lamp as the scene has it, in the words of the truth files.
struct Lamp {
    std::string kind, layer;
    Point at;
    Direction aim;
    double angle_deg = 0;
    double strength = 0; ///< cd, or lx of a distant light
};

std::vector<Lamp> lamps_of(const Imported& imported)
{
    std::vector<Lamp> lamps;
    const Part& root = imported.scene.root;
    for (const Surface& surface : root.surfaces) {
        if (surface.shape == Shape::instance)
            continue;
        const SurfaceKey& key = imported.keys.at(static_cast<std::size_t>(surface.modifier));
        const auto material = std::find_if(imported.file_materials.begin(), imported.file_materials.end(),
                                           [&](const auto& own) { return own.first == key.material; });
        if (material == imported.file_materials.end())
            continue;
        Lamp lamp{"point", key.layer, {}, {}, 0, lumens_per_watt * photopic(emitted_radiance(material->second))};
        if (surface.shape == Shape::source) {
            const DistantSource& source = root.sources.at(surface.index);
            const double sine = std::sin(0.5 * source.full_angle_deg * radians_per_degree);
            lamp.kind = "distant";
            lamp.aim = source.to_source;
            lamp.strength *= pi * sine * sine; // illuminance below a uniform cap
        } else {
            const Sphere& ball = root.spheres.at(surface.index);
            lamp.at = ball.centre;
            lamp.strength *= pi * ball.radius * ball.radius; // its disc as seen from anywhere
            if (const auto* beam = std::get_if<Spotlight>(&material->second)) {
                lamp.kind = "spot";
                lamp.aim = beam->aim;
                lamp.angle_deg = beam->full_angle_deg;
            }
        }
        lamps.push_back(lamp);
    }
    return lamps;
}

class DxfExtras : public testing::TestWithParam<std::string> {};

TEST_P(DxfExtras, LampsHaveThePlaceAimAndStrengthOfTheTruthFile)
{
    const json truth = truth_of(GetParam());
    const Imported imported = import_dxf(folder / (GetParam() + ".dxf"), {});
    const std::vector<Lamp> lamps = lamps_of(imported);
    const json lights = truth.value("lights", json::array()); // releases before 2007 have none
    ASSERT_EQ(lamps.size(), lights.size());
    for (const json& expected : lights) {
        SCOPED_TRACE(expected.dump());
        const bool distant = expected["kind"] == "distant";
        const auto lamp = std::find_if(lamps.begin(), lamps.end(), [&](const Lamp& l) {
            return l.kind == expected["kind"] && (distant || length(l.at - vector_of(expected["at_m"])) < 1e-9);
        });
        ASSERT_NE(lamp, lamps.end());
        EXPECT_EQ(lamp->layer, expected["layer"].get<std::string>());
        const double strength = expected[distant ? "illuminance_lx" : "intensity_cd"].get<double>();
        EXPECT_NEAR(lamp->strength, strength, 1e-9 * strength);
        const char* const way = distant ? "to_source" : "aim";
        if (expected.contains(way)) {
            EXPECT_LT(length(lamp->aim - vector_of(expected[way])), 1e-12);
        }
        if (expected.contains("angle_deg")) {
            EXPECT_NEAR(lamp->angle_deg, expected["angle_deg"].get<double>(), 1e-9);
        }
    }
}

TEST_P(DxfExtras, ViewsHaveThePlaceDirectionAndSizeOfTheTruthFile)
{
    const json truth = truth_of(GetParam());
    const Imported imported = import_dxf(folder / (GetParam() + ".dxf"), {});
    const auto& views = imported.scene.views;
    const std::size_t windows = truth["views"].contains("active") ? 0 : 1; // the one on the screen, not described
    ASSERT_EQ(views.size(), truth["views"].size() + windows);
    EXPECT_EQ(std::count_if(views.begin(), views.end(), [](const View& v) { return v.name == "active"; }), 1);
    for (const auto& [name, expected] : truth["views"].items()) {
        SCOPED_TRACE(name);
        const auto view =
            std::find_if(views.begin(), views.end(), [&name = name](const View& v) { return v.name == name; });
        ASSERT_NE(view, views.end());
        EXPECT_EQ(static_cast<char>(view->kind), expected["kind"].get<std::string>()[0]);
        EXPECT_LT(length(view->direction - vector_of(expected["direction"])), 1e-12);
        EXPECT_LT(length(view->up - vector_of(expected["up"])), 1e-12);
        EXPECT_NEAR(view->horizontal, expected["horizontal"].get<double>(), 1e-9);
        EXPECT_NEAR(view->vertical, expected["vertical"].get<double>(), 1e-9);
        if (expected.contains("position_m")) {
            EXPECT_LT(length(view->position - vector_of(expected["position_m"])), 1e-12);
        } else { // a parallel view: above everything
            EXPECT_NEAR(view->position.x, expected["position_xy_m"][0].get<double>(), 1e-12);
            EXPECT_NEAR(view->position.y, expected["position_xy_m"][1].get<double>(), 1e-12);
            EXPECT_GT(view->position.z, bounds(imported.scene).high.z);
        }
    }
}

TEST_P(DxfExtras, AttributesStandInTheNameOfTheirInsert)
{
    const json truth = truth_of(GetParam());
    const Imported imported = import_dxf(folder / (GetParam() + ".dxf"), {});
    const auto& surfaces = imported.scene.root.surfaces;
    const std::string end = truth["instance_name_ends"].get<std::string>();
    EXPECT_EQ(std::count_if(surfaces.begin(), surfaces.end(),
                            [&](const Surface& s) { return s.shape == Shape::instance && s.name.ends_with(end); }),
              1);
}

INSTANTIATE_TEST_SUITE_P(Releases, DxfExtras,
                         testing::Values("extras_r2000", "extras_r2000_binary", "extras_r2007", "extras_r2007_binary",
                                         "extras_r2018", "extras_r2018_binary", "options_r12", "options_r12_binary",
                                         "options_r2000", "options_r2000_binary", "options_r2007",
                                         "options_r2007_binary", "options_r2018", "options_r2018_binary"),
                         [](const auto& test) { return test.param; });

TEST(DxfRaised, RulesThatFitNoLayerAreNotedAndHeightsMustBePositive)
{
    ImportOptions options;
    options.raised = {{"NOWHERE*", 2.5}};
    const Imported imported = import_dxf(folder / "plan_r2000.dxf", options);
    EXPECT_TRUE(imported.report.has(Finding::unused));
    for (const double height_m : {0.0, -1.0, std::nan(""), infinity}) {
        options.raised = {{"WALL", height_m}};
        EXPECT_THROW(import_dxf(folder / "plan_r2000.dxf", options), InputError) << height_m;
    }
}

TEST(DxfRaised, HeightsAreMetresUnlessTheyHaveAUnit)
{
    const auto parsed = [](const char* words) { return parse_raised_layer(words, "--extrude"); };
    EXPECT_EQ(parsed("A-WALL=2.8").layer, "A-WALL");
    EXPECT_EQ(parsed("A-WALL=2.8").height_m, 2.8);
    EXPECT_EQ(parsed("a=b = 2800mm").layer, "a=b");
    EXPECT_NEAR(parsed("a=b = 2800mm").height_m, 2.8, 1e-15);
    EXPECT_NEAR(parsed("*=9 ft").height_m, 2.7432, 1e-15);
    for (const char* words :
         {"", "WALL", "=3", "WALL=", "WALL=0", "WALL=-2", "WALL=high", "WALL=2 bananas", "WALL=nan"})
        EXPECT_THROW(parsed(words), InputError) << words;
}

TEST(DxfRaised, TheLastRuleThatFitsCountsAndBlocksAreRaisedInTheModel)
{
    ImportOptions options;
    options.raised = {{"*", 9}, {"wall", 2.5}};
    const std::string line = "0 LINE 8 WALL 10 0 20 0 11 2 21 0 ";
    const std::string block = "0 BLOCK 2 B 10 0 20 0 30 0 " + line + "0 ENDBLK ";
    const Imported imported = imported_text(
        drawing(block, line + "0 INSERT 2 B 10 5 20 0 41 3 42 3 43 3 0 INSERT 2 B 10 5 20 9 41 3 42 3 43 3"), options);
    const auto areas = layer_areas(imported);
    EXPECT_EQ(areas.at("WALL").surfaces, 3u);
    EXPECT_NEAR(areas.at("WALL").area_m2, 2 * 2.5 + 2 * 6 * 2.5, 1e-12);
    EXPECT_NEAR(exact_bounds(imported).high.z, 2.5, 1e-12);
}

TEST(DxfUnits, FeetAndInchesInTheWayNumbersAreWrittenMeanInches)
{
    const std::string text = tags("0 SECTION 2 HEADER 9 $MEASUREMENT 70 1 9 $LUNITS 70 4 0 ENDSEC 0 SECTION 2 ENTITIES "
                                  "0 LINE 8 A 10 0 20 0 11 100 21 0 39 100 0 ENDSEC 0 EOF");
    const Imported imported = imported_text(text);
    EXPECT_EQ(imported.unit, "in (assumed: $LUNITS writes feet and inches)");
    EXPECT_NEAR(layer_areas(imported).at("A").area_m2, 2.54 * 2.54, 1e-12);
}

} // namespace
} // namespace lightwell::test
