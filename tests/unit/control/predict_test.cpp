#include "engine/control/predict.h"
#include "engine/control/stage_clock.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightwell {
namespace {

/// A run of a made-up simulation: ambient light takes 1e4 / accuracy rays of 2e-6 s, choosing and checking 2e5 rays and
/// half a second, a sample two rays and 1e-6 s; 0.04 / accuracy^2 samples bring the error to 0.9 of the accuracy.
PilotRun made_up(double accuracy)
{
    const double samples = 0.04 / (accuracy * accuracy), rays = 1e4 / accuracy, taken = 100 * samples;
    return {accuracy, 100, samples, 0.9 * accuracy, {rays, 2e-6 * rays}, {2e5, 0.5}, {2 * taken, 1e-6 * taken}};
}

TEST(CostModel, ContinuesTwoRunsByTheirOwnLaws)
{
    const CostModel model = fit({made_up(0.04), made_up(0.02)});
    EXPECT_NEAR(model.samples_at(0.01), 400, 1e-9);
    EXPECT_NEAR(model.error_at(0.01), 0.009, 1e-12);
    EXPECT_NEAR(model.ambient_s(0.01), 2, 1e-9);
    EXPECT_NEAR(model.seconds(0.01, 1000), 2 + 0.5 + 1e-6 * 1000 * 400, 1e-9);
    EXPECT_NEAR(model.rays(0.01, 1000), 1e6 + 2e5 + 2.0 * 1000 * 400, 1e-3);
}

TEST(CostModel, OfOneRunAssumesThatWorkGrowsByTheInverseSquare)
{
    const CostModel model = fit({made_up(0.02)});
    EXPECT_NEAR(model.samples_at(0.01), 400, 1e-9);
    EXPECT_NEAR(model.error_at(0.01), 0.009, 1e-12);
}

TEST(CostModel, NoiseInThePilotDoesNotRunAway)
{
    PilotRun odd = made_up(0.02);
    odd.samples = 10; // fewer than the coarser run took
    odd.error = 0.5;  // and worse
    odd.ambient = {1e6, 1};
    const CostModel model = fit({made_up(0.04), odd});
    EXPECT_LE(model.samples_at(0.01), 10 * 8);
    EXPECT_LE(model.error_at(0.01), 0.5);
    EXPECT_LE(model.ambient_rays(0.01), 8e6);
    for (const double accuracy : {1e-4, 0.01, 0.5})
        EXPECT_TRUE(std::isfinite(model.seconds(accuracy, 1e9)));
}

TEST(CostModel, FewestSamplesSufficeUntilTheErrorWouldExceedTheAccuracy)
{
    PilotRun easy = made_up(0.04);
    easy.samples = 8;
    easy.error = 0.01; // falls with the square root of the accuracy: 0.005 at 0.01, 0.00125 at 0.000625
    const CostModel model = fit({easy});
    EXPECT_NEAR(model.samples_at(0.01), 8, 1e-9);
    EXPECT_NEAR(model.error_at(0.01), 0.005, 1e-9);
    EXPECT_NEAR(model.samples_at(0.000625), 8 * 4, 1e-6);
    EXPECT_NEAR(model.error_at(0.000625), 0.000625, 1e-9);
}

TEST(AccuracyWithin, IsWhatTheTimeBuys)
{
    const CostModel model = fit({made_up(0.04), made_up(0.02)});
    for (const double accuracy : {0.01, 0.05, 0.2})
        EXPECT_NEAR(accuracy_within(model, 1000, model.seconds(accuracy, 1000)), accuracy, 1e-6);
    EXPECT_NEAR(accuracy_within(model, 1000, 0), 0.5, 1e-6) << "no time: the coarsest";
    EXPECT_NEAR(accuracy_within(model, 1000, 1e12), 1e-4, 1e-6);
}

TEST(StageClock, GivesTimeToTheStageThatSpentIt)
{
    const Progress silent;
    StageClock clock(silent);
    const Progress progress = clock.progress();
    const auto burn = [](double seconds) {
        for (const double end = process_cpu_seconds() + seconds; process_cpu_seconds() < end;) {
        }
    };
    burn(0.02); // before the first report: the first stage's
    progress.tell("ambient light, grid a", 0);
    burn(0.03);
    progress.tell("grid a", 0.5);
    burn(0.01);
    clock.stop();
    EXPECT_NEAR(clock.seconds("ambient light"), 0.05, 0.005);
    EXPECT_NEAR(clock.seconds("grid"), 0.01, 0.005);
    EXPECT_NEAR(clock.total(), 0.06, 0.007);
}

/// A floor under a lamp with a shade between: noise, ambient light, and a few seconds for all of it.
Scene lamp_room()
{
    Scene scene;
    const ModifierId grey = scene.add_material("grey", Plastic{Spectrum::grey(0.6)});
    const ModifierId lamp = scene.add_material("lamp", Light{Spectrum::grey(20)});
    scene.root.add_sphere({{0, 0, 0}, 3}, Shape::bubble, grey, "room");
    scene.root.add_sphere({{0, 0, 1}, 0.4}, Shape::sphere, lamp, "lamp");
    scene.root.add_ring({{0.2, 0, 0.3}, {0, 0, 1}, 0, 0.3}, grey, "shade");
    return scene;
}

SensorGrid line_of_sensors(int count)
{
    SensorGrid grid;
    for (int i = 0; i < count; ++i)
        grid.sensors.push_back({{-1.5 + 3.0 * i / count, 0.1, -1}, {0, 0, 1}});
    return grid;
}

/// Rays, not seconds: the same for each run of the test, on any machine.
template <class Result>
void expect_within_a_factor_of_two(const Prediction& expected, const Result& result)
{
    const double rays = expected.rays / static_cast<double>(result.work.rays().total());
    const double error = expected.error / result.median_relative_error;
    for (const double ratio : {rays, error}) {
        EXPECT_GT(ratio, 0.5) << "rays " << rays << ", error " << error << ", samples " << expected.samples << " for "
                              << result.samples;
        EXPECT_LT(ratio, 2) << "rays " << rays << ", error " << error << ", samples " << expected.samples << " for "
                            << result.samples;
    }
}

TEST(Predict, CostAndErrorOfAMapAreRightWithinAFactorOfTwo)
{
    const Simulation simulation(lamp_room());
    const SensorGrid grid = line_of_sensors(200);
    GridSettings settings;
    settings.accuracy = 0.005;
    const Prediction expected = predict(simulation, grid, settings, 5e5);
    expect_within_a_factor_of_two(expected, simulation.illuminance(grid, settings));
}

TEST(Predict, IsTheSameEachTimeButForTheSeconds)
{
    const Simulation simulation(lamp_room());
    GridSettings settings;
    settings.accuracy = 0.03;
    settings.threads = 1;
    const Prediction one = predict(simulation, line_of_sensors(100), settings, 1e5);
    settings.threads = 2;
    const Prediction two = predict(simulation, line_of_sensors(100), settings, 1e5);
    EXPECT_EQ(one.rays, two.rays);
    EXPECT_EQ(one.pilot.rays, two.pilot.rays);
    EXPECT_EQ(one.error, two.error);
    EXPECT_EQ(one.samples, two.samples);
    EXPECT_GT(one.cpu_seconds, 0);
    EXPECT_GT(two.cpu_seconds, 0);
}

TEST(Predict, CostOfAMapWhoseSensorsShareAmbientLightIsRightWithinAFactorOfTwo)
{
    const Simulation simulation(lamp_room());
    const SensorGrid grid = line_of_sensors(12000);
    GridSettings settings;
    settings.accuracy = 0.1;
    const Prediction expected = predict(simulation, grid, settings, 1e5);
    expect_within_a_factor_of_two(expected, simulation.illuminance(grid, settings));
}

TEST(Predict, CostOfAPictureIsRightWithinAFactorOfTwoAndARegionCostsLess)
{
    const Simulation simulation(lamp_room());
    View view;
    view.position = {-2, 0, 0};
    view.direction = {1, 0, 0};
    PictureSettings settings;
    settings.width = settings.height = 288;
    settings.accuracy = 0.1;
    const Prediction whole = predict(simulation, view, settings, 2e5);
    expect_within_a_factor_of_two(whole, simulation.render(view, settings));
    settings.region = {100, 100, 60, 60};
    EXPECT_LT(predict(simulation, view, settings, 2e5).rays, 0.8 * whole.rays);
}

TEST(Predict, TheSamplesThatWereGivenAreTaken)
{
    const Simulation simulation(lamp_room());
    GridSettings settings;
    settings.samples = 512;
    settings.threads = 1;
    const Prediction expected = predict(simulation, line_of_sensors(100), settings, 2e5);
    EXPECT_EQ(expected.samples, 512);
    const GridResult result = simulation.illuminance(line_of_sensors(100), settings);
    EXPECT_GT(expected.error, 0.5 * result.median_relative_error);
    EXPECT_LT(expected.error, 2 * result.median_relative_error);
}

} // namespace
} // namespace lightwell
