#include "engine/base/errors.h"
#include "importers/formats/formats.h"
#include "importers/units.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>

namespace lightwell {
namespace {

/// A drawing as OBJ, in a unit and with an axis upwards; names as offices use them.
class Drawing {
public:
    /// @param to_file  what metres, z up, become in the file
    explicit Drawing(std::function<Point(const Point&)> to_file) : to_file_(std::move(to_file)) {}

    void quad(const std::string& layer, const Point& a, const Point& b, const Point& c, const Point& d)
    {
        text_ += "g " + layer + '\n';
        for (const Point& corner : {a, b, c, d}) {
            const Point p = to_file_(corner);
            text_ += "v " + std::to_string(p.x) + ' ' + std::to_string(p.y) + ' ' + std::to_string(p.z) + '\n';
        }
        text_ += "f -4 -3 -2 -1\n";
    }
    /// Floor, ceiling, four walls, a door, a window and a desk.
    void room(double width, double depth, double height, const std::vector<std::string>& layers)
    {
        quad(layers[0], {0, 0, 0}, {width, 0, 0}, {width, depth, 0}, {0, depth, 0});
        quad(layers[1], {0, 0, height}, {0, depth, height}, {width, depth, height}, {width, 0, height});
        for (const double y : {0.0, depth})
            quad(layers[2], {0, y, 0}, {width, y, 0}, {width, y, height}, {0, y, height});
        for (const double x : {0.0, width})
            quad(layers[2], {x, 0, 0}, {x, depth, 0}, {x, depth, height}, {x, 0, height});
        quad(layers[3], {0.5, 0.01, 0}, {1.4, 0.01, 0}, {1.4, 0.01, 2.1}, {0.5, 0.01, 2.1});
        quad(layers[4], {1, depth - 0.01, 0.9}, {2.2, depth - 0.01, 0.9}, {2.2, depth - 0.01, 2.2},
             {1, depth - 0.01, 2.2});
        quad(layers[5], {1, 1, 0.72}, {2.6, 1, 0.72}, {2.6, 1.8, 0.72}, {1, 1.8, 0.72});
    }
    /// Reads the drawing as a user would who tells the unit and the axis.
    std::vector<std::string> questions(const std::string& unit, const std::string& up) const
    {
        const std::filesystem::path file =
            std::filesystem::path(testing::TempDir()) / ("asked-" + std::to_string(getpid()) + ".obj");
        std::ofstream(file) << text_;
        ImportOptions options;
        options.metres_per_unit = parse_unit(unit).value;
        options.up = up;
        std::vector<std::string> found;
        const Imported imported = import_file(file, options);
        for (const Note& note : imported.report.notes())
            if (note.finding == Finding::question)
                found.push_back(note.text);
        std::filesystem::remove(file);
        return found;
    }

private:
    std::function<Point(const Point&)> to_file_;
    std::string text_;
};

const std::vector<std::string> aia{"A-FLOR", "A-CLNG", "A-WALL", "A-DOOR", "A-GLAZ", "I-FURN"};
const std::vector<std::string> german{"Fußboden", "Decke", "Wände", "Türen", "Fenster", "Möbel"};
const std::vector<std::string> french{"Sol", "Plafond", "Murs", "Portes", "Fenêtres", "Mobilier"};
const std::vector<std::string> unnamed{"Layer1", "Layer2", "Layer3", "Layer4", "Layer5", "Layer6"};

std::function<Point(const Point&)> in_unit(const std::string& unit, const std::string& up)
{
    const double per_metre = 1 / parse_unit(unit).value;
    if (up == "y")
        return [per_metre](const Point& p) { return Point{p.x, p.z, -p.y} * per_metre; };
    return [per_metre](const Point& p) { return p * per_metre; };
}

struct Reading {
    const char *drawn_in, *drawn_up, *read_in, *read_up;
    const std::vector<std::string>* layers;
    double width, depth, height;
};

std::vector<std::string> questions_of(const Reading& reading)
{
    Drawing drawing{in_unit(reading.drawn_in, reading.drawn_up)};
    drawing.room(reading.width, reading.depth, reading.height, *reading.layers);
    return drawing.questions(reading.read_in, reading.read_up);
}

TEST(Questions, TenDrawingsInAWrongUnitOrWithAWrongAxisAreAllQuestioned)
{
    const Reading wrong[] = {
        {"mm", "z", "m", "z", &aia, 5, 4, 3},      {"m", "z", "mm", "z", &german, 6, 9, 2.7},
        {"cm", "z", "m", "z", &french, 4, 4, 2.5}, {"m", "z", "cm", "z", &aia, 12, 8, 3.5},
        {"in", "z", "m", "z", &aia, 7, 5, 3},      {"ft", "z", "m", "z", &german, 5, 5, 2.4},
        {"mm", "z", "in", "z", &aia, 5, 4, 3},     {"m", "z", "mm", "z", &unnamed, 30, 12, 3},
        {"m", "z", "m", "y", &aia, 5, 4, 3},       {"mm", "y", "mm", "z", &french, 6, 4, 2.6},
    };
    for (const Reading& reading : wrong)
        EXPECT_FALSE(questions_of(reading).empty())
            << "drawn in " << reading.drawn_in << ", read in " << reading.read_in << ", up " << reading.read_up;
}

TEST(Questions, AreAskedWithTheUnitThatWouldMakeSense)
{
    const std::vector<std::string> asked = questions_of({"mm", "z", "m", "z", &aia, 5, 4, 3});
    ASSERT_FALSE(asked.empty());
    EXPECT_NE(asked[0].find("give --unit mm"), std::string::npos) << asked[0];
    const std::vector<std::string> axis = questions_of({"m", "z", "m", "y", &aia, 5, 4, 3});
    ASSERT_FALSE(axis.empty());
    EXPECT_NE(axis[0].find("floors (layer \"A-FLOR\") stand upright"), std::string::npos) << axis[0];
}

TEST(Questions, RightDrawingsFromAClosetToAStationRaiseNone)
{
    const char* units[] = {"m", "mm", "cm", "in", "ft"};
    const double sizes[][3] = {{2, 1.9, 2.3}, {5, 4, 3}, {12, 30, 4.5}, {60, 140, 22}};
    int checked = 0;
    for (const char* unit : units)
        for (const char* up : {"y", "z"})
            for (const auto& size : sizes)
                for (const auto* layers : {&aia, &german}) {
                    const Reading reading{unit, up, unit, up, layers, size[0], size[1], size[2]};
                    EXPECT_EQ(questions_of(reading), std::vector<std::string>{}) << unit << ' ' << up << ' ' << size[0];
                    ++checked;
                }
    EXPECT_EQ(checked, 80);
}

std::filesystem::path host_models()
{
    const char* set = std::getenv("LIGHTWELL_SHARED");
    return std::filesystem::path(set ? set : LIGHTWELL_ROOT "/../shared") / "fixtures/hosts";
}

std::vector<std::string> asked_about(const char* name, const std::string& unit, const std::string& up)
{
    ImportOptions options;
    options.up = up;
    if (!unit.empty())
        options.metres_per_unit = parse_unit(unit).value;
    const Imported imported = import_file(host_models() / name, options);
    std::vector<std::string> texts;
    for (const Note& note : imported.report.notes())
        if (note.finding == Finding::question)
            texts.push_back(note.text);
    return texts;
}

/// Buildings drawn in Blender and FreeCAD, in their own units and with their own axes.
TEST(Questions, RealBuildingsReadRightRaiseNone)
{
    if (!std::filesystem::exists(host_models()))
        GTEST_SKIP() << "no models beside the repository";
    const std::pair<const char*, const char*> models[] = {{"blender_office/office.dxf", ""},
                                                          {"blender_office/office.obj", "z"},
                                                          {"blender_office/office.glb", ""},
                                                          {"blender_office/office.gltf", ""},
                                                          {"blender_office/office_applied.glb", ""},
                                                          {"blender_office/office_legacy.obj", "z"},
                                                          {"blender_office/office_yup_applied.obj", "y"},
                                                          {"freecad_building/building.dxf", ""},
                                                          {"freecad_building/building.obj", ""},
                                                          {"freecad_building/building.glb", ""},
                                                          {"freecad_building/building.gltf", ""}};
    for (const auto& [name, up] : models)
        EXPECT_EQ(asked_about(name, "", up), std::vector<std::string>{}) << name;
}

TEST(Questions, RealBuildingsReadInAWrongUnitOrWithAWrongAxisAreQuestioned)
{
    if (!std::filesystem::exists(host_models()))
        GTEST_SKIP() << "no models beside the repository";
    for (const char* unit : {"mm", "km", "cm"})
        EXPECT_FALSE(asked_about("blender_office/office.glb", unit, "").empty()) << unit;
    EXPECT_FALSE(asked_about("blender_office/office.glb", "", "z").empty()) << "a y-up model read as z-up";
    EXPECT_FALSE(asked_about("blender_office/office.obj", "", "y").empty()) << "a z-up model read as y-up";
    EXPECT_FALSE(asked_about("freecad_building/building.obj", "m", "").empty()) << "millimetres read as metres";
}

} // namespace
} // namespace lightwell
