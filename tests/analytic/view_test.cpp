#include "engine/base/errors.h"
#include "tests/analytic/expect.h"

#include <algorithm>
#include <bit>
#include <functional>

namespace lightwell {
namespace {

Simulation luminous(const std::function<void(Scene&)>& fill)
{
    Scene scene;
    fill(scene);
    return Simulation(std::move(scene));
}

void add_wall(Scene& scene, double y, double x0, double x1, double radiance)
{
    constexpr double tall = 100;
    const ModifierId light = scene.add_material("light", Light{Spectrum::grey(radiance)});
    scene.root.add_polygon({{x0, y, -tall}, {x1, y, -tall}, {x1, y, tall}, {x0, y, tall}}, light, "wall");
}

PictureSettings settings_of(int width, int height, int samples)
{
    PictureSettings settings;
    settings.width = width;
    settings.height = height;
    settings.samples = samples;
    settings.unbiased = true;
    return settings;
}

/// The smallest and the largest value of the red channel.
std::pair<float, float> range(const Picture& picture)
{
    const std::vector<float>& red = picture.channels.at("R");
    const auto [low, high] = std::minmax_element(red.begin(), red.end());
    return {*low, *high};
}

} // namespace

/// A luminous half plane x < 0 at 4 m, a lens of radius R in focus at 2 m: the ray through the point a of the lens
/// meets the plane at x - a where the one through its middle meets it at x, so that the picture shows the share of the
/// lens with a > x, a segment of its disc: (acos t - t sqrt(1 - t^2)) / pi with t = x / R.
TEST(DepthOfField, BlursAnEdgeByTheDiscOfTheLens)
{
    const Simulation simulation = luminous([](Scene& scene) { add_wall(scene, 4, -100, 0, 10); });
    constexpr double lens_radius = 0.25, half_width_m = 0.3;
    constexpr int width = 31;
    View view;
    view.horizontal = 2 * std::atan(half_width_m / 4) / radians_per_degree;
    view.vertical = 2 * std::atan(half_width_m / 4 / width) / radians_per_degree;
    view.lens_m = 2 * lens_radius;
    view.focus_m = 2;
    const Picture picture = simulation.render(view, settings_of(width, 1, 4096)).picture;
    for (int i = 0; i < width; ++i) {
        const double t = std::clamp(((2 * i + 1.0) / width - 1) * half_width_m / lens_radius, -1.0, 1.0);
        const double share = (std::acos(t) - t * std::sqrt(1 - t * t)) / pi;
        const double error = picture.at("error.R", i, 0);
        EXPECT_NEAR(picture.at("R", i, 0), 10 * share, interval * error + 0.02) << "pixel " << i;
        EXPECT_LE(interval * error, 0.3) << "too coarse to notice a lens that is 5 % too wide";
    }
}

TEST(DepthOfField, LeavesAnEdgeInFocusSharp)
{
    const Simulation simulation = luminous([](Scene& scene) { add_wall(scene, 4, -100, 0, 10); });
    View view;
    view.horizontal = view.vertical = 10;
    view.lens_m = 0.5;
    view.direction = {0, 4, 0}; // its length is the focus
    const Picture picture = simulation.render(view, settings_of(16, 16, 64)).picture;
    for (int x = 0; x < 16; ++x)
        EXPECT_EQ(picture.at("R", x, 5), x < 8 ? 10 : 0) << "column " << x;
}

/// Three walls at 1, 2 and 3 m: corners of a wide view lie at 1.9 times these distances along their rays, so that
/// clipping by distance along the ray would mix them.
TEST(Clipping, ShowsWhatLiesBetweenThePlanesOfAPerspectiveView)
{
    const Simulation simulation = luminous([](Scene& scene) {
        for (const double y : {1.0, 2.0, 3.0})
            add_wall(scene, y, -100, 100, 10 * y);
    });
    const auto seen = [&](View::Kind kind, double fore_m, double aft_m) {
        View view;
        view.kind = kind;
        view.horizontal = view.vertical = 100;
        view.fore_m = fore_m;
        view.aft_m = aft_m;
        return range(simulation.render(view, settings_of(16, 16, 8)).picture);
    };
    for (const View::Kind kind : {View::Kind::perspective, View::Kind::parallel}) {
        EXPECT_EQ(seen(kind, 0, 0), std::pair(10.0f, 10.0f));
        EXPECT_EQ(seen(kind, 1.5, 0), std::pair(20.0f, 20.0f));
        EXPECT_EQ(seen(kind, 1.5, 1.9), std::pair(0.0f, 0.0f));
        EXPECT_EQ(seen(kind, 2.5, 3.5), std::pair(30.0f, 30.0f));
        EXPECT_EQ(seen(kind, 0, 0.9), std::pair(0.0f, 0.0f));
    }
}

TEST(Clipping, ShowsWhatLiesBetweenTheSpheresOfAFisheye)
{
    const Simulation simulation = luminous([](Scene& scene) {
        for (const double radius : {1.0, 2.0, 3.0}) {
            const ModifierId light = scene.add_material("light", Light{Spectrum::grey(10 * radius)});
            scene.root.add_sphere({{0, 0, 0}, radius}, Shape::bubble, light, "shell");
        }
    });
    for (const double fore_m : {0.0, 1.5, 2.5}) {
        View view;
        view.kind = View::Kind::angular;
        view.horizontal = view.vertical = 250; // the square inside the circle of all directions
        view.fore_m = fore_m;
        const float expected = fore_m == 0 ? 10 : fore_m == 1.5 ? 20 : 30;
        EXPECT_EQ(range(simulation.render(view, settings_of(16, 16, 8)).picture), std::pair(expected, expected));
    }
}

/// The slanted end of a luminous wall, at 8 paths a pixel, beside the share of each pixel that it fills. Four times the
/// paths halve the error; what decides about them must not shift the mean.
TEST(ImageSampling, AnEdgeHasMorePathsAndNoBias)
{
    const Simulation simulation = luminous([](Scene& scene) {
        const ModifierId light = scene.add_material("light", Light{Spectrum::grey(10)});
        scene.root.add_polygon({{-9, 4, -9}, {-1.3, 4, -9}, {1.1, 4, 9}, {-9, 4, 9}}, light, "wall");
    });
    View view;
    view.horizontal = view.vertical = 60;
    constexpr int size = 160, parts = 32;
    const double half_m = 4 * std::tan(30 * radians_per_degree);
    const auto filled = [&](int x, int y) {
        int inside = 0;
        for (int i = 0; i < parts * parts; ++i) {
            const double across = (2 * (x + (i % parts + 0.5) / parts) / size - 1) * half_m;
            const double up = (1 - 2 * (y + (i / parts + 0.5) / parts) / size) * half_m;
            inside += across < -0.1 + up * 2.4 / 18;
        }
        return inside / static_cast<double>(parts * parts);
    };
    PictureSettings settings = settings_of(size, size, 8);
    settings.accuracy = 0.05;
    const Picture plain = simulation.render(view, settings).picture;
    settings.unbiased = false;
    const Picture finer = simulation.render(view, settings).picture;
    double plain_squares = 0, squares = 0, sum = 0;
    int count = 0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double share = filled(x, y);
            if (share < 0.01 || share > 0.99)
                continue;
            plain_squares += std::pow(plain.at("R", x, y) - 10 * share, 2);
            squares += std::pow(finer.at("R", x, y) - 10 * share, 2);
            sum += finer.at("R", x, y) - 10 * share;
            ++count;
        }
    ASSERT_GT(count, size);
    EXPECT_LT(std::sqrt(squares), 0.65 * std::sqrt(plain_squares));
    EXPECT_LT(std::fabs(sum), 4 * std::sqrt(squares));
}

