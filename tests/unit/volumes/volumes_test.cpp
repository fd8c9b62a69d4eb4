/// \file What lies between surfaces, in light, against closed forms: haze, antimatter, interfaces, prisms; and limits
/// to diffuse interreflection.
#include "engine/simulate/simulate.h"
#include "tests/unit/radiance/scene_folder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightwell {
namespace {

double illuminance_lx(const std::string& text, const Point& at, const Preparation& preparation = {}, int samples = 4096)
{
    const SceneFolder folder;
    const Simulation simulation(folder.read(text), preparation);
    SensorGrid grid;
    grid.sensors = {{at, {0, 0, 1}}};
    GridSettings settings;
    settings.samples = samples;
    settings.unbiased = true;
    return simulation.illuminance(grid, settings).values[0].value;
}

/// Radiance of what a parallel view straight down on a small square sees, green channel.
double seen_radiance(const std::string& text, const Point& from, const Preparation& preparation = {})
{
    const SceneFolder folder;
    const Simulation simulation(folder.read(text), preparation);
    View view;
    view.kind = View::Kind::parallel;
    view.position = from;
    view.direction = {0, 0, -1};
    view.up = {0, 1, 0};
    view.horizontal = view.vertical = 1e-3;
    PictureSettings settings;
    settings.width = settings.height = 8;
    settings.samples = 512;
    settings.unbiased = true;
    const Picture picture = simulation.render(view, settings).picture;
    double sum = 0;
    for (const float value : picture.channels.at("G"))
        sum += value;
    return sum / 64;
}

constexpr const char* lamp = "void light lit 0 0 3 1000 1000 1000\n"
                             "lit polygon lamp 0 0 12 -.05 -.05 2 -.05 .05 2 .05 .05 2 .05 -.05 2\n";

/// A box with its normals outwards.
std::string box(const std::string& modifier, const std::string& name, const Point& a, const Point& b)
{
    const auto n = [](double x) { return std::to_string(x) + ' '; };
    const auto face = [&](int number, std::initializer_list<Point> corners) {
        std::string text = modifier + " polygon " + name + std::to_string(number) + " 0 0 12 ";
        for (const Point& p : corners)
            text += n(p.x) + n(p.y) + n(p.z);
        return text + '\n';
    };
    return face(1, {{a.x, a.y, a.z}, {a.x, b.y, a.z}, {b.x, b.y, a.z}, {b.x, a.y, a.z}}) +
           face(2, {{a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z}}) +
           face(3, {{a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, a.y, b.z}, {a.x, a.y, b.z}}) +
           face(4, {{a.x, b.y, a.z}, {a.x, b.y, b.z}, {b.x, b.y, b.z}, {b.x, b.y, a.z}}) +
           face(5, {{a.x, a.y, a.z}, {a.x, a.y, b.z}, {a.x, b.y, b.z}, {a.x, b.y, a.z}}) +
           face(6, {{b.x, a.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z}, {b.x, a.y, b.z}});
}

TEST(Haze, WeakensLightByItsThickness)
{
    const double clear = illuminance_lx(lamp, {0, 0, 0});
    const std::string haze = "void mist haze 0 0 7 .7 .7 .7 0 0 0 0\n";
    const double left = std::exp(-0.7);
    const double hazy = illuminance_lx(lamp + haze + box("haze", "box", {-3, -3, .5}, {3, 3, 1.5}), {0, 0, 0});
    EXPECT_NEAR(hazy / clear, left, 0.005);
    // A sensor within the haze knows that it is there.
    const double within = illuminance_lx(lamp + haze + box("haze", "box", {-3, -3, -1}, {3, 3, 1}), {0, 0, 0});
    EXPECT_NEAR(within / clear, left, 0.005);
    const double seen = seen_radiance("void light lit 0 0 3 5 5 5\nlit ring r 0 0 8 0 0 0 0 0 1 0 1\n" + haze +
                                          box("haze", "box", {-3, -3, .5}, {3, 3, 1.5}),
                                      {0, 0, 2});
    EXPECT_NEAR(seen / 5, left, 0.005);
}

TEST(Haze, ThatTakesNothingIsNotSeenInAnEvenSky)
{
    // Scattering alone in even light from everywhere changes nothing: what leaves a ray comes back from the others.
    const std::string sky = "void glow even 0 0 4 3 3 3 0\neven source all 0 0 4 0 0 1 360\n";
    for (const char* g : {"0", ".6", "-.5"})
        EXPECT_NEAR(seen_radiance(sky + "void mist haze 0 0 7 1 1 1 1 1 1 " + g + "\n" +
                                      box("haze", "box", {-1, -1, -1}, {1, 1, 1}),
                                  {0, 0, 2}),
                    3, 0.06);
}

TEST(Haze, ScattersAThinBeamAsItsPhaseFunctionSays)
{
    // The sun from the side through thin haze, seen at right angles: L = E sigma p(90 degrees) times the depth.
    const std::string sun = "void light sun 0 0 3 1e6 1e6 1e6\nsun source s 0 0 4 1 0 0 .5\n";
    const double half = 0.25 * radians_per_degree, solid_angle = 4 * pi * std::pow(std::sin(half / 2), 2);
    for (const double g : {0.0, 0.5}) {
        const double phase = (1 - g * g) / (4 * pi * std::pow(1 + g * g, 1.5));
        const double expected = 1e6 * solid_angle * 1e-3 * phase * 2;
        const double seen = seen_radiance(sun + "void mist haze 0 0 7 .001 .001 .001 1 1 1 " + std::to_string(g) +
                                              "\n" + box("haze", "box", {-1, -1, -1}, {1, 1, 1}),
                                          {0, 0, 2});
        EXPECT_NEAR(seen / expected, 1, 0.01) << g;
    }
}

TEST(Antimatter, CutsAHoleThroughAWallAndShowsItsMaterialInside)
{
    const std::string floor = "void light lit 0 0 3 5 5 5\nlit ring r 0 0 8 0 0 0 0 0 1 0 5\n";
    const std::string wall = "void plastic grey 0 0 5 .5 .5 .5 0 0\n" + box("grey", "slab", {-3, -3, 1}, {3, 3, 1.5});
    const std::string hole = "void antimatter gone 1 grey 0 0\n" + box("gone", "hole", {-.5, -.5, .5}, {.5, .5, 2});
    EXPECT_NEAR(seen_radiance(floor + wall + hole, {0, 0, 3}), 5, 1e-6);
    EXPECT_LT(seen_radiance(floor + wall + hole, {1, 0, 3}), 2.6);
    // Light goes through it too; the sides of a hole in a sheet so thin reflect nothing worth naming.
    const std::string sheet =
        "void plastic grey 0 0 5 .5 .5 .5 0 0\n" + box("grey", "sheet", {-3, -3, 1}, {3, 3, 1.0001});
    EXPECT_NEAR(illuminance_lx(lamp + sheet + hole, {0, 0, 0}) / illuminance_lx(lamp, {0, 0, 0}), 1, 1e-3);
    EXPECT_EQ(illuminance_lx(lamp + wall, {0, 0, 0}), 0);
    // A pit that does not go through ends in the wall's own material, lit from above.
    const std::string pit = "void antimatter gone 1 grey 0 0\n" + box("gone", "pit", {-.5, -.5, 1.25}, {.5, .5, 2});
    const std::string sky = "void glow even 0 0 4 3 3 3 0\neven source all 0 0 4 0 0 1 180\n";
    const double seen = seen_radiance(sky + wall + pit, {0, 0, 3});
    EXPECT_GT(seen, 0.5);
    EXPECT_LT(seen, 1.5);
}

TEST(Interface, BendsAndAbsorbsAsItsTwoSidesSay)
{
    // Straight down through a slab of 1.5 with a border to one of 1.33 under it: products of Fresnel's formulas.
    const std::string floor = "void light lit 0 0 3 5 5 5\nlit ring r 0 0 8 0 0 0 0 0 1 0 5\n";
    const std::string bodies =
        "void dielectric upper 0 0 5 .5 .5 .5 1.5 0\nvoid dielectric lower 0 0 5 .25 .25 .25 1.33 0\n"
        "void interface border 0 0 8 .25 .25 .25 1.33 .5 .5 .5 1.5\n"
        "upper ring top 0 0 8 0 0 2 0 0 1 0 5\nborder ring middle 0 0 8 0 0 1.5 0 0 1 0 5\n"
        "lower ring bottom 0 0 8 0 0 .5 0 0 -1 0 5\n";
    const auto passes = [](double n1, double n2) { return 1 - std::pow((n1 - n2) / (n1 + n2), 2); };
    const double expected = 5 * passes(1, 1.5) * passes(1.5, 1.33) * passes(1.33, 1) * std::pow(0.5, 0.5) * 0.25;
    // Light that is mirrored twice between the surfaces adds less than a hundredth.
    EXPECT_NEAR(seen_radiance(floor + bodies, {0, 0, 3}) / expected, 1, 0.01);
}

TEST(Prism, TurnsTheViewAndKeepsItsShare)
{
    const std::string scene = "void light lit 0 0 3 5 5 5\nlit ring r 0 0 8 3 0 0 0 0 1 0 .5\n"
                              "void prism1 turn 5 .8 Dx+1 Dy Dz . 0 0\nturn ring pane 0 0 8 0 0 3 0 0 1 0 1\n";
    // Down becomes (1, 0, -1): from 3 m up the floor is met at x = 3.
    EXPECT_NEAR(seen_radiance(scene, {0, 0, 4}), 0.8 * 5, 1e-6);
}

TEST(AmbientLimit, GivesConstantLightWhereNoMoreScatteringsAreFollowed)
{
    // A closed sphere of reflectance 0.5 that emits nothing: with k bounces the sensor sees 0.5^k of the constant
    // light.
    const std::string room = "void plastic grey 0 0 5 .5 .5 .5 0 0\ngrey bubble room 0 0 4 0 0 0 3\n";
    for (const int bounces : {0, 1, 2}) {
        Preparation preparation;
        preparation.ambient_limit = AmbientLimit{bounces, Spectrum::grey(2)};
        const double expected = 179 * pi * 2 * std::pow(0.5, bounces);
        EXPECT_NEAR(illuminance_lx(room, {0, 0, 0}, preparation, 64) / expected, 1, 1e-6) << bounces;
    }
}

Preparation limited(int bounces, double constant = 0)
{
    Preparation preparation;
    preparation.ambient_limit = AmbientLimit{bounces, Spectrum::grey(constant)};
    return preparation;
}

TEST(AmbientLimit, LeavesOutLampsThatScatteredRaysMeetInPolishedMetal)
{
    const std::string metal = "void metal polished 0 0 5 .8 .8 .8 1 0\npolished ring plate 0 0 8 0 0 2 0 0 -1 0 9\n";
    const std::string light = "void light lit 0 0 3 5 5 5\n";
    const std::string lamp_up = "lit ring r 0 0 8 2 0 0 0 0 1 0 1\n", image = "lit ring r 0 0 8 2 0 4 0 0 -1 0 1\n";
    const double seen_in_metal = illuminance_lx(light + metal + lamp_up, {0, 0, 0}, {}, 1 << 15);
    EXPECT_NEAR(seen_in_metal / (0.8 * illuminance_lx(light + image, {0, 0, 0})), 1, 0.03);
    EXPECT_EQ(illuminance_lx(light + metal + lamp_up, {0, 0, 0}, limited(1)), 0);
    // The eye sees the lamp there all the same.
    const std::string on_floor = "void metal polished 0 0 5 .8 .8 .8 1 0\npolished ring plate 0 0 8 0 0 0 0 0 1 0 9\n";
    EXPECT_NEAR(seen_radiance(light + on_floor + image, {2, 0, 3}, limited(1)), 0.8 * 5, 0.01);
}

TEST(AmbientLimit, TestsGlowsWithinTheirRadiusAndMeetsThemBeyond)
{
    const auto scene = [](const char* radius_m) {
        return std::string("void glow dim 0 0 4 5 5 5 ") + radius_m + "\ndim sphere s 0 0 4 0 0 3 .5\n";
    };
    const double whole = 179 * pi * 5 * 0.25 / 9;
    for (const char* radius : {"0", "1", "5"})
        EXPECT_NEAR(illuminance_lx(scene(radius), {0, 0, 0}, limited(1), 1 << 15) / whole, 1, 0.03) << radius;
    EXPECT_NEAR(illuminance_lx(scene("5"), {0, 0, 0}, limited(0)) / whole, 1, 0.01);
    EXPECT_EQ(illuminance_lx(scene("1"), {0, 0, 0}, limited(0)), 0);
    // Its middle is out of reach, its near side within: counted neither way, but for the rim.
    EXPECT_LT(illuminance_lx(scene("2.9"), {0, 0, 0}, limited(1)), 0.5 * whole);
}

TEST(AmbientLimit, TakesFunctionsForDiffuseInAllLightButThatOfLamps)
{
    const std::string metal = "void metfunc brushed 2 .2 . 0 4 .6 .6 .6 .5\nbrushed ring r 0 0 8 0 0 0 0 0 1 0 9\n";
    const std::string sky = "void glow even 0 0 4 1 1 1 0\neven source dome 0 0 4 0 0 1 360\n";
    EXPECT_NEAR(seen_radiance(metal + sky, {0, 0, 4}), 0.3 + 0.3 * 0.2 * pi, 0.01);
    EXPECT_NEAR(seen_radiance(metal + sky, {0, 0, 4}, limited(1)), 0.6, 0.01);
    EXPECT_NEAR(seen_radiance(metal, {0, 0, 4}, limited(0, 2)), 0.6 * 2, 1e-6);
    // A lamp: the function as it is.
    const std::string beam = "void light lit 0 0 3 900 900 900\nlit source s 0 0 4 0 0 1 1\n";
    const double irradiance = 900 * pi * std::pow(std::sin(0.5 * pi / 180), 2);
    EXPECT_NEAR(seen_radiance(metal + beam, {0, 0, 4}, limited(0)) / ((0.3 / pi + 0.3 * 0.2) * irradiance), 1, 1e-3);
}

TEST(AmbientLimit, TakesSlightHighlightsForDiffuseInAllLightButThatOfLamps)
{
    // Red, so that the highlight, which keeps the colour of the light, shows in green.
    const std::string varnish = "void plastic varnish 0 0 5 .5 .1 .1 .02 .1\nvarnish ring r 0 0 8 0 0 0 0 0 1 0 9\n";
    Preparation slight = limited(0, 3), strict = limited(0, 3);
    slight.ambient_limit->unsampled_specularity = 0.02;
    strict.ambient_limit->unsampled_specularity = 0.01;
    EXPECT_NEAR(seen_radiance(varnish, {0, 0, 4}, slight), 3 * (0.1 * 0.98 + 0.02), 1e-6);
    EXPECT_NEAR(seen_radiance(varnish, {0, 0, 4}, strict), 3 * 0.1 * 0.98, 1e-6); // the rest shows the dark above
    const std::string beam = "void light lit 0 0 3 900 900 900\nlit source s 0 0 4 0 0 1 1\n";
    const double constant = 3 * 0.02;
    EXPECT_NEAR((seen_radiance(varnish + beam, {0, 0, 4}, slight) - constant) /
                    seen_radiance(varnish + beam, {0, 0, 4}, strict),
                1, 0.01);
}

/// A sheet one metre over the floor whose front looks down, or up.
std::string illum_sheet(const char* alternate, bool front_down)
{
    return "void glass pane 0 0 3 .9 .9 .9\nvoid plastic grey 0 0 5 .5 .5 .5 0 0\nvoid illum sheet 1 " +
           std::string(alternate) + " 0 3 0 0 0\nsheet ring r 0 0 8 0 0 1 0 0 " + (front_down ? "-1" : "1") +
           " 0 1000\n";
}

TEST(Illum, PassesTheLightOfLampsAsItsAlternateDoes)
{
    const std::string pane = "void glass pane 0 0 3 .9 .9 .9\npane ring r 0 0 8 0 0 1 0 0 1 0 1000\n";
    const double open = illuminance_lx(lamp, {0.2, 0, 0}), glazed = illuminance_lx(lamp + pane, {0.2, 0, 0});
    // Elsewhere a body with a hole in it, so that rays ask which volumes they are in.
    const std::string carved = "void plastic wood 0 0 5 .3 .3 .3 0 0\nvoid antimatter hole 1 wood 0 0\n" +
                               box("hole", "cut", {50, 50, 50}, {51, 51, 51});
    for (const bool front_down : {true, false})
        for (const std::string& more : {std::string(), carved}) {
            SCOPED_TRACE(front_down ? "from behind to the front" : "from the front to behind");
            const std::string all = lamp + more;
            EXPECT_NEAR(illuminance_lx(all + illum_sheet("void", front_down), {0.2, 0, 0}) / open, 1, 1e-3);
            EXPECT_NEAR(illuminance_lx(all + illum_sheet("pane", front_down), {0.2, 0, 0}) / glazed, 1, 0.01);
            EXPECT_EQ(illuminance_lx(all + illum_sheet("grey", front_down), {0.2, 0, 0}), 0);
        }
}

TEST(Illum, StandsForTheSkyBehindIt)
{
    const std::string sky = "void glow even 0 0 4 1 1 1 0\neven source dome 0 0 4 0 0 1 180\n";
    const double open = illuminance_lx(sky, {0, 0, 0});
    EXPECT_NEAR(open / (179 * pi), 1, 0.01);
    EXPECT_LT(illuminance_lx(sky + illum_sheet("void", true), {0, 0, 0}), 1e-3 * open);
    EXPECT_NEAR(illuminance_lx(sky + illum_sheet("void", false), {0, 0, 0}) / open, 1, 0.01);
    // A glow that is never tested by shadow rays is to it what the sky is.
    const std::string panel = "void glow dim 0 0 4 5 5 5 0\ndim ring p 0 0 8 0 0 2 0 0 -1 0 1\n";
    EXPECT_EQ(illuminance_lx(panel + illum_sheet("void", true), {0, 0, 0}), 0);
}

TEST(Glow, OfNegativeRadiusIsSeenAndLightsNothing)
{
    const std::string only_seen = "void glow dim 0 0 4 5 5 5 -1\ndim sphere s 0 0 4 0 0 2 .5\n";
    EXPECT_NEAR(seen_radiance(only_seen, {0, 0, 4}), 5, 1e-6);
    EXPECT_EQ(illuminance_lx(only_seen, {0, 0, 0}), 0);
    EXPECT_GT(illuminance_lx("void glow dim 0 0 4 5 5 5 1\ndim sphere s 0 0 4 0 0 2 .5\n", {0, 0, 0}), 100);
}

TEST(Mirror, ThatShowsSomethingElseStillSendsLight)
{
    // Seen as a grey plate; its light on the floor is that of the mirror.
    const std::string scene = std::string(lamp) + "void plastic grey 0 0 5 .3 .3 .3 0 0\n"
                                                  "void mirror glassy 1 grey 0 3 .9 .9 .9\n"
                                                  "glassy polygon plate 0 0 12 1 -1 0 1 1 0 1 1 3 1 -1 3\n";
    const std::string plain = std::string(lamp) + "void mirror glassy 0 0 3 .9 .9 .9\n"
                                                  "glassy polygon plate 0 0 12 1 -1 0 1 1 0 1 1 3 1 -1 3\n";
    const double direct = illuminance_lx(lamp, {0.2, 0, 0});
    const double mirrored = illuminance_lx(plain, {0.2, 0, 0}) - direct;
    EXPECT_GT(mirrored, 0.02 * direct);
    const double shown = illuminance_lx(scene, {0.2, 0, 0}) - direct;
    EXPECT_GT(shown, mirrored); // and what the plate itself reflects
    EXPECT_LT(shown, 1.5 * mirrored);
}

} // namespace
} // namespace lightwell
