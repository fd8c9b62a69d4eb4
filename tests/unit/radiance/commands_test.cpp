#include "tests/unit/radiance/scene_folder.h"

#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>

namespace lightwell {
namespace {

const std::string red = "void plastic red\n0\n0\n5 .7 .1 .1 0 0\n";

/// Surfaces of scene text that uses no commands: type, name and numbers, read word by word.
std::vector<std::pair<std::string, std::vector<double>>> plain_surfaces(const std::string& text)
{
    std::istringstream in(text);
    std::vector<std::pair<std::string, std::vector<double>>> list;
    std::string modifier;
    while (in >> modifier) {
        if (modifier[0] == '#') {
            std::getline(in, modifier);
            continue;
        }
        std::string type, name, word;
        in >> type >> name;
        if (type == "alias") {
            in >> word;
            continue;
        }
        std::size_t count = 0;
        for (int list_number = 0; list_number < 2; ++list_number)
            for (in >> count; count > 0; --count)
                in >> word;
        std::vector<double> numbers;
        for (in >> count; count > 0; --count) {
            in >> word;
            numbers.push_back(std::strtod(word.c_str(), nullptr));
        }
        for (const char* surface : {"polygon", "sphere", "bubble", "cone", "cup", "cylinder", "tube", "ring", "source"})
            if (type == surface)
                list.emplace_back(name, std::move(numbers));
    }
    return list;
}

void replace_all(std::string& text, const std::string& from, const std::string& to)
{
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
}

/// Directions are kept at unit length, and cylinders have two equal radii in memory.
std::vector<double> as_in_text(const WorldSurface& surface)
{
    std::vector<double> numbers = surface.numbers;
    const auto shape = static_cast<Shape>(std::stoi(surface.type));
    if (shape == Shape::cylinder || shape == Shape::tube)
        numbers.pop_back();
    return numbers;
}

/// The numbers of a surface beside those of the text; directions there need not be unit vectors.
void expect_same_numbers(const WorldSurface& surface, const std::string& name, const std::vector<double>& numbers)
{
    const std::vector<double> ours = as_in_text(surface);
    ASSERT_EQ(ours.size(), numbers.size()) << name;
    const auto shape = static_cast<Shape>(std::stoi(surface.type));
    const std::size_t first = shape == Shape::ring ? 3 : shape == Shape::source ? 0 : numbers.size();
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const double unit =
            i >= first && i < first + 3 ? std::hypot(numbers[first], numbers[first + 1], numbers[first + 2]) : 1;
        EXPECT_NEAR(ours[i], numbers[i] / unit, 1e-6 * std::fmax(1, std::fabs(numbers[i]))) << name << ' ' << i;
    }
}

TEST(SceneCommands, TransformsAgreeWithTheRecordsOfTheOriginalProgram)
{
    const std::filesystem::path record = shared_data() / "reference/xform-calls.json";
    if (!std::filesystem::exists(record))
        GTEST_SKIP() << "the records of the original program are not here";
    const auto data = nlohmann::json::parse(std::ifstream(record));
    const SceneFolder folder;
    for (const auto& [name, content] : data["files"].items()) {
        std::string text = content;
        // Not modelled: anisotropic metal, mixtures; not there: the mesh. None of them changes a coordinate.
        replace_all(text, "waves metal2 brushed\n6 1 0 .2 . -rz 15\n0\n6 .8 .8 .7 .9 .05 .2",
                    "waves metal brushed\n0\n0\n5 .8 .8 .7 .9 .05");
        replace_all(text, "void mixfunc blend\n4 red striped Px*.5 .\n0\n0", "void alias blend red");
        replace_all(text, "red mesh pot\n5 vase.rtm -s .01 -rx 90\n0\n0\n", "");
        replace_all(text, "!genbox grey crate 1 2 .5\n", "");
        folder.write(name, text);
    }
    int compared = 0;
    for (const auto& sample : data["cases"]) {
        std::string command = "!xform", expected = sample["output"];
        bool skipped = false;
        for (const std::string word : sample["args"]) {
            command += " '" + word + "'";
            // A box from another program, and a name that the original program breaks in two.
            skipped |= word == "nested.rad" || word == "a b";
        }
        SCOPED_TRACE(command);
        const std::string other = "void plastic other 0 0 5 .1 .1 .1 0 0\n";
        if (sample["exit_status"] != 0) {
            EXPECT_FALSE(folder.error(command).empty());
            continue;
        }
        if (skipped)
            continue;
        const Scene scene = folder.read(other + command);
        std::vector<WorldSurface> found;
        for (WorldSurface& surface : world_surfaces(scene))
            if (surface.name != "face" || command.find("small.rad") == std::string::npos ||
                command.find("unit.rad") != std::string::npos)
                found.push_back(std::move(surface));
        const auto surfaces = plain_surfaces(expected);
        std::size_t next = 0;
        for (const auto& [name, numbers] : surfaces) {
            // The instance in small.rad is expanded by us and left as it is by the program.
            while (next < found.size() && found[next].name != name)
                ++next;
            ASSERT_LT(next, found.size()) << name;
            expect_same_numbers(found[next], name, numbers);
            ++next;
            ++compared;
        }
    }
    EXPECT_GT(compared, 150);
}

TEST(SceneCommands, AFileThatIsUsedTwiceIsHeldOnce)
{
    const SceneFolder folder;
    std::string chair = red;
    for (int i = 0; i < 40; ++i)
        chair += "red sphere s" + std::to_string(i) + " 0 0 4 " + std::to_string(i) + " 0 0 .3\n";
    folder.write("chair.rad", chair);
    const Scene scene = folder.read("!xform -n a -t 0 1 0 chair.rad\n!xform -n b -rz 90 chair.rad\n"
                                    "!xform -n row -a 100 -t 0 0 2 chair.rad\n");
    EXPECT_EQ(scene.prototypes.size(), 1u);
    EXPECT_EQ(scene.root.instances.size(), 102u);
    EXPECT_EQ(scene.root.surfaces[0].name, "a");
    EXPECT_EQ(scene.root.surfaces[101].name, "row.99");
    EXPECT_EQ(scene.modifiers.size(), 1u);
    EXPECT_EQ(expanded_count(scene), 102u * 40);
    EXPECT_EQ(scene.root.instances[101].to_parent.translation, (Vec3{0, 0, 198}));
}

TEST(SceneCommands, AnIncludedFileSeesTheNamesAroundItAndIsReadAgainWhenTheyChange)
{
    const SceneFolder folder;
    std::string balls;
    for (int i = 0; i < 20; ++i)
        balls += "paint sphere s" + std::to_string(i) + " 0 0 4 " + std::to_string(i) + " 0 0 .3\n";
    folder.write("balls.rad", balls);
    const Scene scene = folder.read("void plastic paint 0 0 5 .1 .1 .1 0 0\n!xform -t 0 1 0 balls.rad\n"
                                    "!xform -t 0 2 0 balls.rad\nvoid plastic paint 0 0 5 .9 .9 .9 0 0\n"
                                    "!xform -t 0 3 0 balls.rad\n");
    EXPECT_EQ(scene.prototypes.size(), 2u);
    const std::vector<WorldSurface> world = world_surfaces(scene);
    ASSERT_EQ(world.size(), 60u);
    EXPECT_EQ(world[0].material, world[39].material);
    EXPECT_NE(world[39].material, world[40].material);
}

TEST(SceneCommands, NamesThatAnIncludedFileDefinesAreKnownAfterwards)
{
    const SceneFolder folder;
    folder.write("paint.rad", "void plastic paint 0 0 5 .1 .1 .1 0 0\nvoid spotlight spot 0 0 7 1 1 1 20 0 0 -2\n");
    const Scene scene = folder.read("!xform paint.rad\n!xform -ry 90 -s 3 paint.rad\npaint sphere s 0 0 4 0 0 0 1\n"
                                    "spot sphere lamp 0 0 4 0 0 5 .1\n");
    const Material& lamp = *resolve(scene, scene.root.surfaces[1].modifier).material;
    // -ry 90 takes -z to -x; the focal distance grows with the scale.
    const Vec3 aim = std::get<Spotlight>(lamp).aim;
    EXPECT_NEAR(aim.x, -6, 1e-12);
    EXPECT_NEAR(aim.z, 0, 1e-12);
}

TEST(SceneCommands, AModifierGivenToXformReplacesThoseOfTheFile)
{
    const SceneFolder folder;
    std::string many = red + "void plastic blue 0 0 5 .1 .1 .7 0 0\n";
    for (int i = 0; i < 30; ++i)
        many += (i % 2 == 0 ? "red" : "blue") + std::string(" sphere s 0 0 4 0 0 0 1\n");
    folder.write("many.rad", many + "void instance in 1 many2.rad 0 0\n");
    folder.write("many2.rad", many);
    const Scene scene = folder.read("void metal gold 0 0 5 .8 .6 .2 .9 0\n!xform -m gold many.rad\n"
                                    "!xform -t 1 0 0 many.rad\ngold instance g 1 many2.rad 0 0\n");
    const std::vector<WorldSurface> world = world_surfaces(scene);
    ASSERT_EQ(world.size(), 150u);
    for (std::size_t i = 0; i < 60; ++i)
        EXPECT_EQ(world[i].modifier, "gold");
    EXPECT_EQ(world[60].modifier, "red");
    EXPECT_EQ(world[119].modifier, "blue");
    for (std::size_t i = 120; i < 150; ++i)
        EXPECT_EQ(world[i].modifier, "gold");
}

TEST(SceneCommands, AShapeWithoutAMaterialTakesTheOneOfItsTransform)
{
    const SceneFolder folder;
    folder.write("saucer.rad", "mat sphere s 0 0 4 0 0 0 1\n");
    folder.write("pair.rad", "!xform -t 3 0 0 saucer.rad\nmat sphere t 0 0 4 0 0 0 1\n");
    const std::string two = red + "void plastic blue 0 0 5 .1 .1 .7 0 0\n";
    const std::vector<WorldSurface> world = world_surfaces(
        folder.read(two + "!xform -m red saucer.rad\n!xform -m blue -t 0 0 2 saucer.rad\n!xform -m blue pair.rad\n"));
    ASSERT_EQ(world.size(), 4u);
    EXPECT_EQ(world[0].modifier, "red");
    for (std::size_t i = 1; i < 4; ++i)
        EXPECT_EQ(world[i].modifier, "blue");
    // Without one, before or after, it is not known what it is made of.
    const std::string known = two + "!xform -m red saucer.rad\n";
    EXPECT_NE(folder.error(known + "!xform -t 1 0 0 saucer.rad\n").find("modifier \"mat\" is not defined above"),
              std::string::npos);
    EXPECT_NE(folder.error(known + "mat sphere u 0 0 4 0 0 0 1\n").find("modifier \"mat\" is not defined above"),
              std::string::npos);
}

TEST(SceneCommands, ScalingChangesMaterialsThatKnowLengthsAndTurningTurnsSkies)
{
    const SceneFolder folder;
    folder.write("pane.rad", "void dielectric d 0 0 5 .25 .25 .25 1.5 0 void glow g 0 0 4 1 1 1 5\n"
                             "d sphere s 0 0 4 0 0 0 1 g sphere t 0 0 4 3 0 0 1\n");
    folder.write("sky.rad", "void brightfunc skyfunc 2 skybr skybright.cal 0 7 1 7 16 .4 1 0 1\n"
                            "skyfunc glow sky_glow 0 0 4 1 1 1 0 sky_glow source sky 0 0 4 0 0 1 180\n");
    const Scene scene = folder.read("!xform -s 2 pane.rad\n!xform -rz 90 sky.rad\n");
    const auto material = [&](std::size_t i) { return resolve(scene, scene.root.surfaces[i].modifier); };
    // A quarter left after 1 m is a half after half a metre: at twice the size, a half after each metre.
    EXPECT_DOUBLE_EQ(std::get<Dielectric>(*material(0).material).transmission_per_m.g, 0.5);
    EXPECT_EQ(std::get<Glow>(*material(1).material).max_radius_m, 10);
    const Direction sun = material(2).brightness->to_sun;
    EXPECT_NEAR(sun.x, 0, 1e-15);
    EXPECT_NEAR(sun.y, std::sqrt(0.5), 1e-15);
    EXPECT_NE(folder.error("!xform -rx 90 sky.rad").find("tilts a sky"), std::string::npos);
}

TEST(SceneCommands, FilesAreFoundBesideTheReferringFileAndOnRaypath)
{
    const SceneFolder folder;
    folder.write("sub/ball.rad", red + "red sphere ball 0 0 4 0 0 0 1");
    folder.write("sub/row.rad", "!xform ball.rad\n!xform -t 3 0 0 ball.rad\n");
    folder.write("library/lamp.rad", red + "red sphere lamp 0 0 4 0 0 0 2");
    setenv("RAYPATH", (".:" + folder.path("library").string()).c_str(), 1);
    const Scene scene = folder.read("!xform sub/row.rad\nvoid instance l 5 lamp.oct -t 0 0 9 0 0\n");
    unsetenv("RAYPATH");
    ASSERT_EQ(scene.root.surfaces.size(), 3u);
    EXPECT_EQ(scene.root.spheres[1].centre.x, 3);
    EXPECT_EQ(scene.prototypes[0].name, "lamp");
    EXPECT_EQ(scene.root.instances[0].to_parent.translation.z, 9);
}

TEST(SceneCommands, AHundredThousandNestedCopiesThatCannotBeSharedAreRefusedBeforeMemoryIsGone)
{
    const SceneFolder folder;
    folder.write("a.rad", "void spotlight s 0 0 7 1 1 1 20 0 0 -2\n!xform -a 300 -rz 1 b.rad\n");
    folder.write("b.rad", "!xform -a 300 -rz 1 c.rad\n");
    folder.write("c.rad", "!xform -a 3000 -rz 1 d.rad\n");
    folder.write("d.rad", "void spotlight s 0 0 7 1 1 1 20 0 0 -2\ns sphere x 0 0 4 0 0 0 1\n");
    EXPECT_NE(folder.error("!xform -rz 5 a.rad").find("the transforms copy more than"), std::string::npos);
}

} // namespace
} // namespace lightwell
