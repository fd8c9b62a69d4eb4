#include "plugins/insight/tradeoff.h"

#include "engine/base/errors.h"
#include "plugins/insight/child_run.h"
#include "plugins/insight/peers.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace lightwell {
namespace {

TEST(ErrorFigures, AreThoseOfSmallNumbersByHand)
{
    const ErrorFigures e = error_figures({11, 18, 30, 40}, {10, 20, 30, 40});
    EXPECT_NEAR(e.rms, std::sqrt((0.01 + 0.01) / 4), 1e-12);
    EXPECT_NEAR(e.mean_bias, 0, 1e-12);
    EXPECT_NEAR(e.maximum, 0.1, 1e-12);
    EXPECT_NEAR(e.percentile_95, 0.1, 1e-12);
}

TEST(ErrorFigures, DarkItemsAreHeldAgainstAShareOfTheMean)
{
    const ErrorFigures e = error_figures({100, 0.1}, {100, 0});
    EXPECT_NEAR(e.maximum, 0.1 / (1e-3 * 50), 1e-9);
    EXPECT_EQ(error_figures({}, {}).rms, 0);
    EXPECT_THROW(error_figures({1}, {}), std::invalid_argument);
}

TEST(Tradeoff, ChoosesTheCheapestSettingOfItsOwnThatReachedTheError)
{
    Tradeoff t;
    const auto add = [&](const char* program, const char* without, double cpu, double rms) {
        TradePoint p;
        p.program = program;
        p.without = without;
        p.cpu_s = cpu;
        p.error.rms = rms;
        t.points.push_back(p);
    };
    add("Lightwell", "", 1, 0.08);
    add("Lightwell", "", 2, 0.04);
    add("Lightwell", "cache", 0.5, 0.04);
    add("Radiance rtrace", "", 0.1, 0.001);
    add("Lightwell", "", 9, 0.009);
    choose_settings(t);
    EXPECT_EQ(t.points[0].chosen_for, std::vector<double>{0.1});
    EXPECT_EQ(t.points[1].chosen_for, std::vector<double>{0.05});
    EXPECT_EQ(t.points[4].chosen_for, (std::vector<double>{0.01, 0.03}));
    EXPECT_TRUE(t.points[2].chosen_for.empty());
    EXPECT_TRUE(t.points[3].chosen_for.empty());
}

Scene small_room()
{
    Scene scene;
    const ModifierId wall = scene.add_material("wall", Plastic{{0.5, 0.5, 0.5}, 0, 0});
    scene.root.add_sphere({{0, 0, 0}, 2}, Shape::bubble, wall, "wall");
    scene.root.add_sphere({{0, 0, 1}, 0.2}, Shape::sphere, scene.add_material("lamp", Light{{10, 10, 10}}), "lamp");
    return scene;
}

TEST(Tradeoff, RunsSettingsAndTechniquesAgainstAReferenceThatStatesItsError)
{
    SensorGrid grid;
    for (int i = 0; i < 5; ++i)
        grid.sensors.push_back({{0.2 * i, 0, -1}, {0, 0, 1}});
    TradeSettings settings;
    settings.reference_cpu_s = 0.5;
    settings.accuracies = {0.1, 0.02};
    settings.peers = false;
    const Tradeoff t = measure_tradeoff(small_room(), grid, settings);
    EXPECT_GT(t.reference.residual, 0);
    EXPECT_LT(t.reference.residual, 0.05);
    ASSERT_GT(t.points.size(), 8u);
    EXPECT_EQ(t.points[0].setting, "10 %");
    EXPECT_LT(t.points[0].error.rms, 0.3);
    EXPECT_LT(t.points[1].error.rms, 0.08 + 3 * t.reference.residual);
    const std::string csv = tradeoff_csv(t);
    EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')), t.points.size() + 2);
    EXPECT_NE(chart_svg(tradeoff_chart(t, "room")).find("CPU time (s)"), std::string::npos);
}

std::filesystem::path peer_file(const std::string& text)
{
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "peer_runs_test.csv";
    std::ofstream(file) << text;
    return file;
}

TEST(PeerRuns, OfAFileStandBesideOurOwn)
{
    const auto runs =
        read_peer_runs(peer_file("# program,setting\nCycles,16,1.5,0.75,10,20\n\nCycles,32,3,1.5,11, 21\n"), 2);
    ASSERT_EQ(runs.size(), 2u);
    EXPECT_EQ(runs[0].program, "Cycles");
    EXPECT_EQ(runs[1].setting, "32");
    EXPECT_EQ(runs[0].cpu_s, 1.5);
    EXPECT_EQ(runs[1].values, (std::vector<double>{11, 21}));

    SensorGrid grid;
    grid.sensors.push_back({{0, 0, -1}, {0, 0, 1}});
    TradeSettings settings;
    settings.reference_cpu_s = 0.1;
    settings.accuracies = {0.1};
    settings.peers = false;
    settings.peer_file = peer_file("Cycles,16,1.5,0.75,0\n");
    const Tradeoff t = measure_tradeoff(small_room(), grid, settings);
    EXPECT_EQ(t.points.back().program, "Cycles");
    EXPECT_NEAR(t.points.back().error.rms, 1, 1e-12); // black, where light is
    EXPECT_EQ(t.points.back().cpu_s, 1.5);
}

TEST(PeerRuns, ThatDoNotFitAreRefusedWithTheirLine)
{
    for (const char* text : {"", "# nothing\n", "Cycles,16,1,1,10\n", "Cycles,16,1,1,10,20,30\n", "Cycles\n",
                             "Cycles,16,1,1,10,bright\n", "Cycles,16,1,1,10,nan\n", "Cycles,16,-1,1,10,20\n"})
        EXPECT_THROW(read_peer_runs(peer_file(text), 2), InputError) << text;
    EXPECT_THROW(read_peer_runs("/no/such/file", 2), InputError);
    try {
        read_peer_runs(peer_file("# first\nCycles,16,1,1,10\n"), 2);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("peer_runs_test.csv:2: has 1 values"), std::string::npos)
            << error.what();
    }
}

