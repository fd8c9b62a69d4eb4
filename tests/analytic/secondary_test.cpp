#include "tests/analytic/expect.h"

#include "engine/base/errors.h"

namespace lightwell {
namespace {

constexpr double luminance = 1000; // cd/m^2

Spectrum radiance_of(double cd_per_m2)
{
    return Spectrum::grey(cd_per_m2 / lumens_per_watt);
}

void add_polygon(Scene& scene, ModifierId modifier, std::initializer_list<Point> corners)
{
    scene.root.add_polygon(std::vector<Point>(corners), modifier, "surface");
}

enum class Opening { pane, sheet };

/// A room of 4 x 4 x 3 m whose south wall, y = 0, has an opening.
struct Room {
    Scene scene;
    ModifierId walls, opening;

    Room(double reflectance, Opening kind)
        : walls(scene.add_material("walls", Plastic{Spectrum::grey(reflectance), 0, 0})),
          opening(kind == Opening::pane ? scene.add_material("opening", Glass{Spectrum::grey(0.9), 1.52})
                                        : scene.add_material("opening", Illum{Spectrum::grey(1), "void"}))
    {
        add_polygon(scene, walls, {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}});
        add_polygon(scene, walls, {{0, 0, 3}, {0, 4, 3}, {4, 4, 3}, {4, 0, 3}});
        add_polygon(scene, walls, {{0, 0, 0}, {0, 4, 0}, {0, 4, 3}, {0, 0, 3}});
        add_polygon(scene, walls, {{4, 0, 0}, {4, 0, 3}, {4, 4, 3}, {4, 4, 0}});
        add_polygon(scene, walls, {{0, 4, 0}, {4, 4, 0}, {4, 4, 3}, {0, 4, 3}});
    }
    /// An opening from x to 4 - x and from z to 3 - z, the rest of the south wall closed.
    void close_south(double x, double z)
    {
        if (x > 0) {
            add_polygon(scene, walls, {{0, 0, 0}, {0, 0, 3}, {x, 0, 3}, {x, 0, 0}});
            add_polygon(scene, walls, {{4 - x, 0, 0}, {4 - x, 0, 3}, {4, 0, 3}, {4, 0, 0}});
            add_polygon(scene, walls, {{x, 0, 0}, {x, 0, z}, {4 - x, 0, z}, {4 - x, 0, 0}});
            add_polygon(scene, walls, {{x, 0, 3 - z}, {x, 0, 3}, {4 - x, 0, 3}, {4 - x, 0, 3 - z}});
        }
        add_polygon(scene, opening, {{x, 0, z}, {x, 0, 3 - z}, {4 - x, 0, 3 - z}, {4 - x, 0, z}});
    }
};

/// Behind a small opening: louvres and a court in the sun, nothing of the sky.
Scene room_behind_louvres(Opening kind)
{
    Room room(0.5, kind);
    room.close_south(1.6, 1.2);
    Scene& scene = room.scene;
    const ModifierId court = scene.add_material("court", Plastic{Spectrum::grey(0.4), 0, 0});
    add_polygon(scene, court, {{-8, -8, -0.5}, {12, -8, -0.5}, {12, 0, -0.5}, {-8, 0, -0.5}});
    constexpr int louvres = 6;
    for (int i = 0; i < louvres; ++i) {
        const double z = 1.2 + 0.6 * i / louvres;
        add_polygon(scene, court, {{1.5, -0.05, z + 0.05}, {2.5, -0.05, z + 0.05}, {2.5, -0.15, z}, {1.5, -0.15, z}});
    }
    scene.root.add_source({normalized({0.2, -0.6, 1}), 0.53}, scene.add_material("sun", Light{radiance_of(1e9)}),
                          "sun");
    return scene;
}

Preparation with_secondary(bool on)
{
    Preparation preparation;
    preparation.secondary.modifiers = {"opening"};
    preparation.secondary.on = on;
    return preparation;
}

SensorGrid desks()
{
    SensorGrid grid;
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 4; ++k)
            grid.sensors.push_back({{0.5 + i, 0.5 + k, 0.8}, {0, 0, 1}});
    return grid;
}

struct Mean {
    Found found = {}; ///< over the sensors
    double noise = 0; ///< of single sensors: root mean square of standard error / value
    std::size_t aimed_at = 0;
};

Mean mean_of(const Simulation& simulation, const SensorGrid& grid, int samples, std::uint64_t seed, bool unbiased,
             double accuracy = 0.02)
{
    GridSettings settings;
    settings.accuracy = accuracy;
    settings.samples = samples;
    settings.seed = seed;
    settings.unbiased = unbiased;
    const GridResult result = simulation.illuminance(grid, settings);
    Mean mean{};
    const auto count = static_cast<double>(grid.sensors.size());
    for (std::size_t i = 0; i < grid.sensors.size(); ++i) {
        mean.found.value += result.values[i].value / count;
        mean.noise += std::pow(result.standard_errors[i].value / result.values[i].value, 2) / count;
    }
    mean.noise = std::sqrt(mean.noise);
    mean.found.error = result.mean_standard_error.value;
    mean.aimed_at = result.work.secondary_sources;
    return mean;
}

