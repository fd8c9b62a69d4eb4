#include "tests/unit/radiance/scene_folder.h"

#include <cstdio>
#include <ctime>
#include <gtest/gtest.h>

namespace lightwell {
namespace {

/// Quadrilaterals, 148 bytes each on average.
std::string many_polygons(std::size_t bytes)
{
    std::string text = "void plastic grey\n0\n0\n5 .5 .5 .5 0 0\nvoid plastic white\n0\n0\n5 .8 .8 .8 0 0\n";
    text.reserve(bytes + 1000);
    char line[300];
    for (int i = 0; text.size() < bytes; ++i) {
        const double x = i % 1000 * 0.25, y = i / 1000 * 0.25, z = (i % 1000 * 7919 % 1000) * 0.001 + 0.123456;
        const int n = std::snprintf(
            line, sizeof line, "%s polygon p%d\n0\n0\n12 %.6f %.6f %.6f %.6f %.6f %.6f %.6f %.6f %.6f %.6f %.6f %.6f\n",
            i % 10 == 0 ? "white" : "grey", i, x, y, z, x + .2, y, z, x + .2, y + .2, z, x, y + .2, z);
        text.append(line, static_cast<std::size_t>(n));
    }
    return text;
}

TEST(SceneSpeed, AHundredMegabytesOfPolygonsAreReadInAFewSeconds)
{
    const SceneFolder folder;
    const std::string text = many_polygons(100'000'000);
    const std::filesystem::path file = folder.write("big.rad", text);
    Report report;
    // Processor time: the machine may be busy with other tests.
    const std::clock_t begin = std::clock();
    const Scene scene = read_radiance(file, report);
    const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    EXPECT_GT(scene.root.polygons.size(), 600'000u);
    EXPECT_EQ(scene.root.points.size(), 4 * scene.root.polygons.size());
    EXPECT_TRUE(report.notes().empty());
    RecordProperty("seconds", std::to_string(seconds));
    std::printf("%.1f MB, %zu polygons: %.2f s\n", static_cast<double>(text.size()) * 1e-6, scene.root.polygons.size(),
                seconds);
    // Below 2 s in a release build; the bound leaves room for sanitizers.
    EXPECT_LT(seconds, 30);
    const std::clock_t written = std::clock();
    write_radiance(scene, folder.path("out.rad"), {}, report);
    std::printf("written in %.2f s\n", static_cast<double>(std::clock() - written) / CLOCKS_PER_SEC);
    // The shortest digits of the same numbers: less text than was read.
    EXPECT_LT(std::filesystem::file_size(folder.path("out.rad")), text.size() + 1000);
}

TEST(SceneSpeed, AHundredThousandInstancesAreReadAndWrittenInAFewSeconds)
{
    const SceneFolder folder;
    folder.write("chair.rad", "void plastic grey 0 0 5 .5 .5 .5 0 0 grey sphere s 0 0 4 0 0 0 1\n");
    std::string text;
    for (int i = 0; i < 100'000; ++i)
        text +=
            "void instance c 7 chair.oct -rz " + std::to_string(i % 360) + " -t " + std::to_string(i) + " 0 0 0 0\n";
    const std::clock_t begin = std::clock();
    const Scene scene = folder.read(text);
    Report report;
    write_radiance(scene, folder.path("out.rad"), {}, report);
    const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    EXPECT_EQ(scene.root.instances.size(), 100'000u);
    EXPECT_EQ(scene.prototypes.size(), 1u);
    std::printf("100,000 instances: %.2f s\n", seconds);
    EXPECT_LT(seconds, 20);
}

} // namespace
} // namespace lightwell
