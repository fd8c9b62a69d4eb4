#include "engine/simulate/technique_names.h"
#include "tests/analytic/expect.h"

#include <cstdio>

/// \file Each technique switched off by its name: what it buys, in rays and in error against a reference. Seeds are
/// fixed and rays are counted, so the numbers are the same on every machine; they stand in engine/docs/techniques.md.
namespace lightwell {
namespace {

/// What it took to find values, and how far they lie from the reference.
struct Bought {
    double rays = 0, shadow_rays = 0;
    double rms = 0; ///< over the sensors, relative to the mean of the reference
};

/// The same with a technique and without it.
struct Pair {
    Bought with, without;
};

/// What is asked for, of a scene that is made anew for each run.
struct Question {
    Scene (*scene)();
    SensorGrid grid;
    GridSettings settings;
    std::vector<double> reference; ///< lx, by sensor
};

double relative_rms(const std::vector<Illuminance>& values, const std::vector<double>& reference)
{
    double squares = 0, sum = 0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
        squares += std::pow(values[i].value - reference[i], 2);
        sum += reference[i];
    }
    return std::sqrt(squares * static_cast<double>(reference.size())) / sum;
}

GridResult answer(const Question& asked, const std::string& without)
{
    GridSettings settings = asked.settings;
    Preparation preparation;
    if (!without.empty())
        switch_off(without, settings.techniques, preparation);
    return Simulation(asked.scene(), preparation).illuminance(asked.grid, settings);
}

/// The rays that the result rests on: those that chose the samples and checked the bias are not among them.
Bought bought(const WorkCounts& work, double rms)
{
    RayCounts rays = work.ambient_rays;
    rays += work.value_rays;
    return {static_cast<double>(rays.total()), static_cast<double>(rays.shadow), rms};
}

Bought measure(const Question& asked, const std::string& without)
{
    const GridResult result = answer(asked, without);
    return bought(result.work, relative_rms(result.values, asked.reference));
}

/// What an error of 1 % would take: that of independent samples falls with the root of their number.
double rays_for_one_percent(const Bought& found)
{
    return found.rays * found.rms * found.rms / 1e-4;
}

/// Prints a row of the table.
void tell(const std::string& technique, const Pair& pair)
{
    std::printf("| `%s` | %.0f | %.0f | %.3g | %.3g |\n", technique.c_str(), pair.with.rays / 1e3,
                pair.without.rays / 1e3, 100 * pair.with.rms, 100 * pair.without.rms);
}

Pair compare(const std::string& technique, const Question& asked)
{
    const Pair pair{measure(asked, ""), measure(asked, technique)};
    tell(technique, pair);
    return pair;
}

std::vector<double> lux(const GridResult& result)
{
    std::vector<double> values;
    for (const Illuminance& value : result.values)
        values.push_back(value.value);
    return values;
}

ModifierId grey(Scene& scene, const std::string& name, double reflectance)
{
    return scene.add_material(name, Plastic{Spectrum::grey(reflectance), 0, 0});
}

ModifierId lamp_of(Scene& scene, double luminance_cd_per_m2)
{
    return scene.add_material("lamp", Light{Spectrum::grey(luminance_cd_per_m2 / lumens_per_watt)});
}

std::vector<Point> level(double x0, double y0, double x1, double y1, double z)
{
    return {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
}

/// Facing down.
std::vector<Point> panel(double x0, double y0, double x1, double y1, double z)
{
    return {{x0, y0, z}, {x0, y1, z}, {x1, y1, z}, {x1, y0, z}};
}

void add_room(Scene& scene, double x, double y, double z, ModifierId floor, ModifierId wall, ModifierId ceiling)
{
    scene.root.add_polygon(level(0, 0, x, y, 0), floor, "floor");
    scene.root.add_polygon(level(0, 0, x, y, z), ceiling, "ceiling");
    scene.root.add_polygon({{0, 0, 0}, {x, 0, 0}, {x, 0, z}, {0, 0, z}}, wall, "y0");
    scene.root.add_polygon({{0, y, 0}, {x, y, 0}, {x, y, z}, {0, y, z}}, wall, "y1");
    scene.root.add_polygon({{0, 0, 0}, {0, y, 0}, {0, y, z}, {0, 0, z}}, wall, "x0");
    scene.root.add_polygon({{x, 0, 0}, {x, y, 0}, {x, y, z}, {x, 0, z}}, wall, "x1");
}

/// Evenly spread over a rectangle, facing up.
SensorGrid desks(int columns, int rows, double x, double y, double z)
{
    SensorGrid grid;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            grid.sensors.push_back({{x * (column + 0.5) / columns, y * (row + 0.5) / rows, z}, {0, 0, 1}});
    grid.spacing_m = x / columns;
    return grid;
}

GridSettings samples(int count, double accuracy = 0.05)
{
    GridSettings settings;
    settings.samples = count;
    settings.accuracy = accuracy;
    return settings;
}

/// A black hall of 225 small lamps 3 m apart, with partitions between the desks.
Scene hall()
{
    Scene scene;
    const ModifierId black = grey(scene, "black", 0), lamp = lamp_of(scene, 1e4);
    scene.root.add_polygon(level(0, 0, 45, 45, 0), black, "floor");
    for (int row = 0; row < 15; ++row)
        for (int column = 0; column < 15; ++column)
            scene.root.add_sphere({{1.5 + 3.0 * column, 1.5 + 3.0 * row, 3}, 0.1}, Shape::sphere, lamp, "lamp");
    for (int i = 1; i < 9; ++i)
        scene.root.add_polygon({{5.0 * i, 0, 0}, {5.0 * i, 45, 0}, {5.0 * i, 45, 1.8}, {5.0 * i, 0, 1.8}}, black,
                               "partition");
    return scene;
}

/// Source  Ward 1994, Section 3.3: fewer shadow rays at an error that the threshold bounds
TEST(Without, AdaptiveTestingCostsShadowRaysAndGainsLessThanTheThreshold)
{
    Question asked{hall, desks(7, 7, 45, 45, 0.01), samples(8), {}};
    asked.reference = lux(answer(asked, "adaptive"));
    const Pair pair = compare("adaptive", asked);
    EXPECT_LT(pair.with.shadow_rays, 0.7 * pair.without.shadow_rays);
    EXPECT_LT(pair.with.rms, 0.05);
    EXPECT_GT(pair.with.rms, 0) << "nothing was left untested";
}

/// A black screen hides one half of a panel 4 m long from sensors below its edge: half of the light of all of it.
Scene screened_panel()
{
    Scene scene;
    const ModifierId black = grey(scene, "black", 0);
    scene.root.add_polygon(panel(-0.5, -2, 0.5, 2, 1), lamp_of(scene, 1000), "panel");
    scene.root.add_polygon(level(0, -50, 50, 50, 0.5), black, "screen");
    return scene;
}

/// Illuminance by a rectangle overhead, one corner right above the sensor.
/// Source  Lambert 1760
double under_a_corner(double luminance, double a, double b, double height)
{
    const double p = a / height, q = b / height;
    const double one = p / std::sqrt(1 + p * p) * std::atan(q / std::sqrt(1 + p * p));
    const double other = q / std::sqrt(1 + q * q) * std::atan(p / std::sqrt(1 + q * q));
    return 0.5 * luminance * (one + other);
}

TEST(Without, SubdivisionALongLampInAPenumbraIsNoisy)
{
    Question asked{screened_panel, {}, samples(8), {}};
    for (double y : {-1.8, -1.2, -0.6, 0.0, 0.6, 1.2, 1.8}) {
        asked.grid.sensors.push_back({{0, y, 0}, {0, 0, 1}});
        asked.reference.push_back(under_a_corner(1000, 0.5, 2 - y, 1) + under_a_corner(1000, 0.5, 2 + y, 1));
    }
    const Pair pair = compare("subdivision", asked);
    EXPECT_GT(pair.without.rms, 2 * pair.with.rms) << "at the same number of samples";
    EXPECT_LT(pair.without.shadow_rays, pair.with.shadow_rays) << "which is what it costs";
    EXPECT_LT(pair.with.rms, 0.05);
}

Scene bare_panel()
{
    Scene scene;
    scene.root.add_polygon(panel(-0.5, -2, 0.5, 2, 1), lamp_of(scene, 1000), "panel");
    return scene;
}

TEST(Without, ClosedFormsLightOfANearPanelIsNoisy)
{
    Question asked{bare_panel, {}, samples(8), {}};
    for (double y : {-1.8, -1.2, -0.6, 0.0, 0.6, 1.2, 1.8}) {
        asked.grid.sensors.push_back({{0, y, 0}, {0, 0, 1}});
        asked.reference.push_back(2 * (under_a_corner(1000, 0.5, 2 - y, 1) + under_a_corner(1000, 0.5, 2 + y, 1)));
    }
    const Pair pair = compare("analytic", asked);
    EXPECT_LT(pair.with.rms, 1e-6);
    EXPECT_GT(pair.without.rms, 1e-4);
}

/// A ball of 5 cm shines on the floor past a mirror of two metres.
constexpr Point mirror_lamp{2, 0, 3};
Scene mirrored_ball()
{
    Scene scene;
    scene.root.add_sphere({mirror_lamp, 0.05}, Shape::sphere, lamp_of(scene, 1e5), "ball");
    scene.root.add_polygon({{0, -50, -50}, {0, 50, -50}, {0, 50, 50}, {0, -50, 50}},
                           scene.add_material("mirror", Mirror{Spectrum::grey(0.9)}), "mirror");
    return scene;
}

/// Source  Ward 1994, Section 3.4: without virtual sources, light by way of a mirror is left to chance
TEST(Without, VirtualSourcesLightByWayOfAMirrorIsLeftToChance)
{
    Question asked{mirrored_ball, {}, samples(256), {}};
    const auto ball = [](const Point& at, const Point& from) { // all of it above the horizon
        const Vec3 to = at - from;
        return pi * 1e5 * 0.05 * 0.05 * to.z / std::pow(length(to), 3);
    };
    for (double x : {0.5, 1.0, 1.5, 2.0, 2.5, 3.0}) {
        const Point at{x, 0.3, 0};
        asked.grid.sensors.push_back({at, {0, 0, 1}});
        asked.reference.push_back(ball(mirror_lamp, at) + 0.9 * ball({-mirror_lamp.x, 0, mirror_lamp.z}, at));
    }
    const Pair pair = compare("virtual", asked);
    EXPECT_LT(pair.with.rms, 0.002);
    EXPECT_GT(pair.without.rms, 10 * pair.with.rms);
}

/// A thousand lamps above a floor.
Scene thousand_lamps()
{
    Scene scene;
    const ModifierId black = grey(scene, "black", 0), lamp = lamp_of(scene, 1e4);
    scene.root.add_polygon(level(0, 0, 64, 64, 0), black, "floor");
    for (int row = 0; row < 32; ++row)
        for (int column = 0; column < 32; ++column)
            scene.root.add_sphere({{1 + 2.0 * column, 1 + 2.0 * row, 3}, 0.05}, Shape::sphere, lamp, "lamp");
    return scene;
}

TEST(Without, TheTreeOfLampsEachOfAThousandIsTested)
{
    Question asked{thousand_lamps, desks(5, 5, 64, 64, 0.01), samples(8), {}};
    GridSettings finer = asked.settings;
    finer.samples = 64;
    asked.reference = lux(answer({asked.scene, asked.grid, finer, {}}, "tree"));
    const Pair pair = compare("tree", asked);
    EXPECT_LT(pair.with.shadow_rays, 0.7 * pair.without.shadow_rays);
    EXPECT_LT(pair.with.rms, 0.1);
}

/// A room that uplights light by way of its ceiling.
Scene uplit_room()
{
    Scene scene;
    const ModifierId floor = grey(scene, "floor", 0.3), wall = grey(scene, "wall", 0.6),
                     ceiling = grey(scene, "ceiling", 0.8);
    add_room(scene, 6, 4, 3, floor, wall, ceiling);
    const ModifierId lamp = lamp_of(scene, 2e4);
    for (const double x : {1.0, 5.0})
        scene.root.add_polygon(level(x, 1.9, x + 0.2, 2.1, 2), lamp, "uplight");
    scene.root.add_polygon(level(2.4, 1, 3.6, 3, 0.75), floor, "table");
    return scene;
}

/// Twenty sensors of the grid, by hemispheres of their own and many rays.
std::vector<double> by_many_rays(Scene (*scene)(), const SensorGrid& grid, std::size_t step)
{
    SensorGrid some;
    for (std::size_t i = 0; i < grid.sensors.size(); i += step)
        some.sensors.push_back(grid.sensors[i]);
    return lux(Simulation(scene()).illuminance(some, samples(4096, 0.003)));
}

/// Error of every step-th sensor.
Bought measure_some(const Question& asked, std::size_t step, const std::string& without)
{
    GridResult result = answer(asked, without);
    std::vector<Illuminance> some;
    for (std::size_t i = 0; i < result.values.size(); i += step)
        some.push_back(result.values[i]);
    return bought(result.work, relative_rms(some, asked.reference));
}

/// Source  Ward 1994, Section 3.2: records are shared, gradients make them reach further, and (later than the paper)
/// Hessians put them where they are needed
TEST(Without, TheCacheAmbientLightCostsMoreRaysAndWithoutGradientsItIsWorse)
{
    constexpr std::size_t step = 101;
    Question asked{uplit_room, desks(56, 40, 6, 4, 0.76), {}, {}};
    asked.settings.accuracy = 0.1;
    asked.reference = by_many_rays(asked.scene, asked.grid, step);
    const Bought with = measure_some(asked, step, "");
    const Pair cache{with, measure_some(asked, step, "cache")};
    const Pair gradients{with, measure_some(asked, step, "gradients")};
    const Pair hessian{with, measure_some(asked, step, "hessian")};
    tell("cache", cache);
    tell("gradients", gradients);
    tell("hessian", hessian);
    EXPECT_LT(with.rms, 0.1);
    EXPECT_GT(rays_for_one_percent(cache.without), 3 * rays_for_one_percent(with));
    EXPECT_GT(gradients.without.rms, 1.3 * with.rms);
    EXPECT_GT(hessian.without.rays, 1.1 * with.rays);
}

TEST(Without, AmbientLightByScatteredRaysAloneIsNoisierAtTheSameCost)
{
    Question asked{uplit_room, desks(6, 4, 6, 4, 0.76), samples(1024), {}};
    asked.reference = by_many_rays(asked.scene, asked.grid, 1);
    const Pair pair = compare("ambient", asked);
    EXPECT_GT(rays_for_one_percent(pair.without), 2 * rays_for_one_percent(pair.with));
}

TEST(Without, ImageSamplingEveryPixelHasPathsOfItsOwn)
{
    View view;
    view.position = {0.3, 0.3, 1.6};
    view.direction = {1, 0.6, -0.2};
    view.horizontal = 70;
    view.vertical = 70;
    PictureSettings settings;
    settings.width = settings.height = 96;
    settings.samples = 32;
    settings.accuracy = 0.1;
    const Simulation simulation(uplit_room());
    const PictureResult with = simulation.render(view, settings);
    Preparation preparation;
    switch_off("image", settings.techniques, preparation);
    const PictureResult without = simulation.render(view, settings);
    double squares = 0, sum = 0;
    const auto& g = without.picture.channels.at("G");
    for (std::size_t i = 0; i < g.size(); ++i) {
        squares += std::pow(static_cast<double>(with.picture.channels.at("G")[i]) - static_cast<double>(g[i]), 2);
        sum += static_cast<double>(g[i]);
    }
    const double rms = std::sqrt(squares * static_cast<double>(g.size())) / sum;
    const double few = static_cast<double>(with.work.value_rays.total());
    const double all = static_cast<double>(without.work.value_rays.total());
    tell("image", {{few, 0, rms}, {all, 0, 0}});
    EXPECT_LT(few, 0.7 * all);
    EXPECT_LT(rms, settings.accuracy);
}

} // namespace
} // namespace lightwell