TEST(Region, HasTheBitsOfTheSamePixelsOfTheWhole)
{
    const Simulation simulation = luminous([](Scene& scene) {
        const ModifierId grey = scene.add_material("grey", Plastic{{0.7, 0.5, 0.3}, 0, 0});
        const ModifierId lamp = scene.add_material("lamp", Light{Spectrum::grey(20)});
        scene.root.add_sphere({{0, 3, 1}, 4}, Shape::bubble, grey, "room");
        scene.root.add_sphere({{0.4, 3.5, 0.2}, 1}, Shape::sphere, grey, "ball");
        scene.root.add_sphere({{-2, 2, 3}, 0.3}, Shape::sphere, lamp, "lamp");
    });
    View view;
    view.horizontal = view.vertical = 70;
    view.lens_m = 0.02;
    view.focus_m = 3;
    for (const bool unbiased : {true, false})
        for (const Tile region : {Tile{37, 50, 21, 9}, Tile{0, 0, 1, 1}, Tile{95, 3, 1, 93}, Tile{0, 0, 96, 96}}) {
            PictureSettings settings = settings_of(96, 96, 8);
            settings.unbiased = unbiased;
            const Picture whole = simulation.render(view, settings).picture;
            settings.region = region;
            const Picture part = simulation.render(view, settings).picture;
            ASSERT_EQ(part.width, region.width);
            ASSERT_EQ(part.height, region.height);
            EXPECT_EQ(part.place, region.width == 96 ? Picture::Place{} : (Picture::Place{region.x, region.y, 96, 96}));
            EXPECT_EQ(part.channels.count("bias.Y"), unbiased ? 0u : 1u);
            for (const auto& [name, values] : part.channels) {
                if (name == "bias.Y") // told by checks within the region
                    continue;
                for (int y = 0; y < region.height; ++y)
                    for (int x = 0; x < region.width; ++x)
                        ASSERT_EQ(std::bit_cast<std::uint32_t>(part.at(name, x, y)),
                                  std::bit_cast<std::uint32_t>(whole.at(name, region.x + x, region.y + y)))
                            << name << " at " << x << ", " << y;
            }
        }
}

TEST(Region, OutsideThePictureIsRefused)
{
    PictureSettings settings = settings_of(96, 64, 8);
    for (const Tile region : {Tile{-1, 0, 5, 5}, Tile{0, 0, 97, 5}, Tile{0, 60, 5, 5}, Tile{96, 0, 1, 1},
                              Tile{0, 0, 5, 0}, Tile{0, 0, -3, 5}}) {
        settings.region = region;
        EXPECT_THROW(wanted_pixels(settings), InputError) << region.x << ' ' << region.y;
    }
}

} // namespace lightwell