TEST(Tradeoff, ASceneWithoutLightSaysSo)
{
    Scene dark;
    dark.root.add_sphere({{0, 0, 0}, 2}, Shape::bubble, dark.add_material("wall", Plastic{{0.5, 0.5, 0.5}, 0, 0}), "w");
    SensorGrid grid;
    grid.sensors = {{{0, 0, 0}, {0, 0, 1}}};
    TradeSettings settings;
    settings.reference_cpu_s = 0.1;
    EXPECT_THROW(measure_tradeoff(dark, grid, settings), InputError);
}

TEST(ChildRun, TellsTheEndTheOutputAndAProgramThatIsNotThere)
{
    const std::filesystem::path out = std::filesystem::path(testing::TempDir()) / "child_run_test.txt";
    EXPECT_EQ(run_child({"sh", "-c", "echo light; exit 3"}, {}, out, 10).status, 3);
    std::string word;
    std::ifstream(out) >> word;
    EXPECT_EQ(word, "light");
    const ChildResult telling =
        run_child({"sh", "-c", "echo first >&2; echo 'no room: 7' >&2; kill -9 $$"}, {}, out, 10);
    EXPECT_EQ(telling.status, -9);
    EXPECT_FALSE(telling.timed_out);
    EXPECT_EQ(telling.last_words, "no room: 7");
    EXPECT_EQ(run_child({"/no/such/program"}, {}, out, 10).status, 127);
    const ChildResult endless = run_child({"sh", "-c", "while :; do :; done"}, {}, out, 0.5);
    EXPECT_TRUE(endless.timed_out);
    EXPECT_FALSE(program_on_path("sh").empty());
    EXPECT_TRUE(program_on_path("no-such-program-here").empty());
}

} // namespace
} // namespace lightwell