/// Runs with seeds of their own, averaged, that all aim at the one opening.
Found pooled(const Simulation& simulation, int samples)
{
    Found found{};
    for (std::uint64_t run = 0; run < pooled_runs; ++run) {
        const Mean one = mean_of(simulation, desks(), samples, 2 + run, false, 0.1);
        EXPECT_EQ(one.aimed_at, 1u);
        found.value += one.found.value / pooled_runs;
        found.error = std::hypot(found.error, one.found.error / pooled_runs);
    }
    return found;
}

/// Everything is white and all round shines uniformly, so every ray finds the same radiance, scattered or not: E = pi
/// L.
TEST(SecondarySource, AWhiteFurnaceDoesNotChangeWhenItsWindowBecomesOne)
{
    for (const Opening kind : {Opening::pane, Opening::sheet}) {
        Room room(1, kind);
        room.close_south(0, 0);
        if (kind == Opening::pane)
            room.scene.modifiers[static_cast<std::size_t>(room.opening)].what = Material{Glass{Spectrum::grey(1), 1}};
        const ModifierId screen = room.scene.add_material("screen", Plastic{Spectrum::grey(1), 0, 0});
        add_polygon(room.scene, screen, {{-2, -1.5, -1}, {6, -1.5, -1}, {6, -1.5, 2}, {-2, -1.5, 2}});
        room.scene.root.add_source({{0, 0, 1}, 360}, room.scene.add_material("all", Glow{radiance_of(luminance), 0}),
                                   "all");
        const Found found = pooled(Simulation(room.scene, with_secondary(true)), 1 << 10);
        expect_agrees(found, pi * luminance, 0.1, 1e-9, pooled_interval);
    }
}

/// Light that the sun gives to a court and louvres: by aimed rays as by plain paths, through a pane that reflects and
/// through nothing.
TEST(SecondarySource, TheFluxThroughAnOpeningIsNeitherDoubledNorLost)
{
    for (const Opening kind : {Opening::pane, Opening::sheet}) {
        SCOPED_TRACE(kind == Opening::pane ? "pane" : "sheet");
        const Simulation simulation(room_behind_louvres(kind), with_secondary(true));
        const Found plain = mean_of(simulation, desks(), 1 << 16, 1, true).found;
        const Found aimed = pooled(simulation, 1 << 12);
        expect_agrees({aimed.value, std::hypot(aimed.error, plain.error)}, plain.value, 0.4, 0.01, pooled_interval);
    }
}

/// Ward 1994, Section 3.5: fewer samples for the same noise behind a complicated opening.
TEST(SecondarySource, BehindLouvresAimedRaysReachTheNoiseOfManyTimesTheSamples)
{
    const Scene scene = room_behind_louvres(Opening::sheet);
    const Mean with = mean_of(Simulation(scene, with_secondary(true)), desks(), 256, 1, false, 0.2);
    const Mean without = mean_of(Simulation(scene, with_secondary(false)), desks(), 1024, 1, false, 0.2);
    EXPECT_EQ(without.aimed_at, 0u);
    EXPECT_LT(with.noise, without.noise) << "with a quarter of the samples";
    RecordProperty("noise_with_256", std::to_string(with.noise));
    RecordProperty("noise_without_1024", std::to_string(without.noise));
}

TEST(SecondarySource, AutomaticOnesAreThoseThatMuchMoreLightComesThroughFromOneSide)
{
    Preparation all;
    all.secondary.all_panes = true;
    EXPECT_EQ(mean_of(Simulation(room_behind_louvres(Opening::pane), all), desks(), 8, 1, false, 0.2).aimed_at, 1u);
    Room room(0.5, Opening::pane);
    room.close_south(1.6, 1.2);
    EXPECT_EQ(mean_of(Simulation(room.scene, all), desks(), 8, 1, false, 0.2).aimed_at, 0u) << "no light at all";
    EXPECT_EQ(mean_of(Simulation(room_behind_louvres(Opening::pane)), desks(), 8, 1, false, 0.2).aimed_at, 0u)
        << "none unless asked for";
}

TEST(SecondarySource, WhatIsNoOpeningIsRefusedByName)
{
    for (const auto& [name, text] : {std::pair<std::string, std::string>{"walls", "expected glass or illum"},
                                     {"nowhere", "no modifier of the scene"},
                                     {"unused", "no flat surface"}}) {
        Scene scene = room_behind_louvres(Opening::pane);
        scene.add_material("unused", Glass{Spectrum::grey(1), 1.52});
        Preparation preparation;
        preparation.secondary.modifiers = {name};
        try {
            const Simulation simulation(std::move(scene), preparation);
            ADD_FAILURE() << name;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
        }
    }
}

} // namespace
} // namespace lightwell
