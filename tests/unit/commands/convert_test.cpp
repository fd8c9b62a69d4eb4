#include "engine/base/vector.h"
#include "tests/unit/commands/command_run.h"

#include <gtest/gtest.h>

/// \file Commands that turn other files into scene text: what cannot be turned is said, and nothing is half written.
namespace lightwell::commands {
namespace {

std::string photometric_file(const std::string& sizes, const std::string& label = "[TEST] x\n")
{
    return "IESNA:LM-63-2002\n" + label + "TILT=NONE\n1 1000 1 3 1 1 2 " + sizes + "\n1 1 10\n0 45 90\n0\n358 179 0\n";
}

double first_number_of(const std::string& text, const std::string& behind)
{
    const std::size_t at = text.find(behind);
    return at == std::string::npos ? 0 : std::stod(text.substr(at + behind.size()));
}

TEST(Ies2rad, TheLightOfALampIsItsTableInAnyUnits)
{
    const WorkFolder folder;
    folder.write("a.ies", photometric_file("0.2 0.4 0"));
    for (const char* line : {"ies2rad -o lamp a.ies", "ies2rad -dc -o lamp a.ies", "ies2rad -di/12 -o lamp a.ies"}) {
        const Ran ran = run(std::string(line));
        ASSERT_EQ(ran.status, 0) << ran.err;
        // Radiance times area is intensity: (cd / 179) / area, whatever the units of the text.
        EXPECT_DOUBLE_EQ(first_number_of(WorkFolder::read("lamp.rad"), "src_theta \n0\n1 "), 12.5) << line;
        EXPECT_EQ(difference(WorkFolder::read("lamp.dat"), "1 0 90 3 2 1 0", 1e-6, 0), "");
    }
    ASSERT_EQ(run("ies2rad -i 0.1 -m 0.5 -c 1 0.5 0.25 -o ball a.ies").status, 0);
    const std::string ball = WorkFolder::read("ball.rad");
    EXPECT_NEAR(first_number_of(ball, "src_theta \n0\n1 "), 0.5 / (pi * 0.01), 1e-4);
    EXPECT_NE(ball.find("'ball_dist' illum 'ball_light'\n0\n0\n3 1 0.5 0.25"), std::string::npos);
    EXPECT_NE(run("ies2rad -s -o ball a.ies").out.find("'ball_light' polygon 'ball.d'"), std::string::npos);
}

TEST(Ies2rad, ATableOfLampsGivesColourAndDepreciation)
{
    const WorkFolder folder;
    folder.write("a.ies", photometric_file("0.2 0.4 0", "[LAMP] 2 green tubes\n"));
    folder.write("lamp.tab", "# own\n/\\<green\\>/ .25 .5 .8\n/grass/ (green)\n/loop/ (loop)\n");
    const Ran ran = run("ies2rad -f lamp.tab -o lamp a.ies");
    EXPECT_EQ(ran.err, "");
    const std::string text = WorkFolder::read("lamp.rad");
    EXPECT_NE(text.find("# CIE(x,y) = (0.250000,0.500000)\n# Depreciation = 80.0%\n"), std::string::npos) << text;
    // Chromaticity .25 .5 with Y = 0.8 in the primaries of the program, no component below 0.
    EXPECT_NE(text.find("light 'lamp_light'\n0\n0\n3 0 1.19131 0.299224\n"), std::string::npos) << text;
    EXPECT_EQ(run("ies2rad -f lamp.tab -t grass -o lamp a.ies").err, "");
    EXPECT_EQ(run("ies2rad -f lamp.tab -t loop -o lamp a.ies").err, "loop: warning - unknown lamp type\n");
    EXPECT_EQ(run("ies2rad -f gone.tab -o lamp a.ies").err, "gone.tab: warning - no lamp data\n");
    folder.write("bad.tab", "/(/ .3 .3 1\n");
    EXPECT_EQ(run("ies2rad -f bad.tab -o lamp a.ies").err, "ies2rad: fatal - bad.tab:1: \"(\" is no pattern\n");
    folder.write("bad.tab", "/x/ .3 nan 1\n");
    EXPECT_EQ(run("ies2rad -f bad.tab -o lamp a.ies").status, 1);
}

TEST(Ies2rad, WhatIsWrongIsSaidAndNothingIsWritten)
{
    const WorkFolder folder;
    folder.write("a.ies", photometric_file("0.2 0.4 0"));
    folder.write("text.ies", "no photometry\n");
    folder.write("line.ies", photometric_file("0 0.4 0"));
    folder.write("cut.ies", photometric_file("0.2 0.4 0").substr(0, 70));
    folder.write("nan.ies", photometric_file("0.2 nan 0"));
    folder.write("many.ies", "TILT=NONE\n1 1 1 99999999 99999999 1 1 1 1 0\n1 1 1\n");
    folder.write("tilt.ies", "TILT=gone.tlt\n1 1000 1 2 1 1 2 1 1 0\n1 1 1\n0 90\n0\n1 1\n");
    const std::pair<const char*, const char*> cases[] = {
        {"ies2rad", "missing output file specification"},
        {"ies2rad -o x a.ies a.ies", "single input file required"},
        {"ies2rad -dq a.ies", "bad option: -dq"},
        {"ies2rad -dm/0 -o x a.ies", "bad option: -dm/0"},
        {"ies2rad -m x -o x a.ies", "bad number in option -m: \"x\""},
        {"ies2rad -i -1 -o x a.ies", "bad number in option -i: \"-1\""},
        {"ies2rad -o", "missing argument of option: -o"},
        {"ies2rad -o x gone.ies", "gone.ies: No such file or directory"},
        {"ies2rad -o x text.ies", "text.ies: not in IES format"},
        {"ies2rad -t default -o x line.ies", "dosource: illegal source dimensions"},
        {"ies2rad -o x cut.ies", "cut.ies:6: the file ends before a vertical angle"},
        {"ies2rad -o x nan.ies", "nan.ies:4: the length is \"nan\", expected a number"},
        {"ies2rad -o x many.ies", "many.ies:2: the number of vertical angles is 99999999"},
        {"ies2rad -t default -o x tilt.ies", "gone.tlt: No such file or directory"}};
    for (const auto& [line, message] : cases) {
        const Ran ran = run(std::string(line));
        EXPECT_EQ(ran.status, 1) << line;
        EXPECT_EQ(ran.err.rfind(std::string("ies2rad: fatal - ") + message, 0), 0u) << line << ": " << ran.err;
        EXPECT_FALSE(std::filesystem::exists("x.rad") || std::filesystem::exists("x.dat")) << line;
    }
}

} // namespace
} // namespace lightwell::commands
