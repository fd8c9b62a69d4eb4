#include "tests/unit/commands/command_run.h"

#include <gtest/gtest.h>

#include <cstring>

/// \file rcalc, vwrays and pvalue.
namespace lightwell::commands {
namespace {

std::string floats(const std::vector<float>& values)
{
    std::string bytes(values.size() * sizeof(float), '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

TEST(Rcalc, ColumnsBecomeExpressions)
{
    EXPECT_EQ(run({"rcalc", "-e", "$1=$1*2;$2=$3+recno"}, "1 2 3\n4 5 6\n").out, "2\t4\n8\t8\n");
    EXPECT_EQ(run({"rcalc", "-n", "-e", "$1=PI"}).out, "3.14159265\n");
    EXPECT_EQ(run({"rcalc", "-e", "$1=in(0)+in(2)"}, "1 2\n3 4\n").out, "4\n6\n");
    EXPECT_EQ(run({"rcalc", "-e", "$2=5"}, "1 2 3\n").out, "\t5\n");
    EXPECT_EQ(run({"rcalc", "-t,", "-e", "$1=$2;$2=$1"}, "1,2\n").out, "2\t1\n");
    EXPECT_EQ(run({"rcalc", "-e", "$1=$1;cond=$1-2"}, "1\n3\n").out, "3\n");
    EXPECT_EQ(run({"rcalc", "-in", "1", "-e", "$1=$1"}, "1\n3\n").out, "1\n");
    // The line by which illuminance grids are made.
    EXPECT_EQ(run({"rcalc", "-e", "$1=(0.265*$1+0.67*$2+0.065*$3)*179"}, "1.0\t1.0\t1.0\t\n").out, "179\n");
}

TEST(Rcalc, BinaryRecordsPassUnrounded)
{
    EXPECT_EQ(run({"rcalc", "-if3", "-of", "-e", "$1=$2"}, floats({1, 2, 3, 4, 5, 6})).out, floats({2, 5}));
    EXPECT_EQ(run({"rcalc", "-of", "-e", "$1=$2"}, "1 2 3\n4 5 6").out, floats({2, 5}));
}

TEST(Rcalc, TemplatesHoldExpressions)
{
    EXPECT_EQ(run({"rcalc", "-o", "at ${$1*2 }!", "-e", "a=1"}, "3\n").out, "at        6!\n");
}

TEST(Rcalc, BadExpressionsAreRefused)
{
    for (const char* expression : {"$1=foo($1)", "$1=$1+", "$1=(2"})
        EXPECT_EQ(run({"rcalc", "-e", expression}, "1\n").status, 1) << expression;
    EXPECT_EQ(run("rcalc -q").status, 1);
    EXPECT_NE(run({"rcalc", "-e", "$1=1/($1-1)"}, "1\n").err.find("warning - "), std::string::npos);
}

TEST(Vwrays, DimensionsFollowTheView)
{
    EXPECT_EQ(run("vwrays -d -vh 90 -vv 90 -x 200 -y 100").out, "-x 100 -y 100 -ld-\n");
    EXPECT_EQ(run("vwrays -d -vh 90 -vv 90 -pa 0 -x 200 -y 100").out, "-x 200 -y 100 -ld-\n");
    EXPECT_EQ(run("vwrays -d -vtl -vh 4 -vv 2 -va 10 -x 64 -y 64").out, "-x 64 -y 32 -ld+\n");
}

TEST(Vwrays, RaysGoThroughTheMiddleOfPixels)
{
    // Ninety degrees over two pixels: they lie half a tangent to either side.
    const Ran ran = run("vwrays -vp 1 2 3 -vd 0 1 0 -vh 90 -vv 90 -x 2 -y 2");
    const double n = std::sqrt(1.5);
    std::ostringstream expected;
    for (const double up : {.5, -.5})
        for (const double right : {-.5, .5})
            expected << "1 2 3 " << right / n << ' ' << 1 / n << ' ' << up / n << '\n';
    EXPECT_EQ(difference(ran.out, expected.str(), 1e-5, 1e-6), "");
    EXPECT_EQ(run("vwrays -ff -c 3 -vh 90 -vv 90 -x 2 -y 2").out.size(), 2u * 2 * 3 * 6 * 4);
    // Outside the circle of a fisheye there are no rays.
    EXPECT_EQ(difference(run("vwrays -vth -vh 180 -vv 180 -x 9 -y 9").out.substr(0, 78), "0 0 0 0 0 0", 0, 0), "");
    EXPECT_NE(run("vwrays -vd 0 0 1 -x 2 -y 2").err.find("fatal - view up parallel to view direction"),
              std::string::npos);
    EXPECT_EQ(run("vwrays -x 0").status, 1);
}

TEST(Pvalue, NumbersMakeAPictureAndComeBack)
{
    const WorkFolder folder;
    const Ran made = run("pvalue -r -d -h -H -y 1 +x 2", "0.5 0.25 1\n2 4 8\n");
    ASSERT_EQ(made.status, 0) << made.err;
    std::ofstream("p.hdr", std::ios::binary) << made.out;
    // Mantissas have eight bits, which these numbers fit; a decoder adds half a step of the largest.
    EXPECT_EQ(difference(run("pvalue -h -H p.hdr").out, "0 0 0.5 0.25 1\n1 0 2 4 8\n", 0.02, 0), "");
    EXPECT_EQ(difference(run("pvalue -h -H -d -pG", made.out).out, "0.25 4", 0.02, 0), "");
    EXPECT_EQ(difference(run("pvalue -h -H -d -b p.hdr").out, "0.365 3.73", 0.02, 0), ""); // .265 R + .67 G + .065 B
    EXPECT_EQ(run("pvalue -h -H -df p.hdr").out.size(), 24u);
    EXPECT_EQ(run("pvalue gone.hdr").status, 1);
    EXPECT_EQ(run("pvalue -h -H", "#?RADIANCE\n").status, 1);
    EXPECT_EQ(run("pvalue -r -d -h -H -y 2 +x 2", "1 2 3\n").status, 1);
}

} // namespace
} // namespace lightwell::commands
