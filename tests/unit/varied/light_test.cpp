#include "engine/simulate/simulate.h"
#include "tests/unit/radiance/scene_folder.h"

#include <gtest/gtest.h>

#include <cmath>

/// \file Patterns, textures and mixtures in light, against closed forms.
namespace lightwell {
namespace {

constexpr double samples = 4096;

double illuminance_lx(const std::string& text, const Point& at, const Direction& normal = {0, 0, 1})
{
    const SceneFolder folder;
    const Simulation simulation(folder.read(text));
    SensorGrid grid;
    grid.sensors = {{at, normal}};
    GridSettings settings;
    settings.samples = static_cast<int>(samples);
    settings.unbiased = true;
    return simulation.illuminance(grid, settings).values[0].value;
}

/// Radiance of what a parallel view straight down on a small square sees, green channel.
double seen_radiance(const std::string& text, const Point& at, double size = 1e-3)
{
    const SceneFolder folder;
    const Simulation simulation(folder.read(text));
    View view;
    view.kind = View::Kind::parallel;
    view.position = at + Vec3{0, 0, 1};
    view.direction = {0, 0, -1};
    view.up = {0, 1, 0};
    view.horizontal = view.vertical = size;
    PictureSettings settings;
    settings.width = settings.height = 8;
    settings.samples = 256;
    settings.unbiased = true;
    const Picture picture = simulation.render(view, settings).picture;
    double sum = 0;
    for (const float value : picture.channels.at("G"))
        sum += value;
    return sum / 64;
}

/// A square lamp of one centimetre at a height of 2 m that looks down.
std::string small_lamp(const std::string& modifier)
{
    return modifier + " polygon lamp 0 0 12 -.005 -.005 2  -.005 .005 2  .005 .005 2  .005 -.005 2\n";
}

TEST(PatternsInLight, ALampSendsWhatItsFunctionSays)
{
    const std::string pattern =
        "void brightfunc beam 2 \"Dz ^ 3 * (1 + Dx)\" . 0 0\nbeam light lit 0 0 3 1000 1000 1000\n";
    for (const double x : {-1.5, 0.0, 2.0}) {
        SCOPED_TRACE(x);
        const double distance = std::hypot(x, 2), cosine = 2 / distance, dx = -x / distance;
        const double expected =
            lumens_per_watt * 1000 * std::pow(cosine, 3) * (1 + dx) * 1e-4 * cosine * cosine / (distance * distance);
        EXPECT_NEAR(illuminance_lx(pattern + small_lamp("lit"), {x, 0, 0}), expected, 1e-3 * expected);
    }
}

TEST(PatternsInLight, PatternsMoveWithTheFilesThatDefineThem)
{
    const SceneFolder folder;
    folder.write("lamp.rad",
                 "void brightfunc beam 2 \"1 + Dx\" . 0 0\nbeam light lit 0 0 3 1000 1000 1000\n" + small_lamp("lit"));
    // Turned by 90 degrees the pattern's x axis is the world's y axis.
    const double with_y = 1000 * (1 - 1 / std::sqrt(5.0));
    for (const char* line : {"!xform -rz 90 lamp.rad\n", "void instance i 3 lamp.rad -rz 90 0 0\n"}) {
        SCOPED_TRACE(line);
        const std::filesystem::path main = folder.write("main.rad", line);
        Report report;
        const Simulation simulation(read_radiance(main, report));
        SensorGrid grid;
        grid.sensors = {{{0, 1, 0}, {0, 0, 1}}};
        GridSettings settings;
        settings.samples = static_cast<int>(samples);
        settings.unbiased = true;
        const double expected = lumens_per_watt * with_y * 1e-4 * (4.0 / 5) / 5;
        EXPECT_NEAR(simulation.illuminance(grid, settings).values[0].value, expected, 2e-3 * expected);
    }
}

TEST(PatternsInLight, ASkyByFunctionGivesWhatTheBuiltInSkyGives)
{
    const std::string numbers = " 0 7 1 40 8 1.3 .4 -.5 .768114574787\n";
    const std::string glow = "sky glow g 0 0 4 1 1 1 0\ng source s 0 0 4 0 0 1 180\n";
    const double built_in = illuminance_lx("void brightfunc sky 2 skybr skybright.cal" + numbers + glow, {0, 0, 0});
    // As a product the function is not recognized, and takes the way through the language.
    const double by_function =
        illuminance_lx("void brightfunc sky 2 1*skybr skybright.cal" + numbers + glow, {0, 0, 0});
    EXPECT_NEAR(by_function, built_in, 1e-7 * built_in);
    EXPECT_GT(built_in, 1000);
}

constexpr const char* even_sky = "void glow g 0 0 4 1 1 1 0\ng source s 0 0 4 0 0 1 360\n";

TEST(PatternsInLight, AReflectanceFollowsItsFunction)
{
    const std::string plate = std::string(even_sky) +
                              "void colorfunc stripes 4 .1 \"if(Px, .75, .25)\" .3 . 0 0\n"
                              "stripes plastic p 0 0 5 .8 .8 .8 0 0\np ring r 0 0 8 0 0 0 0 0 1 0 2\n";
    // A convex plate under an even sky: radiance = reflectance.
    EXPECT_NEAR(seen_radiance(plate, {0.5, 0, 0}), 0.8 * 0.75, 1e-3);
    EXPECT_NEAR(seen_radiance(plate, {-0.5, 0, 0}), 0.8 * 0.25, 1e-3);
    EXPECT_NEAR(seen_radiance(plate, {0, 0, 0}, 0.01), 0.8 * 0.5, 3e-3);
}

TEST(PatternsInLight, ShadowRaysPassAPatternedPaneAsEyesDo)
{
    const std::string sun = "void light l 0 0 3 1e6 1e6 1e6\nl source sun 0 0 4 0 0 1 .5\n";
    const std::string pane = "void brightfunc half 2 \"if(Px, .5, 0)\" . 0 0\nhalf glass clear 0 0 4 .8 .8 .8 1.0001\n"
                             "clear ring pane 0 0 8 0 0 1 0 0 1 0 5\n";
    const double open = illuminance_lx(sun, {1, 0, 0});
    EXPECT_NEAR(illuminance_lx(sun + pane, {1, 0, 0}), 0.4 * open, 1e-3 * open);
    EXPECT_EQ(illuminance_lx(sun + pane, {-1, 0, 0}), 0);
}

TEST(PatternsInLight, ATextureTurnsTheNormalAway)
{
    // Lit by a small sun from straight above, a normal bent by 1 in x stands at 45 degrees.
    const std::string scene = "void light l 0 0 3 1e5 1e5 1e5\nl source sun 0 0 4 0 0 1 .5\n"
                              "void texfunc slope 4 1 0 0 . 0 0\nslope plastic p 0 0 5 .5 .5 .5 0 0\n"
                              "p ring r 0 0 8 0 0 0 0 0 1 0 2\n";
    const double solid_angle = pi * std::pow(std::sin(.25 * radians_per_degree), 2);
    EXPECT_NEAR(seen_radiance(scene, {0, 0, 0}), 1e5 * solid_angle * std::sqrt(0.5) * 0.5 / pi,
                1e-3 * 1e5 * solid_angle);
}

TEST(PatternsInLight, AMixtureShowsEachPartByItsShare)
{
    const std::string scene = std::string(even_sky) +
                              "void plastic light_grey 0 0 5 .8 .8 .8 0 0\nvoid plastic dark 0 0 5 .2 .2 .2 0 0\n"
                              "void mixfunc mixed 4 light_grey dark \"if(Px, .25, 1)\" . 0 0\n"
                              "mixed ring r 0 0 8 0 0 0 0 0 1 0 2\n";
    EXPECT_NEAR(seen_radiance(scene, {-0.5, 0, 0}), 0.8, 1e-3);
    EXPECT_NEAR(seen_radiance(scene, {0.5, 0, 0}), 0.25 * 0.8 + 0.75 * 0.2, 0.01);
}

TEST(PatternsInLight, TheVoidOfAMixtureIsAHole)
{
    const std::string sun = "void light l 0 0 3 1e6 1e6 1e6\nl source sun 0 0 4 0 0 1 .5\n";
    const std::string sheet = "void plastic p 0 0 5 .5 .5 .5 0 0\nvoid mixfunc holes 4 p void \"if(Px, 1, 0)\" . 0 0\n"
                              "holes ring pane 0 0 8 0 0 1 0 0 1 0 5\n";
    const double open = illuminance_lx(sun, {1, 0, 0});
    EXPECT_EQ(illuminance_lx(sun + sheet, {1, 0, 0}), 0);
    EXPECT_NEAR(illuminance_lx(sun + sheet, {-1, 0, 0}), open, 1e-9 * open);
}

TEST(PatternsInLight, InterpolatedPicturesKeepThePattern)
{
    const SceneFolder folder;
    const Simulation simulation(folder.read(std::string(even_sky) +
                                            "void brightfunc lines 2 \"if(sin(Px * 640), 1, 0)\" . 0 0\n"
                                            "lines plastic p 0 0 5 .5 .5 .5 0 0\np ring r 0 0 8 0 0 0 0 0 1 0 2\n"));
    View view;
    view.kind = View::Kind::parallel;
    view.position = {0, 0, 1};
    view.direction = {0, 0, -1};
    view.up = {0, 1, 0};
    view.horizontal = view.vertical = 1;
    PictureSettings settings;
    settings.width = settings.height = 204; // lines and gaps are one pixel wide, about
    settings.samples = 8;
    const Picture picture = simulation.render(view, settings).picture;
    double least = 1, most = 0;
    for (const float value : picture.channels.at("G")) {
        least = std::min<double>(least, value);
        most = std::max<double>(most, value);
    }
    EXPECT_LT(least, 0.05);
    EXPECT_GT(most, 0.45);
}

} // namespace
} // namespace lightwell
