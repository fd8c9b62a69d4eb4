#include "engine/base/errors.h"
#include "engine/base/vector.h"
#include "importers/radiance/read_options.h"
#include "tests/unit/commands/command_run.h"

#include <gtest/gtest.h>

#include <set>

/// \file Shapes that the generators make, by what is known of them: closed surfaces, areas, volumes.
namespace lightwell::commands {
namespace {

Scene scene_of(const std::string& text, const std::string& name = "made.rad")
{
    std::ofstream(name) << "void plastic m\n0\n0\n5 .5 .5 .5 0 0\n" << text;
    Report report;
    return read_radiance(name, report);
}

/// Volume inside flat faces whose fronts look outwards, by the divergence theorem; negative when they look inwards.
double volume_of(const Scene& scene)
{
    double sum = 0;
    for (const Surface& surface : scene.root.surfaces) {
        const Polygon& polygon = scene.root.polygons[surface.index];
        const Point* corners = &scene.root.points[polygon.first];
        sum += dot(corners[0], polygon_area_vector(corners, polygon.count)) / 3;
    }
    return sum;
}

/// Sum of the area vectors: zero for what is closed.
double openness_of(const Scene& scene)
{
    Vec3 sum;
    for (const Surface& surface : scene.root.surfaces) {
        const Polygon& polygon = scene.root.polygons[surface.index];
        sum += polygon_area_vector(&scene.root.points[polygon.first], polygon.count);
    }
    return length(sum);
}

TEST(Generators, ABoxHasItsVolumeAndABevelTakesAway)
{
    const WorkFolder folder;
    const Scene plain = scene_of(run("genbox m b 1 2 3").out);
    EXPECT_EQ(plain.root.surfaces.size(), 6u);
    EXPECT_NEAR(volume_of(plain), 6, 1e-12);
    EXPECT_NEAR(volume_of(scene_of(run("genbox m b 1 2 3 -i").out)), -6, 1e-12);
    const Scene bevel = scene_of(run("genbox m b 1 2 3 -b .1").out);
    EXPECT_EQ(bevel.root.surfaces.size(), 26u);
    EXPECT_NEAR(openness_of(bevel), 0, 1e-12);
    // Along each of the twelve edges half of a square of 0.1 goes, with less where three of them meet: a corner takes
    // the cube less the tetrahedron-cut body, 0.1^3 (3/2 - 2/3).
    const double edges = 4 * ((1 - .2) + (2 - .2) + (3 - .2)) * .005;
    EXPECT_NEAR(volume_of(bevel), 6 - edges - 8 * 1e-3 * 5 / 6, 1e-12);
    const Scene round = scene_of(run("genbox m b 1 2 3 -r .1").out);
    EXPECT_EQ(round.root.surfaces.size(), 6u + 12 + 8);
}

TEST(Generators, APrismFacesOutwardsWhenItsOutlineRunsClockwise)
{
    const WorkFolder folder;
    const Scene scene = scene_of(run("genprism m p 3 0 0 0 1 2 0 -l 0 0 3").out);
    EXPECT_EQ(scene.root.surfaces.size(), 5u);
    EXPECT_NEAR(volume_of(scene), 3, 1e-12);
    EXPECT_NEAR(volume_of(scene_of(run("genprism m p 3 0 0 2 0 0 1 -l 0 0 3").out)), -3, 1e-12);
    EXPECT_EQ(scene_of(run("genprism m p 3 0 0 0 1 2 0 -e -c").out).root.surfaces.size(), 2u);
    EXPECT_NEAR(volume_of(scene_of(run("genprism m p - -l 1 0 3", "0 0\n0 1\n2 0\n").out)), 3, 1e-12);
}

TEST(Generators, ATorusHasTheAreaThatPappusGives)
{
    const WorkFolder folder;
    const Scene scene = scene_of(run({"genrev", "m", "t", "sin(2*PI*t)", "2+cos(2*PI*t)", "128"}).out);
    double area = 0;
    for (const Surface& surface : scene.root.surfaces)
        area += surface_area_m2(scene.root, surface);
    EXPECT_NEAR(area / (4 * pi * pi * 2), 1, 2e-4); // 128 chords are shorter than the circle by 1e-4
    EXPECT_EQ(scene.root.surfaces.size(), 128u);
}

TEST(Generators, ASphereOfPatchesIsClosedAndLooksOutwards)
{
    const WorkFolder folder;
    const std::vector<std::string> words{"gensurf",   "m",  "s", "sin(PI*s)*cos(2*PI*t)", "sin(PI*s)*sin(2*PI*t)",
                                         "cos(PI*s)", "40", "80"};
    const Scene scene = scene_of(run(words).out);
    EXPECT_NEAR(openness_of(scene), 0, 1e-9);
    EXPECT_NEAR(volume_of(scene) / (4 * pi / 3), 1, 4e-3);
    std::vector<std::string> smooth = words;
    smooth.insert(smooth.end(), {"-s", "-i"});
    EXPECT_NEAR(volume_of(scene_of(run(smooth).out)) / (4 * pi / 3), -1, 4e-3);
    std::vector<std::string> obj = words;
    obj.emplace_back("-o");
    EXPECT_EQ(run(obj).out.substr(run(obj).out.find("usemtl"), 9), "usemtl m\n");
}

TEST(Generators, AHeightFieldComesFromItsFile)
{
    const WorkFolder folder;
    folder.write("height.dat", "0 0 0\n1 1 1\n");
    const Scene scene = scene_of(run({"gensurf", "m", "g", "10*s", "20*t", "height.dat", "2", "1"}).out);
    ASSERT_EQ(scene.root.surfaces.size(), 2u);
    EXPECT_EQ(scene.root.points[2], (Point{5, 20, 1}));
    const Ran wrong = run({"gensurf", "m", "g", "10*s", "20*t", "height.dat", "3", "3"});
    EXPECT_EQ(wrong.status, 1);
    EXPECT_NE(wrong.err.find("has 6 values, expected 9 or 16"), std::string::npos);
}

TEST(Generators, AWormHasOneSphereMoreThanSegments)
{
    const WorkFolder folder;
    const Scene scene = scene_of(run({"genworm", "m", "w", "0", "5*sin(t)", "5*cos(t)", ".4-(.5-t)*(.5-t)", "20"}).out);
    EXPECT_EQ(scene.root.spheres.size(), 21u);
    EXPECT_EQ(scene.root.cones.size(), 20u);
}

TEST(Generators, SlatsLieWhereTheyAreWanted)
{
    const WorkFolder folder;
    const Scene scene = scene_of(run("genblinds m b .08 1.2 2 25 30").out);
    ASSERT_EQ(scene.root.surfaces.size(), 25u);
    EXPECT_NEAR(scene.root.points[0].z, 0.04, 1e-12);              // half of 2 m / 25
    EXPECT_NEAR(scene.root.points[1].z, 0.04 + 0.08 * 0.5, 1e-12); // the sine of 30 degrees
    EXPECT_NEAR(scene.root.points[1].x, 0.08 * std::sqrt(.75), 1e-12);
    // An arc over a chord of 0.08 with radius 0.1 turns by 47 degrees: five pieces of less than ten.
    EXPECT_EQ(scene_of(run("genblinds m b .08 1.2 2 25 0 +r .1").out).root.surfaces.size(), 125u);
}

TEST(Generators, BadWordsEndWithStatusOneAndSayWhy)
{
    const WorkFolder folder;
    for (const char* line : {"genbox",
                             "genbox m b 1 2",
                             "genbox m b 1 2 x",
                             "genbox m b 1 -2 3",
                             "genbox m b 1 2 3 -b 5",
                             "genbox m b 1 2 3 -q",
                             "genprism m p 2 0 0 1 1",
                             "genprism m p missing.txt",
                             "genprism m p 3 0 0 0 1 1 0 -l 1 0 0",
                             "genrev m r t t 0",
                             "genrev m r t) t 3",
                             "genrev m r nothing(t) t 3",
                             "genworm m w t t t -1 3",
                             "gensurf m s s t s*t 1 99999999",
                             "genblinds m b 1 1 1 0 0",
                             "genblinds m b 1 1 1 2 0 -r .1",
                             "gensky",
                             "gensky 6 21",
                             "gensky 6 21 12 -a",
                             "gensky 6 21 12 -a north",
                             "gensky -ang 40",
                             "gensky 6 21 12 -g 2",
                             "gendaylit 6 21 12 -W 1",
                             "gendaylit -ang 1 nan",
                             "gendaylit -ang 30 0 -O 3",
                             "replmarks",
                             "replmarks -x a.rad"}) {
        const Ran ran = run(std::string(line));
        EXPECT_EQ(ran.status, 1) << line;
        EXPECT_EQ(ran.err.rfind(words_of(line)[0] + ": ", 0), 0u) << line << ": " << ran.err;
        EXPECT_TRUE(ran.out.empty()) << line;
    }
}

TEST(Generators, ASunThatRisesWithinTheHourStandsInTheMiddleOfItsPart)
{
    const std::string place = " -a 50 -o -8 -m -15 -W 500 100";
    // Radiance 6.1a, the first three with its correction, the last untouched by it.
    const std::pair<const char*, const char*> recorded[] = {
        {"4.2", "# Local solar time: 4.07\n# Solar altitude and azimuth: 1.1 -126.6\n"},
        {"4.4", "# Local solar time: 4.17\n# Solar altitude and azimuth: 1.9 -125.5\n"},
        {"4.8", "# Local solar time: 4.37\n# Solar altitude and azimuth: 3.5 -123.2\n"}};
    for (const auto& [hour, lines] : recorded)
        EXPECT_NE(run("gendaylit 6 21 " + std::string(hour) + place + " -i 60").out.find(lines), std::string::npos)
            << hour;
    const auto sky_of = [](const Ran& ran) { return ran.out.substr(ran.out.find('\n')); };
    EXPECT_EQ(sky_of(run("gendaylit 6 21 12" + place + " -i 60")), sky_of(run("gendaylit 6 21 12" + place)));
    EXPECT_NE(run("gendaylit 6 21 12" + place + " -i -5").status, 0);
    EXPECT_NE(run("gendaylit 6 21 12" + place + " -C").err.find("warning - the colour of the sky"), std::string::npos);
}

TEST(Generators, SegmentsOfRoundEdgesLeaveSceneTextAsItIs)
{
    const auto box_of = [](const Ran& ran) { return ran.out.substr(ran.out.find('\n')); };
    EXPECT_EQ(box_of(run("genbox m b 1 2 3 -r .2 -n 4 -s")), box_of(run("genbox m b 1 2 3 -r .2")));
    EXPECT_EQ(run("genbox m b 1 2 3 -r .2 -n none").status, 1);
}

TEST(Generators, MarkersAreReplacedWhereTheyPoint)
{
    const WorkFolder folder;
    folder.write("thing.rad", "m sphere s 0 0 4 1 0 0 .1\n");
    // The long side of the right angle lies along +y, the short one along -x: x' is y and y' is -x.
    const std::string marks = "void plastic mark 0 0 5 0 0 0 0 0\nmark polygon a 0 0 9 5 6 7 5 8 7 4 6 7\n";
    const Ran ran = run("replmarks -s .5 -x thing.rad mark", marks);
    ASSERT_EQ(ran.status, 0) << ran.err;
    const Scene scene = scene_of(ran.out);
    ASSERT_EQ(scene.root.spheres.size(), 1u);
    EXPECT_NEAR(length(scene.root.spheres[0].centre - Point{5, 7, 7}), 0, 1e-9);
    EXPECT_NEAR(scene.root.spheres[0].radius, 0.1, 1e-12); // 0.5 times the two metres of the marker
}

TEST(CommandsInScenes, GeneratorsAndPipesAreAnsweredWithoutAProgram)
{
    const WorkFolder folder;
    setenv("PATH", "/nowhere", 1);
    const Scene scene = scene_of("!genbox m b 1 1 1 | xform -t 5 0 0 \\\n -a 2 -t 0 10 0\n!gensky 6 21 12 +s\n"
                                 "skyfunc glow g 0 0 4 1 1 1 0\ng source sky 0 0 4 0 0 1 180\n");
    EXPECT_EQ(scene.root.polygons.size(), 12u);
    EXPECT_EQ(scene.root.points[0], (Point{6, 0, 0}));
    EXPECT_EQ(scene.root.sources.size(), 2u); // sun and sky
}

TEST(CommandsInScenes, OthersNeedPermission)
{
    const WorkFolder folder;
    EXPECT_THROW(scene_of("!cat other.rad\n"), InputError);
    EXPECT_THROW(scene_of("!genbox m b 1 1 1; rm x\n"), InputError);
    EXPECT_THROW(scene_of("!genbox m b 1 1\n"), InputError);
    folder.write("self.rad", "!xform -rz 5 self.rad | xform -t 1 0 0\n");
    EXPECT_THROW(scene_of("!xform -rz 5 self.rad | xform -t 1 0 0\n"), InputError); // never ends
    folder.write("other.rad", "void plastic m 0 0 5 .5 .5 .5 0 0\nm sphere s 0 0 4 0 0 0 1\n");
    folder.write("permitted.rad", "!/bin/cat other.rad\n");
    Report report;
    EXPECT_EQ(read_radiance("permitted.rad", report, RadianceReadOptions{true}).root.spheres.size(), 1u);
    folder.write("failing.rad", "!/bin/false\n");
    EXPECT_THROW(read_radiance("failing.rad", report, RadianceReadOptions{true}), InputError);
}

} // namespace
} // namespace lightwell::commands
