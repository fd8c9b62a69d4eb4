#include "tests/analytic/expect.h"

#include "engine/base/errors.h"

namespace lightwell {
namespace {

constexpr double luminance = 1000; // cd/m^2

Light light_of(double cd_per_m2)
{
    return {Spectrum::grey(cd_per_m2 / lumens_per_watt)};
}

/// A ball that shines like a point of this intensity.
void add_point_lamp(Scene& scene, const Point& at, double intensity_cd, double radius)
{
    scene.root.add_sphere({at, radius}, Shape::sphere,
                          scene.add_material("lamp", light_of(intensity_cd / (pi * radius * radius))), "lamp");
}

ModifierId add_mirror_material(Scene& scene, double reflectance)
{
    return scene.add_material("mirror", Mirror{Spectrum::grey(reflectance)});
}

std::vector<Point> square_at_x(double x, double half)
{
    return {{x, -half, -half}, {x, half, -half}, {x, half, half}, {x, -half, half}};
}

/// Horizontal illuminance of a point lamp, cd / m^2.
double from_point(const Point& lamp, const Point& at, double intensity_cd)
{
    const Vec3 to = lamp - at;
    return intensity_cd * to.z / std::pow(length(to), 3);
}

TEST(VirtualSource, APointLampBesideAMirrorHasOneImageOfTheReflectancesShare)
{
    const Point lamp{2, 0, 3}, image{-2, 0, 3};
    for (const Point& at : {Point{1, 0, 0}, Point{3, 1, 0}, Point{0.1, -2, 0.5}}) {
        Scene scene;
        add_point_lamp(scene, lamp, 1000, 1e-3);
        scene.root.add_polygon(square_at_x(0, 5000), add_mirror_material(scene, 0.9), "mirror");
        const double expected = from_point(lamp, at, 1000) + 0.9 * from_point(image, at, 1000);
        expect_agrees(illuminance_at(Simulation(std::move(scene)), {at, {0, 0, 1}}, 1 << 10), expected, 0.001, 1e-6);
    }
}

/// Images at 2 j D +- x0 with the reflectance to the power of the number of reflections.
TEST(VirtualSource, ParallelMirrorsGiveTheImagesOfEveryChainUpToTheDepth)
{
    constexpr double gap = 1.5, x0 = 0.4, rho = 0.9;
    const auto up_to = [&](const Point& at, int order) {
        double sum = from_point({x0, 0, 2}, at, 1000);
        // Reflections start at the mirror x = 0 or at the mirror x = gap.
        for (const bool first_at_zero : {true, false}) {
            double x = x0, weight = 1;
            for (int k = 1; k <= order; ++k) {
                x = ((k % 2 == 1) == first_at_zero) ? -x : 2 * gap - x;
                weight *= rho;
                sum += weight * from_point({x, 0, 2}, at, 1000);
            }
        }
        return sum;
    };
    const Point places[] = {{0.75, 0, 0}, {1.2, 0.5, 0}, {0.1, -2, 0.5}};
    // Sums of 16,000 images for the three places.
    const double totals[] = {594.034997, 529.3653003, 282.7021748};
    for (const int depth : {1, 2, 3, 12}) {
        Scene scene;
        add_point_lamp(scene, {x0, 0, 2}, 1000, 1e-3);
        const ModifierId mirror = add_mirror_material(scene, rho);
        scene.root.add_polygon(square_at_x(0, 5000), mirror, "left");
        scene.root.add_polygon(square_at_x(gap, 5000), mirror, "right");
        const Simulation simulation(std::move(scene), {depth});
        for (std::size_t i = 0; i < 3; ++i) {
            SCOPED_TRACE(testing::Message() << "depth " << depth << ", place " << i);
            const Found found = illuminance_at(simulation, {places[i], {0, 0, 1}}, 1 << 12);
            expect_agrees(found, up_to(places[i], depth), 0.001, 1e-6);
            if (depth == 12) {
                EXPECT_NEAR(found.value, totals[i], 0.005 * totals[i]);
            }
        }
    }
}

/// Source  image polygon clipped by the pyramid through the mirror, Lambert's formula; direct and mirrored part
TEST(VirtualSource, TheOutlineOfAFiniteMirrorCutsTheImageOfAnAreaLight)
{
    const std::pair<Sensor, double> expected[] = {
        {{{1.5, 0, 0}, {0, 0, 1}}, 303.8361394 + 46.43914267},
        {{{1, 0.4, 0}, {0, 0, 1}}, 270.7106543 + 60.18342091},
        {{{2, 0, 0.2}, normalized({-1, 0, 1})}, 279.1704331 + 34.08214548},
        {{{1.2, 0.5, 0.3}, {-1, 0, 0}}, 3.293880245 + 50.26842444},
    };
    Scene scene;
    scene.root.add_polygon({{1, -0.5, 2.5}, {1, 0.5, 2.5}, {2, 0.5, 2.5}, {2, -0.5, 2.5}},
                           scene.add_material("lamp", light_of(2000)), "lamp");
    scene.root.add_polygon({{0, -0.4, 0.8}, {0, 0.4, 0.8}, {0, 0.4, 1.6}, {0, -0.4, 1.6}},
                           add_mirror_material(scene, 0.85), "mirror");
    const Simulation with(scene, {2}), without(scene, {0});
    for (const auto& [sensor, value] : expected) {
        const Found found = illuminance_at(with, sensor, 1 << 16, 1, true);
        expect_agrees(found, value, 0.003);
        EXPECT_LT(found.error, illuminance_at(without, sensor, 1 << 16, 1, true).error);
    }
}

/// A sun of half a degree, which scattered rays hardly ever meet.
TEST(VirtualSun, AFacadeReflectsTheSunIntoItsPrismAndNowhereElse)
{
    constexpr double beam = 80000, rho = 0.3;
    const double half = 0.25 * radians_per_degree, sine = std::sin(half);
    const Direction to_sun = normalized({-0.6, 0, 0.8}); // falls on the side x < 0 of the facade
    const auto measure = [&](const Point& at, int depth) {
        Scene scene;
        scene.root.add_source({to_sun, 0.5}, scene.add_material("solar", light_of(beam / (pi * sine * sine))), "sun");
        scene.root.add_polygon({{0, -5, 0}, {0, 5, 0}, {0, 5, 8}, {0, -5, 8}}, add_mirror_material(scene, rho),
                               "facade");
        return illuminance_at(Simulation(std::move(scene), {depth}), {at, {0, 0, 1}}, 1 << 10);
    };
    const double direct = beam * to_sun.z;
    // Reflected light travels along (-0.6, 0, -0.8): from the top at z = 8 it reaches x = -6 at z = 0.
    expect_agrees(measure({-3, 0, 0}, 1), direct * (1 + rho), 0.001, 1e-6);
    expect_agrees(measure({-5.9, 4.9, 0}, 1), direct * (1 + rho), 0.001, 1e-6);
    expect_agrees(measure({-6.1, 0, 0}, 1), direct, 0.001, 1e-6);
    expect_agrees(measure({-3, 5.1, 0}, 1), direct, 0.001, 1e-6);
    // Behind the facade lies its shadow.
    EXPECT_EQ(measure({3, 0, 0}, 1).value, 0);
    expect_agrees(measure({-3, 0, 0}, 0), direct, 0.001, 1e-6); // what is missed without virtual sources
}

/// Mirrors at right angles on a floor, a lamp that is large enough for scattered rays to find its images too: a
/// glossy floor, a pane, a spotlight, and an invisible lamp.
Scene corner_of_mirrors()
{
    Scene scene;
    const ModifierId mirror = add_mirror_material(scene, 0.8);
    const ModifierId grey = scene.add_material("grey", Plastic{Spectrum::grey(0.5), 0.05, 0.1});
    const ModifierId pane = scene.add_material("pane", Glass{Spectrum::grey(0.8), 1.52});
    const ModifierId hidden = scene.add_material("hidden", Illum{light_of(luminance).radiance, ""});
    const ModifierId beam =
        scene.add_material("beam", Spotlight{light_of(3 * luminance).radiance, 100, {-0.6, -0.2, -0.7}});
    scene.root.add_polygon({{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}}, grey, "floor");
    scene.root.add_polygon({{0, -4, 0}, {0, 4, 0}, {0, 4, 3}, {0, -4, 3}}, mirror, "across x");
    scene.root.add_polygon({{-4, 0, 0}, {4, 0, 0}, {4, 0, 3}, {-4, 0, 3}}, mirror, "across y");
    scene.root.add_polygon({{1.5, 0.1, 0.2}, {1.5, 3, 0.2}, {1.5, 3, 2}, {1.5, 0.1, 2}}, pane, "pane");
    scene.root.add_polygon({{2, 2, 2.5}, {2, 3, 2.5}, {3, 3, 2.5}, {3, 2, 2.5}},
                           scene.add_material("lamp", light_of(luminance)), "lamp");
    scene.root.add_polygon({{1, 2, 2.4}, {1, 2.6, 2.4}, {1.6, 2.6, 2.4}, {1.6, 2, 2.4}}, hidden, "hidden");
    scene.root.add_polygon({{2, 0.4, 2.2}, {2, 1.2, 2.2}, {2.8, 1.2, 2.2}, {2.8, 0.4, 2.2}}, beam, "beam");
    return scene;
}

TEST(VirtualSource, EnergyIsNeitherDoubledNorLostAtAnyDepth)
{
    const Sensor sensors[] = {{{0.8, 0.7, 0.01}, {0, 0, 1}}, {{2, 1.5, 1}, normalized({-1, -0.5, 0.2})}};
    for (const Sensor& sensor : sensors) {
        const Found plain = pooled_illuminance_at(Simulation(corner_of_mirrors(), {0}), sensor, 1 << 17, true);
        for (const int depth : {1, 2, 3}) {
            SCOPED_TRACE(depth);
            const Simulation simulation(corner_of_mirrors(), {depth});
            for (const bool unbiased : {true, false}) { // with and without cached ambient light
                const Found found = pooled_illuminance_at(simulation, sensor, 1 << 15, unbiased);
                expect_agrees({found.value, std::hypot(found.error, plain.error)}, plain.value, 0.06, 1e-9,
                              pooled_interval);
            }
        }
    }
}

/// The same through a glossy floor to an eye, where scattered rays and shadow rays share the light by weight.
TEST(VirtualSource, AGlossyFloorShowsTheSameWithAndWithoutVirtualSources)
{
    const auto look = [](int depth) {
        Scene scene;
        scene.root.add_polygon({{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}},
                               scene.add_material("floor", Metal{Spectrum::grey(0.7), 0.8, 0.15}), "floor");
        scene.root.add_polygon({{0, -4, 0}, {0, 4, 0}, {0, 4, 3}, {0, -4, 3}}, add_mirror_material(scene, 0.8),
                               "mirror");
        scene.root.add_sphere({{1.5, 0, 1.2}, 0.3}, Shape::sphere, scene.add_material("lamp", light_of(luminance)),
                              "lamp");
        View view;
        view.position = {4, 0, 2};
        view.direction = normalized({0.9 - 4, 0, -2});
        view.horizontal = view.vertical = 2;
        PictureSettings settings;
        settings.width = settings.height = 1;
        settings.samples = 1 << 17;
        settings.unbiased = true;
        const Picture picture = Simulation(std::move(scene), {depth}).render(view, settings).picture;
        return Found{picture.at("G", 0, 0), picture.at("error.G", 0, 0)};
    };
    const Found plain = look(0), found = look(2);
    expect_agrees({found.value, std::hypot(found.error, plain.error)}, plain.value, 0.08);
}

TEST(VirtualSource, MirrorsInTurnedScaledAndMirroredInstancesAreThoseOfTheWorld)
{
    const std::vector<Point> outline{{0, -0.5, 0}, {0, 0.7, 0}, {0, 0.4, 1.5}, {0, -0.6, 1.2}, {0, -0.1, 0.6}};
    const Affine place =
        compose(Affine::translate({-0.3, 0.2, 0.4}), compose(Affine::rotate(2, 0.3), Affine::scale({-1, 1.4, 0.8})));
    const auto measure = [&](bool as_instance) {
        Scene scene;
        const ModifierId mirror = add_mirror_material(scene, 0.9);
        Part part;
        part.name = "cabinet";
        std::vector<Point> corners;
        for (const Point& p : outline)
            corners.push_back(as_instance ? p : place.point(p));
        (as_instance ? part : scene.root).add_polygon(corners, mirror, "door");
        if (as_instance) {
            scene.prototypes.push_back(part);
            scene.root.add_instance({0, place, {}}, "cabinet");
        }
        add_point_lamp(scene, {2, 0.5, 1.5}, 1000, 0.01);
        return illuminance_at(Simulation(std::move(scene)), {{1.2, 0.8, 0.3}, {-1, 0, 0}}, 1 << 10);
    };
    const Found world = measure(false), instance = measure(true);
    EXPECT_GT(world.value, 10); // the lamp itself is behind the sensor
    EXPECT_NEAR(instance.value, world.value, 1e-6 * world.value);
}

TEST(VirtualSource, AMirrorThatWasDrawnTwiceReflectsOnce)
{
    const auto measure = [](int copies) {
        Scene scene;
        const ModifierId mirror = add_mirror_material(scene, 0.9);
        for (int i = 0; i < copies; ++i)
            scene.root.add_polygon(square_at_x(0, 2), mirror, "mirror");
        if (copies > 1) // and one that overlaps in part
            scene.root.add_polygon(square_at_x(0, 1), mirror, "mirror");
        scene.root.add_sphere({{2, 0, 1.5}, 0.5}, Shape::sphere, scene.add_material("lamp", light_of(luminance)),
                              "lamp");
        return illuminance_at(Simulation(std::move(scene)), {{1, 0, 0}, {-1, 0, 0}}, 1 << 14);
    };
    const Found once = measure(1), twice = measure(2);
    expect_agrees({twice.value, std::hypot(once.error, twice.error)}, once.value, 0.02);
}

TEST(VirtualSource, ResultsDoNotChangeWithPlaceAndScale)
{
    const auto measure = [](double size, const Vec3& offset) {
        Scene scene;
        const Affine place = compose(Affine::translate(offset), Affine::scale(size));
        const auto add = [&](std::vector<Point> corners, ModifierId modifier) {
            for (Point& p : corners)
                p = place.point(p);
            scene.root.add_polygon(corners, modifier, "p");
        };
        const ModifierId mirror = add_mirror_material(scene, 0.9);
        add({{1, -0.5, 2.5}, {1, 0.5, 2.5}, {2, 0.5, 2.5}, {2, -0.5, 2.5}}, scene.add_material("lamp", light_of(2000)));
        add({{0, -2, 0}, {0, 2, 0}, {0, 2, 2}, {0, -2, 2}}, mirror);
        add({{-2, 2, 0}, {3, 2, 0}, {3, 2, 2}, {-2, 2, 2}}, mirror);
        return illuminance_at(Simulation(std::move(scene)), {place.point({1, 0.3, 0.4}), normalized({-1, 0.6, 0.1})},
                              1 << 10)
            .value;
    };
    const double reference = measure(1, {});
    EXPECT_GT(reference, 0);
    for (const int power : {-30, -10, 10, 30})
        EXPECT_EQ(measure(std::ldexp(1.0, power), {}), reference) << "scale 2^" << power;
    for (const double scale : {1e-9, 1e-4, 1e9})
        EXPECT_NEAR(measure(scale, {}), reference, 1e-9 * reference) << "scale " << scale;
    EXPECT_NEAR(measure(1, {1e6, -1e6, 5e5}), reference, 1e-6 * reference);
}

TEST(VirtualSource, ManyLampsAndMirrorsAreChosenAmongWithoutBias)
{
    const auto hall = [] {
        Scene scene;
        const ModifierId mirror = add_mirror_material(scene, 0.7);
        const ModifierId lamp = scene.add_material("lamp", light_of(luminance));
        for (int i = 0; i < 8; ++i) {
            const double x = 1.5 * i, y = (i % 3) - 1;
            scene.root.add_polygon({{x, y, 0}, {x + 1, y + 0.3, 0}, {x + 1, y + 0.3, 2}, {x, y, 2}}, mirror, "mirror");
            for (int j = 0; j < 5; ++j)
                scene.root.add_sphere({{x + 0.5, 2.0 * j - 5, 3.5}, 0.4}, Shape::sphere, lamp, "lamp");
        }
        return scene;
    };
    const Sensor sensor{{5, -3, 0.5}, normalized({0, 1, 0.2})};
    const Found plain = illuminance_at(Simulation(hall(), {0}), sensor, 1 << 18);
    const Found found = illuminance_at(Simulation(hall(), {2}), sensor, 1 << 16);
    expect_agrees({found.value, std::hypot(found.error, plain.error)}, plain.value, 0.03);
}

TEST(VirtualSource, ADepthOutOfRangeIsRefusedWithItsBounds)
{
    for (const int depth : {-1, 13}) {
        try {
            const Simulation simulation(corner_of_mirrors(), {depth});
            ADD_FAILURE() << depth;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find("expected 0 to 12"), std::string::npos) << error.what();
        }
    }
}

} // namespace
} // namespace lightwell
