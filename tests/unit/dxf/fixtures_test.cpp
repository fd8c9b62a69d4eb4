#include "importers/dxf/colours.h"
#include "tests/unit/dxf/dxf_text.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace lightwell::test {
namespace {

using nlohmann::json;

const std::filesystem::path folder = std::filesystem::path{LIGHTWELL_ROOT} / "tests/fixtures/dxf";
constexpr double coordinate_within_m = 1e-9;

json read_json(const std::filesystem::path& file)
{
    std::ifstream in{file};
    EXPECT_TRUE(in.good()) << file;
    return json::parse(in);
}

Imported imported_fixture(const std::string& name, const json& truth = {})
{
    ImportOptions options;
    if (truth.contains("metres_per_unit"))
        options.metres_per_unit = truth["metres_per_unit"].get<double>();
    if (truth.contains("raised"))
        for (const auto& [layer, height_m] : truth["raised"].items())
            options.raised.push_back({layer, height_m.get<double>()});
    return import_dxf(folder / (name + ".dxf"), options);
}

std::string text_of(const Report& report)
{
    std::ostringstream out;
    out << report;
    return out.str();
}

void expect_layers(const Imported& imported, const json& truth)
{
    auto found = layer_areas(imported);
    for (const auto& [name, layer] : truth["layers"].items()) {
        SCOPED_TRACE(name);
        if (!layer["surfaces"].is_null()) { // null: facets, as many as the tolerance needs
            EXPECT_EQ(found[name].surfaces, layer["surfaces"].get<std::size_t>());
        }
        const double area = layer["area_m2"].get<double>();
        EXPECT_NEAR(found[name].area_m2, area, layer["relative"].get<double>() * area);
    }
    EXPECT_EQ(found.size(), truth["layers"].size());
}

void expect_ledger(const Ledger& ledger, const json& truth)
{
    EXPECT_EQ(ledger.read_count(), truth["read"].get<std::size_t>());
    EXPECT_EQ(ledger.made_count(), truth["made"].get<std::size_t>());
    std::map<std::string, std::size_t> found, expected;
    for (const Ledger::Skipped& line : ledger.skipped_list())
        found[line.type + " | " + line.layer + " | " + line.reason] += line.count;
    for (const json& line : truth["skipped"])
        expected[line["type"].get<std::string>() + " | " + line["layer"].get<std::string>() + " | " +
                 line["reason"].get<std::string>()] += line["count"].get<std::size_t>();
    EXPECT_EQ(found, expected);
    found.clear();
    expected.clear();
    for (const Ledger::Repaired& line : ledger.repaired_list())
        found[line.type + " | " + line.layer + " | " + line.what] += line.count;
    if (truth.contains("repaired"))
        for (const json& line : truth["repaired"])
            expected[line["type"].get<std::string>() + " | " + line["layer"].get<std::string>() + " | " +
                     line["what"].get<std::string>()] += line["count"].get<std::size_t>();
    EXPECT_EQ(found, expected);
}

void expect_notes(const Report& report, const json& truth)
{
    for (const json& expected : truth["notes"]) {
        bool found = false;
        for (const Note& note : report.notes())
            found |= to_string(note.finding) == expected["finding"] &&
                     note.text.find(expected["contains"].get<std::string>()) != std::string::npos;
        EXPECT_TRUE(found) << expected << "\n" << text_of(report);
    }
    EXPECT_EQ(report.notes().size(), truth["notes"].size()) << text_of(report);
}

/// Every key on a layer has the colour of the truth.
void expect_colours(const Imported& imported, const json& truth)
{
    if (!truth.contains("colours"))
        return;
    for (const auto& [layer, rgb] : truth["colours"].items()) {
        SCOPED_TRACE(layer);
        std::size_t found = 0;
        for (std::size_t i = 0; i < imported.keys.size(); ++i) {
            const SurfaceKey& key = imported.keys[i];
            if (key.layer != layer || std::holds_alternative<Inherited>(imported.scene.modifiers[i].what))
                continue;
            ++found;
            ASSERT_TRUE(key.colour);
            for (std::size_t channel = 0; channel < 3; ++channel)
                EXPECT_NEAR((*key.colour)[static_cast<int>(channel)], rgb[channel].get<double>(), 1e-12);
        }
        EXPECT_GT(found, 0u);
    }
}

class DxfFixture : public testing::TestWithParam<std::string> {};

TEST_P(DxfFixture, HoldsTheSurfacesAreasBoundsAndEntitiesOfItsTruthFile)
{
    const json truth = read_json(folder / (GetParam() + ".truth.json"));
    const Imported imported = imported_fixture(GetParam(), truth);
    EXPECT_NO_THROW(validate(imported.scene));
    EXPECT_EQ(imported.unit, truth["unit"].get<std::string>());
    expect_layers(imported, truth);
    expect_ledger(imported.ledger, truth);
    expect_notes(imported.report, truth);
    expect_colours(imported, truth);
    const Box box = exact_bounds(imported);
    for (int axis = 0; axis < 3; ++axis) {
        SCOPED_TRACE(axis);
        EXPECT_NEAR(box.low[axis], truth["bounds_m"]["low"][static_cast<std::size_t>(axis)].get<double>(),
                    coordinate_within_m);
        EXPECT_NEAR(box.high[axis], truth["bounds_m"]["high"][static_cast<std::size_t>(axis)].get<double>(),
                    coordinate_within_m);
    }
}

/// Every drawing that has a truth file beside it.
std::vector<std::string> fixture_names()
{
    std::vector<std::string> names;
    for (const auto& item : std::filesystem::directory_iterator{folder})
        if (item.path().extension() == ".dxf" &&
            std::filesystem::exists(folder / (item.path().stem().string() + ".truth.json")))
            names.push_back(item.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

INSTANTIATE_TEST_SUITE_P(All, DxfFixture, testing::ValuesIn(fixture_names()),
                         [](const auto& test) { return test.param; });

TEST(DxfFixtures, CoverReleases12To2018AsTextAndBinary)
{
    const std::vector<std::string> names = fixture_names();
    for (const char* kind :
         {"entities", "inserts", "plan", "areas", "extras", "hidden", "references", "styles", "options"})
        for (const char* release : {"_r12", "_r2000", "_r2007", "_r2018"})
            for (const char* ending : {"", "_binary"}) {
                const std::string name = std::string{kind} + release + ending;
                const bool came_later =
                    std::string{release} == "_r12" && (name[0] == 'a' || name.starts_with("extras"));
                EXPECT_EQ(std::count(names.begin(), names.end(), name), came_later ? 0 : 1) << name;
            }
}

/// Rows of the table that ezdxf wrote of the drawings: its cells by entity and option.
std::map<std::string, std::vector<std::string>> table_of_the_readme()
{
    std::ifstream in{folder / "README.md"};
    std::map<std::string, std::vector<std::string>> rows;
    bool within = false;
    for (std::string line; std::getline(in, line);) {
        within = within || line == "<!-- table -->";
        if (!within || !line.starts_with("| ") || line.starts_with("| ---"))
            continue;
        std::vector<std::string> cells;
        std::istringstream words{line.substr(1)};
        for (std::string cell; std::getline(words, cell, '|');)
            cells.push_back(
                cell.find_first_not_of(' ') == std::string::npos ? "" : cell.substr(1, cell.find_last_not_of(' ')));
        const std::string name = cells.front();
        rows[name] = {cells.begin() + 1, cells.end()};
    }
    return rows;
}

/// What drawings are made of; ezdxf may find more.
const char* const needed_in_every_release[] = {"LINE, thickness",
                                               "LWPOLYLINE, bulge",
                                               "LWPOLYLINE, width",
                                               "LWPOLYLINE, elevation",
                                               "LWPOLYLINE, thickness",
                                               "LWPOLYLINE, closed",
                                               "POLYLINE, bulge",
                                               "POLYLINE, width",
                                               "POLYLINE, elevation",
                                               "POLYLINE, thickness",
                                               "POLYLINE, closed",
                                               "POLYLINE, 3D",
                                               "POLYLINE, polygon mesh",
                                               "POLYLINE, polyface mesh",
                                               "3DFACE",
                                               "SOLID",
                                               "TRACE",
                                               "CIRCLE, thickness",
                                               "ARC, thickness",
                                               "ELLIPSE",
                                               "SPLINE",
                                               "HATCH, islands",
                                               "MESH, levels",
                                               "MESH, creases",
                                               "REGION",
                                               "3DSOLID",
                                               "BODY",
                                               "SURFACE",
                                               "INSERT, nested",
                                               "INSERT, array",
                                               "INSERT, mirrored",
                                               "INSERT, extrusion",
                                               "INSERT, uneven scale",
                                               "INSERT, with attributes",
                                               "INSERT, external reference",
                                               "INSERT, by block",
                                               "3DFACE, on layer 0 of a block",
                                               "3DFACE, true colour",
                                               "3DFACE, in paper space",
                                               "LAYER, off",
                                               "LAYER, frozen",
                                               "LAYER, not plotted",
                                               "LIGHT, point",
                                               "LIGHT, spot",
                                               "LIGHT, distant",
                                               "VIEW",
                                               "VPORT"};

TEST(DxfFixtures, HoldEveryEntityAndOptionInEveryReleaseThatHasItAsTextAndBinary)
{
    const auto rows = table_of_the_readme();
    for (const char* needed : needed_in_every_release)
        EXPECT_TRUE(rows.contains(needed)) << needed;
    for (const auto& [name, cells] : rows) {
        SCOPED_TRACE(name);
        ASSERT_EQ(cells.size(), 8u);
        if (name == "entity, option")
            continue;
        EXPECT_EQ(cells.back(), "x");
        for (std::size_t i = 0; i < cells.size(); ++i) { // text, binary of R12, R2000, R2007, R2018
            EXPECT_TRUE(cells[i] == "x" || cells[i] == "-") << i;
            EXPECT_EQ(cells[i], cells[i / 2 * 2]) << i;
        }
    }
}

void expect_same_surfaces(const Part& a, const Part& b)
{
    ASSERT_EQ(a.surfaces.size(), b.surfaces.size());
    for (std::size_t i = 0; i < a.surfaces.size(); ++i) {
        EXPECT_EQ(a.surfaces[i].modifier, b.surfaces[i].modifier);
        EXPECT_EQ(a.surfaces[i].name, b.surfaces[i].name);
    }
    ASSERT_EQ(a.points.size(), b.points.size());
    for (std::size_t i = 0; i < a.points.size(); ++i)
        EXPECT_LT(length(a.points[i] - b.points[i]), coordinate_within_m) << i; // text keeps 16 digits
}

TEST(DxfBinary, GivesTheSameSurfacesAndNamesAsText)
{
    for (const std::string name : {"entities", "entities_r12", "inserts", "areas_r2018"}) {
        SCOPED_TRACE(name);
        const Imported text = imported_fixture(name), binary = imported_fixture(name + "_binary");
        ASSERT_EQ(text.scene.prototypes.size(), binary.scene.prototypes.size());
        for (std::size_t i = 0; i < text.scene.prototypes.size(); ++i)
            expect_same_surfaces(text.scene.prototypes[i], binary.scene.prototypes[i]);
        if (name != "entities_r12") // without handles, the names are lines here and bytes there
            expect_same_surfaces(text.scene.root, binary.scene.root);
        EXPECT_EQ(text.keys.size(), binary.keys.size());
    }
}

TEST(DxfColours, AreThePaletteOfTheReferenceLibraryWithinOneStepOf255)
{
    const json table = read_json(folder / "palette.truth.json");
    ASSERT_EQ(table.size(), 228u);
    for (const auto& [index, rgb] : table.items()) {
        SCOPED_TRACE(index);
        const Spectrum found = dxf::palette_colour(std::stoi(index));
        for (const int channel : {0, 1, 2})
            EXPECT_NEAR(255 * linear_to_srgb(found[channel]),
                        255 * linear_to_srgb(rgb[static_cast<std::size_t>(channel)].get<double>()), 1.001);
    }
}

} // namespace
} // namespace lightwell::test
