#include "tests/unit/radiance/scene_folder.h"

#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

namespace lightwell {
namespace {

TEST(SceneFixtures, TheRoomHasTheTypesAreasBoundsAndNotesOfItsTruth)
{
    const std::filesystem::path folder = LIGHTWELL_ROOT "/tests/fixtures/radiance";
    const auto truth = nlohmann::json::parse(std::ifstream(folder / "room.rad.truth.json"));
    Report report;
    const Scene scene = read_radiance(folder / "room.rad", report);
    validate(scene);
    const char* const names[] = {"polygon", "sphere", "bubble", "cone", "cup", "cylinder", "tube", "ring", "source"};
    std::map<std::string, int> types;
    std::map<std::string, double> areas;
    visit_expanded(scene, [&](const Part& part, const Surface& surface, const Affine&, ModifierId modifier) {
        ++types[names[static_cast<std::size_t>(surface.shape)]];
        areas[scene.modifiers[static_cast<std::size_t>(modifier)].name] += surface_area_m2(part, surface);
    });
    EXPECT_EQ(expanded_count(scene), truth["surfaces"].get<std::size_t>());
    for (const auto& [type, count] : truth["types"].items())
        EXPECT_EQ(types[type], count.get<int>()) << type;
    for (const auto& [layer, area] : truth["area_m2"].items())
        EXPECT_NEAR(areas[layer], area.get<double>(), 1e-9) << layer;
    const Box box = bounds(scene);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(box.low[axis], truth["bounds_low"][axis].get<double>(), 1e-9) << axis;
        EXPECT_NEAR(box.high[axis], truth["bounds_high"][axis].get<double>(), 1e-9) << axis;
    }
    ASSERT_EQ(report.notes().size(), truth["notes"].size());
    for (std::size_t i = 0; i < report.notes().size(); ++i) {
        const auto& note = truth["notes"][i];
        const std::string place =
            "room.rad:" + std::to_string(note["line"].get<int>()) + ": " + note["type"].get<std::string>();
        EXPECT_NE(report.notes()[i].place.find(place), std::string::npos) << report.notes()[i].place;
        EXPECT_EQ(to_string(report.notes()[i].finding), note["finding"].get<std::string>());
    }
    EXPECT_EQ(scene.root.name, truth["part"].get<std::string>());
    ASSERT_EQ(scene.views.size(), 1u);
    EXPECT_EQ(scene.views[0].name, truth["view"]["name"].get<std::string>());
    EXPECT_EQ(scene.views[0].horizontal, truth["view"]["horizontal"].get<double>());
}

TEST(SceneFixtures, TheCornellBoxHasTheSurfacesAndAreasOfItsGroundTruth)
{
    const std::filesystem::path folder = shared_data() / "fixtures/radiance";
    if (!std::filesystem::exists(folder / "MANIFEST.json"))
        GTEST_SKIP() << "the scenes are not here";
    const auto manifest = nlohmann::json::parse(std::ifstream(folder / "MANIFEST.json"));
    int checked = 0;
    for (const auto& entry : manifest["entries"])
        for (const auto& file : entry["files"]) {
            const std::string name = file["file"];
            if (!file.contains("ground_truth") || !name.starts_with("cornell_box/"))
                continue;
            SCOPED_TRACE(name);
            Report report;
            const Scene scene = read_radiance(folder / name, report);
            validate(scene);
            std::map<std::string, double> areas;
            for (const Surface& surface : scene.root.surfaces)
                if (surface.shape == Shape::polygon)
                    areas[scene.modifiers[static_cast<std::size_t>(surface.modifier)].name] +=
                        surface_area_m2(scene.root, surface);
            for (const auto& [modifier, area] : file["ground_truth"]["polygon_area_per_modifier"].items())
                EXPECT_NEAR(areas[modifier], area.get<double>(), 1e-6) << modifier;
            ++checked;
        }
    EXPECT_GE(checked, 1);
}

TEST(SceneFixtures, EverySceneLoadsOrSaysExactlyWhatIsMissing)
{
    const std::filesystem::path folder = shared_data() / "fixtures/radiance";
    if (!std::filesystem::is_directory(folder))
        GTEST_SKIP() << "the scenes are not here";
    int read = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.path().extension() != ".rad" && entry.path().extension() != ".mat")
            continue;
        Report report;
        try {
            validate(read_radiance(entry.path(), report));
            ++read;
        } catch (const InputError& error) {
            const std::string message = error.what();
            // Each is one of: a name that another file defines, a command, or a type that is named.
            const bool clear = message.find("is not defined above") != std::string::npos ||
                               message.find("not answered here") != std::string::npos ||
                               message.find("not modelled yet") != std::string::npos ||
                               message.find("is not found") != std::string::npos ||
                               message.find("the command uses") != std::string::npos;
            EXPECT_TRUE(clear) << message;
        }
    }
    EXPECT_GT(read, 30);
}

TEST(SceneFixtures, TheSkiesOfGenskyAndGendaylitAreRead)
{
    const std::filesystem::path record = shared_data() / "reference/sky-programs.json";
    if (!std::filesystem::exists(record))
        GTEST_SKIP() << "the records of the original programs are not here";
    const auto data = nlohmann::json::parse(std::ifstream(record));
    const SceneFolder folder;
    int skies = 0;
    for (const auto& sample : data["cases"]) {
        if (sample["exit_status"] != 0)
            continue;
        SCOPED_TRACE(sample["id"].get<std::string>());
        const std::string text = sample["output"];
        const bool has_sky = text.find("brightfunc skyfunc") != std::string::npos;
        const std::string use = "skyfunc glow g 0 0 4 1 1 1 0\ng source s 0 0 4 0 0 1 180\n";
        // Without a sky, gendaylit prints numbers that are no scene.
        if (has_sky || sample["program"] == "gensky") {
            EXPECT_EQ(folder.error(text + (has_sky ? use : "")), "");
        }
        skies += has_sky ? 1 : 0;
    }
    EXPECT_EQ(skies, 98);
}

TEST(SceneFixtures, AForestOfTwoHundredMillionNeedlesIsAFewNestedInstances)
{
    const std::filesystem::path script = shared_data() / "reference/yardstick/scenes/f_forest.py";
    if (!std::filesystem::exists(script) || !std::filesystem::exists("/usr/bin/python3"))
        GTEST_SKIP() << "the script that makes the forest is not here";
    const SceneFolder folder;
    const std::string command =
        "/usr/bin/python3 -B " + script.string() + " " + folder.path("").string() + " > /dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0);
    rusage before{}, after{};
    getrusage(RUSAGE_SELF, &before);
    Report report;
    const Scene scene = read_radiance(folder.path("forest.rad"), report);
    validate(scene);
    getrusage(RUSAGE_SELF, &after);
    ASSERT_EQ(scene.prototypes.size(), 4u);
    EXPECT_EQ(scene.prototypes[0].name, "needle");
    EXPECT_EQ(scene.prototypes[3].name, "stand");
    // 150 needles x 60 sprays x 90 branches x 30 trees x 9 stands, a twig a branch, a trunk a tree, and 10 of
    // forest.rad
    const std::size_t needles = 150ul * 60 * 90 * 30 * 9;
    EXPECT_EQ(needles, 218'700'000u);
    EXPECT_EQ(expanded_count(scene), needles + 90 * 30 * 9 + 30 * 9 + 10);
    EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 8 * 1024) << "kB";
}

} // namespace
} // namespace lightwell
