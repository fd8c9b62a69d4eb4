#include "tests/analytic/expect.h"

namespace lightwell {
namespace {

/// A room with a lamp box in one corner and a step in the floor: corners, edges and a gradient everywhere.
Simulation room()
{
    Scene scene;
    const ModifierId white = scene.add_material("white", Plastic{{0.8, 0.7, 0.6}, 0, 0});
    const ModifierId lamp = scene.add_material("lamp", Light{Spectrum::grey(20)});
    const auto box = [&](const Point& a, const Point& b, ModifierId m) {
        const Box c{a, b};
        const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
        for (const auto& f : faces)
            scene.root.add_polygon({c.corner(f[0]), c.corner(f[1]), c.corner(f[2]), c.corner(f[3])}, m, "face");
    };
    box({0, 0, 0}, {5, 4, 3}, white);
    box({3, 2, 0.001}, {4.5, 3.5, 0.8}, white);
    scene.root.add_polygon({{0.2, 3.2, 2.9}, {0.2, 3.8, 2.9}, {1.4, 3.8, 2.9}, {1.4, 3.2, 2.9}}, lamp, "lamp");
    return Simulation(std::move(scene));
}

PictureResult picture(const Simulation& simulation, int samples, bool unbiased)
{
    PictureSettings settings;
    settings.width = 96;
    settings.height = 72;
    settings.samples = samples;
    settings.unbiased = unbiased;
    View view;
    view.position = {0.4, 0.4, 1.6};
    view.direction = {0.7, 0.7, -0.15};
    view.horizontal = 75;
    view.vertical = 60;
    return simulation.render(view, settings);
}

double luminance(const Picture& p, int x, int y)
{
    return luminance_of({p.at("R", x, y), p.at("G", x, y), p.at("B", x, y)}).value;
}

/// The plain picture with 16 times the samples is the reference. Means over blocks of 12 x 12 pixels agree within 2 %
/// (noise of a block below 0.4 %), while the stated error of single pixels falls to less than half.
TEST(SharedIrradiance, KeepsTheMeansOfSmallBlocksAndLowersTheNoise)
{
    const Simulation simulation = room();
    const PictureResult plain = picture(simulation, 16, true), shared = picture(simulation, 16, false),
                        reference = picture(simulation, 256, true);
    EXPECT_LT(shared.median_relative_error, 0.5 * plain.median_relative_error);
    EXPECT_LT(shared.sharing_bias, 0.02);
    constexpr int block = 12;
    for (int y = 0; y < 72; y += block)
        for (int x = 0; x < 96; x += block) {
            double found = 0, expected = 0;
            for (int v = y; v < y + block; ++v)
                for (int u = x; u < x + block; ++u) {
                    found += luminance(shared.picture, u, v);
                    expected += luminance(reference.picture, u, v);
                }
            EXPECT_NEAR(found / expected, 1, 0.02) << "block at " << x << ", " << y;
        }
}

/// The error that sharing states is the error that it has: pixels deviate from the reference by one stated standard
/// error in the root mean square, within a third (bias included).
TEST(SharedIrradiance, StatesTheErrorThatItHas)
{
    const Simulation simulation = room();
    const Picture shared = picture(simulation, 16, false).picture, reference = picture(simulation, 512, true).picture;
    double squares = 0;
    int count = 0;
    for (int y = 0; y < 72; ++y)
        for (int x = 0; x < 96; ++x) {
            const double error = std::hypot(shared.at("error.Y", x, y), reference.at("error.Y", x, y));
            if (!(error > 0))
                continue;
            const double z = (luminance(shared, x, y) - luminance(reference, x, y)) / error;
            squares += std::min(z * z, 25.0); // eight replicates have a heavy tail
            ++count;
        }
    EXPECT_NEAR(std::sqrt(squares / count), 1, 0.34);
}

TEST(SharedIrradiance, HidesNothingBehindAThinWall)
{
    Scene scene;
    const ModifierId white = scene.add_material("white", Plastic{Spectrum::grey(0.8), 0, 0});
    const auto quad = [&](const std::vector<Point>& corners) { scene.root.add_polygon(corners, white, "q"); };
    quad({{-4, 0, 0}, {4, 0, 0}, {4, 4, 0}, {-4, 4, 0}});
    // A closed dark box of 1 mm walls stands on a floor that is lit outside.
    for (const double x : {1.0, 1.001, 3.0, 3.001})
        quad({{x, 1, 0}, {x, 3, 0}, {x, 3, 2}, {x, 1, 2}});
    for (const double y : {1.0, 3.0})
        quad({{1, y, 0}, {3.001, y, 0}, {3.001, y, 2}, {1, y, 2}});
    quad({{1, 1, 2}, {3.001, 1, 2}, {3.001, 3, 2}, {1, 3, 2}});
    scene.root.add_source({{0, 0, 1}, 180}, scene.add_material("sky", Glow{Spectrum::grey(10), 0}), "sky");
    const Simulation simulation(std::move(scene));
    PictureSettings settings;
    settings.width = settings.height = 32;
    settings.samples = 8;
    View inside;
    inside.position = {2, 2, 1};
    inside.direction = {1, 0.2, -0.4};
    inside.horizontal = inside.vertical = 80;
    const Picture dark = simulation.render(inside, settings).picture;
    for (const float value : dark.channels.at("G"))
        EXPECT_EQ(value, 0);
}

} // namespace
} // namespace lightwell
