#include "engine/base/vector.h"
#include "tests/unit/commands/command_run.h"

#include <gtest/gtest.h>

/// \file rtrace and rpict against closed forms, in the forms in which other programs call them.
namespace lightwell::commands {
namespace {

std::vector<double> numbers_of(const std::string& text)
{
    std::vector<double> numbers;
    std::istringstream in(text);
    for (double number; in >> number;)
        numbers.push_back(number);
    return numbers;
}

/// A lamp of 0.1 m radius 2 m above a grey floor.
void make_scene(const WorkFolder& folder)
{
    folder.write("lamp.rad", "void light l 0 0 3 100 50 25\nl sphere s 0 0 4 0 0 2 .1\n"
                             "void plastic grey 0 0 5 .5 .5 .5 0 0\n"
                             "grey polygon floor 0 0 12 -20 -20 0 20 -20 0 20 20 0 -20 20 0\n");
    std::ofstream("lamp.oct", std::ios::binary) << run("oconv -f lamp.rad").out;
}

TEST(Rtrace, ASensorUnderASphereHasItsIrradiance)
{
    const WorkFolder folder;
    make_scene(folder);
    // A sphere that fills a cone: E = pi L (r / d)^2, in each channel.
    const Ran ran = run("rtrace -I -h -ab 0 lamp.oct", "0 0 0.001 0 0 1\n");
    ASSERT_EQ(ran.status, 0) << ran.err;
    const std::vector<double> found = numbers_of(ran.out);
    ASSERT_EQ(found.size(), 3u);
    const double per_radiance = pi * 0.01 / (1.999 * 1.999);
    EXPECT_NEAR(found[0], 100 * per_radiance, 0.01 * 100 * per_radiance);
    EXPECT_NEAR(found[2], 25 * per_radiance, 0.01 * 25 * per_radiance);
    EXPECT_EQ(ran.out.back(), '\n');
    EXPECT_EQ(std::count(ran.out.begin(), ran.out.end(), '\t'), 3);
}

TEST(Rtrace, RaysSeeLampAndFloorWithTheirNames)
{
    const WorkFolder folder;
    make_scene(folder);
    const Ran ran = run("rtrace -h -ab 1 -oovs lamp.oct", "0 0 1 0 0 1\n0 0 1 0 0 -1\n5 5 5 0 0 1\n0 0 0 0 0 0\n");
    ASSERT_EQ(ran.status, 0) << ran.err;
    std::istringstream lines(ran.out);
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(difference(line, "0 0 1 100 50 25 s", 1e-5, 0), "");
    std::getline(lines, line);
    // The floor below the lamp: 0.5 / pi of pi L (r / d)^2.
    const double floor = 0.5 * 0.01 / 4;
    std::ostringstream expected;
    expected << "0 0 1 " << 100 * floor << ' ' << 50 * floor << ' ' << 25 * floor << " floor";
    EXPECT_EQ(difference(line, expected.str(), 0.02, 0), "");
    std::getline(lines, line);
    EXPECT_EQ(difference(line, "5 5 5 0 0 0 *", 0, 0), "");
    EXPECT_EQ(run("rtrace -h -faf -ov lamp.oct", "0 0 1 0 0 1\n").out.size(), 12u);
    EXPECT_EQ(run("rtrace -h -fac lamp.oct", "0 0 1 0 0 1\n").out.size(), 4u);
    EXPECT_NE(run("rtrace -ffd lamp.oct").out.find("NCOMP=3\nBigEndian=0\nFORMAT=double\n\n"), std::string::npos);
}

TEST(Rtrace, TheFormsThatOtherProgramsUseAreTaken)
{
    const WorkFolder folder;
    make_scene(folder);
    const std::string point = "0 0 0.001 0 0 1\n";
    for (const char* line :
         {"rtrace -I -h -ab 1 -ad 64 -as 32 -ar 16 -aa .25 -lw .05 -lr 4 -dt .5 -dc .25 -dj 0 -dr 0 -dp 64 -ds .5 -ss "
          "0 -st "
          "0.85 -n 1 -w -x 1 -y 1 lamp.oct",
          "rtrace -n 2 -w -ab 1 -aa .25 -faa -h -ov -I lamp.oct",
          "rtrace -i -ab 1 -aa .08 -ar 512 -ad 64 -as 512 -h -oovs lamp.oct", "rtrace -I+ -h -ab 0 -u+ lamp.oct",
          "rtrace -I -h -ab 0 -av .1 .1 .1 -e log.txt lamp.oct", "rtrace -h -ab 0 -on lamp.oct"}) {
        const Ran ran = run(std::string(line), point);
        EXPECT_EQ(ran.status, 0) << line << ": " << ran.err;
        EXPECT_EQ(std::count(ran.out.begin(), ran.out.end(), '\n'), 1) << line;
    }
}

TEST(Rtrace, BadWordsAndRaysAreRefused)
{
    const WorkFolder folder;
    make_scene(folder);
    const std::pair<const char*, const char*> cases[] = {
        {"rtrace -q lamp.oct", "rtrace: fatal - command line error at '-q'"},
        {"rtrace -oz lamp.oct", "rtrace: fatal - unrecognized output option 'z'"},
        {"rtrace gone.oct", "rtrace: fatal - cannot find octree \"gone.oct\""},
        {"rtrace -ab x lamp.oct", "rtrace: fatal - command line error at '-ab'"},
        {"rtrace", "rtrace: fatal - missing octree argument"},
        {"rtrace -w -h lamp.oct", "rtrace: fatal - bad number on standard input: \"x\""}};
    for (const auto& [line, message] : cases) {
        const Ran ran = run(std::string(line), "x y z\n");
        EXPECT_NE(ran.status, 0) << line;
        EXPECT_EQ(ran.err.rfind(message, 0), 0u) << line << ": " << ran.err;
    }
    EXPECT_EQ(run("rtrace -h lamp.oct", "0 0 1 0 0").status, 1); // ends within a ray
}

TEST(Rtrace, WithoutBouncesTheAmbientValueIsAllThatReachesHiddenSurfaces)
{
    const WorkFolder folder;
    folder.write("table.rad", "void light l 0 0 3 100 100 100\nl sphere s 0 0 4 0 0 2 .1\n"
                              "void plastic grey 0 0 5 .5 .5 .5 0 0\n"
                              "grey polygon floor 0 0 12 -20 -20 0 20 -20 0 20 20 0 -20 20 0\n"
                              "grey polygon table 0 0 12 -1 -1 1 1 -1 1 1 1 1 -1 1 1\n");
    std::ofstream("table.oct", std::ios::binary) << run("oconv -f table.rad").out;
    const std::string underside = "0 0 .5 0 0 1\n", floor = "5 0 1 0 0 -1\n";
    const auto seen = [](const std::string& line, const std::string& rays) {
        return numbers_of(run(line, rays).out).at(0);
    };
    EXPECT_DOUBLE_EQ(seen("rtrace -h -ab 0 table.oct", underside), 0);
    EXPECT_NEAR(seen("rtrace -h -ab 0 -av .2 .2 .2 table.oct", underside), 0.1, 1e-6);
    EXPECT_NEAR(seen("rtrace -h -i -ab 0 -av .2 .2 .2 table.oct", underside), 0.2 * pi, 1e-5);
    const double of_av =
        seen("rtrace -h -ab 0 -av .2 .2 .2 table.oct", floor) - seen("rtrace -h -ab 0 table.oct", floor);
    EXPECT_NEAR(of_av, 0.1, 2e-3);
    // One bounce, by plain path tracing, brings light from the floor, and two no less.
    const double once = seen("rtrace -h -ab 1 -aa 0 table.oct", underside);
    EXPECT_GT(once, 0);
    EXPECT_GT(seen("rtrace -h -ab 3 -aa 0 table.oct", underside), 0.9 * once);
}

TEST(Rpict, APictureHasItsHistoryItsViewAndItsLight)
{
    const WorkFolder folder;
    make_scene(folder);
    const std::string compiled = WorkFolder::read("lamp.oct");
    const Ran ran = run("rpict -vp 0 0 1 -vd 0 0 -1 -vu 0 1 0 -vh 20 -vv 20 -x 8 -y 6 -ab 0 -t 1 -e log.txt", compiled);
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_EQ(ran.out.rfind("#?RADIANCE\noconv -f lamp.rad\nrpict -vp 0 0 1", 0), 0u) << ran.out.substr(0, 200);
    EXPECT_NE(ran.out.find("\nVIEW= -vtv -vp 0 0 1"), std::string::npos);
    EXPECT_NE(ran.out.find("-Y 6 +X 6\n"), std::string::npos); // square pixels of a square view
    const std::vector<double> pixels = numbers_of(run("pvalue -h -H -d", ran.out).out);
    ASSERT_EQ(pixels.size(), 6u * 6 * 3);
    EXPECT_NEAR(pixels[3 * 21], 100 * 0.5 * 0.01 / 4, 0.02);
    const std::string log = WorkFolder::read("log.txt");
    EXPECT_NE(log.find("% after "), std::string::npos) << log;
    EXPECT_NE(log.find("hours on "), std::string::npos);
    const Ran bad = run("rpict -vd 0 0 1 -e bad.txt lamp.oct");
    EXPECT_EQ(bad.status, 1);
    EXPECT_NE(WorkFolder::read("bad.txt").find("rpict: fatal - view up parallel to view direction"), std::string::npos);
}

} // namespace
} // namespace lightwell::commands
