#include "engine/scene/scene_hash.h"
#include "engine/scene/varied_materials.h"
#include "materials/patterns/place_function.h"
#include "tests/unit/radiance/scene_folder.h"

#include <gtest/gtest.h>

/// \file Patterns, textures and mixtures in scene text.
namespace lightwell {
namespace {

constexpr const char* ring = " ring r 0 0 8 0 0 0 0 0 1 0 2\n";

SeenMaterial seen_at(const Scene& scene, const Point& at)
{
    PatternPlace place;
    place.position = at;
    SeenMaterial seen;
    VariedMaterials(scene).look(scene.root.surfaces.back().modifier, place, seen);
    return seen;
}

double reflectance_at(const Scene& scene, const Point& at)
{
    const SeenMaterial seen = seen_at(scene, at);
    return seen.material == nullptr ? -1 : std::get<Plastic>(*seen.material).colour.g;
}

TEST(PatternText, AnAliasKeepsPatternsOnlyWhenItInherits)
{
    const SceneFolder folder;
    const std::string head = "void brightfunc half 2 .5 . 0 0\nvoid brightfunc fifth 2 .2 . 0 0\n"
                             "half plastic m 0 0 5 .8 .8 .8 0 0\n";
    EXPECT_DOUBLE_EQ(reflectance_at(folder.read(head + "m" + ring), {}), 0.4);
    EXPECT_DOUBLE_EQ(reflectance_at(folder.read(head + "inherit alias a m\na" + ring), {}), 0.4);
    EXPECT_DOUBLE_EQ(reflectance_at(folder.read(head + "void alias a m\na" + ring), {}), 0.8);
    EXPECT_DOUBLE_EQ(reflectance_at(folder.read(head + "fifth alias a m\na" + ring), {}), 0.16);
    EXPECT_DOUBLE_EQ(reflectance_at(folder.read(head + "fifth alias a m\ninherit alias b a\nb" + ring), {}), 0.16);
    EXPECT_DOUBLE_EQ(
        reflectance_at(folder.read(head + "half alias a m\nfifth brightfunc c 2 .5 . 0 0\nc alias b a\nb" + ring), {}),
        0.08);
}

TEST(PatternText, MixturesNestAndTakeThePatternsBeforeThem)
{
    const SceneFolder folder;
    const Scene scene = folder.read("void plastic a 0 0 5 .8 .8 .8 0 0\nvoid plastic b 0 0 5 .4 .4 .4 0 0\n"
                                    "void mixfunc inner 4 a b \"if(Py, 1, 0)\" . 0 0\n"
                                    "void mixfunc outer 4 inner void \"if(Px, 1, 0)\" . 0 0\n"
                                    "outer brightfunc half 2 .5 . 0 0\nhalf" +
                                    std::string(ring));
    EXPECT_DOUBLE_EQ(reflectance_at(scene, {1, 1, 0}), 0.4);
    EXPECT_DOUBLE_EQ(reflectance_at(scene, {1, -1, 0}), 0.2);
    EXPECT_EQ(reflectance_at(scene, {-1, 1, 0}), -1);
}

TEST(PatternText, PatternsOfTheTextAroundAnIncludedFileStayWhereTheyAre)
{
    const SceneFolder folder;
    folder.write("plate.rad", std::string("mine") + ring);
    folder.write("own.rad",
                 std::string("void brightfunc ramp 2 Px . 0 0\nramp plastic mine 0 0 5 1 1 1 0 0\nmine") + ring);
    const std::string outer = "void brightfunc ramp 2 Px . 0 0\nramp plastic mine 0 0 5 1 1 1 0 0\n";
    EXPECT_DOUBLE_EQ(reflectance_at(folder.read(outer + "!xform -t .5 0 0 plate.rad\n"), {0.75, 0, 0}), 0.75);
    EXPECT_DOUBLE_EQ(reflectance_at(folder.read("!xform -t .5 0 0 own.rad\n"), {0.75, 0, 0}), 0.25);
}

TEST(PatternText, WhatIsWrittenReadsBackToTheSameScene)
{
    const SceneFolder folder;
    folder.write("ramp.dat", "1 0 1 2 .2 .9");
    folder.write("wave.cal", "wave(v) = v * A1; wx = Px / 2;");
    folder.write("square.fnt", "32 0\n79 4 51 51 204 51 204 204 51 204");
    const std::string text = "void brightdata ramp 10 wave ramp.dat wave.cal wx -rz 30 -t 1 2 3 0 1 .5\n"
                             "ramp plastic m 0 0 5 .8 .8 .8 0 0\n"
                             "void texfunc bump 4 \"sin(Px) * .1\" 0 0 . 0 0\nbump alias bumpy m\n"
                             "void plastic dark 0 0 5 .1 .1 .1 0 0\n"
                             "void mixtext sign 5 dark bumpy square.fnt . O 0 9 0 1 0 1 0 0 0 -1 0\nsign" +
                             std::string(ring);
    Report report;
    const Scene scene = folder.read(text, report);
    EXPECT_TRUE(report.notes().empty());
    write_radiance(scene, folder.path("again.rad"), {}, report);
    const Scene again = read_radiance(folder.path("again.rad"), report);
    EXPECT_TRUE(report.notes().empty());
    for (const Point& at : {Point{0.5, 0.5, 0}, Point{0.9, 0.9, 0}, Point{-.4, .3, 0}}) {
        EXPECT_NEAR(reflectance_at(again, at), reflectance_at(scene, at), 1e-12);
        EXPECT_NEAR(seen_at(again, at).bend.x, seen_at(scene, at).bend.x, 1e-12);
    }
    EXPECT_DOUBLE_EQ(reflectance_at(scene, {0.5, 0.5, 0}), 0.1); // inside the letter
}

TEST(PatternText, TheHashOfASceneKnowsItsPatterns)
{
    const SceneFolder folder;
    const auto hash = [&](const std::string& formula, const std::string& transform) {
        return scene_hash(folder.read("void brightfunc p " + transform.substr(0, 1) + ' ' + formula + " ." +
                                      transform.substr(1) + " 0 0\np plastic m 0 0 5 .5 .5 .5 0 0\nm" + ring));
    };
    EXPECT_EQ(hash("Px", "2"), hash("Px", "2"));
    EXPECT_NE(hash("Px", "2"), hash("Py", "2"));
    EXPECT_NE(hash("Px", "2"), hash("Px", "4 -rz 30"));
}

TEST(PatternText, APatternThatCannotBeReadIsRefusedWhereItIsUsed)
{
    const SceneFolder folder;
    const std::string bad =
        "void colorpict p 7 red green blue nowhere.hdr . Px Py 0 0\np plastic m 0 0 5 .5 .5 .5 0 0\n";
    Report report;
    EXPECT_NO_THROW(folder.read(bad, report));
    EXPECT_TRUE(report.has(Finding::unsupported));
    const std::string message = folder.error(bad + "m" + ring);
    EXPECT_NE(message.find("scene.rad:3"), std::string::npos) << message;
    EXPECT_NE(message.find("a picture \"nowhere.hdr\" is not found"), std::string::npos) << message;
    EXPECT_NE(folder.error("void mixfunc x 1 a 0 0\n").find("no foreground and background"), std::string::npos);
    EXPECT_NE(folder.error("void mixfunc x 4 a void 1 . 0 0\n").find("modifier \"a\" is not defined above"),
              std::string::npos);
    EXPECT_NE(folder.error("void brightfunc x 3 1 . -zz 0 0\nx plastic m 0 0 5 0 0 0 0 0\nm" + std::string(ring))
                  .find("\"-zz\" is no transform"),
              std::string::npos);
}

} // namespace
} // namespace lightwell
