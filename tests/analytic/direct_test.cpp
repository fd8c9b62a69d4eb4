#include "tests/analytic/expect.h"

namespace lightwell {
namespace {

constexpr double luminance = 1000; // cd/m^2

Light light_of(double cd_per_m2)
{
    return {Spectrum::grey(cd_per_m2 / lumens_per_watt)};
}

Simulation with_disc(double radius, double height)
{
    Scene scene;
    scene.root.add_ring({{0, 0, height}, {0, 0, -1}, 0, radius}, scene.add_material("lamp", light_of(luminance)),
                        "disc");
    return Simulation(std::move(scene));
}

/// E = pi L R^2 / (R^2 + h^2): the integral of L cos(theta) over the cone of the disc.
TEST(DiscSource, DirectLightMatchesTheClosedFormFromDistantToTouching)
{
    for (const double ratio : {1e-3, 0.1, 1.0, 10.0, 1e3}) {
        SCOPED_TRACE(ratio);
        const double expected = pi * luminance * ratio * ratio / (1 + ratio * ratio);
        expect_agrees(illuminance_at(with_disc(2 * ratio, 2), {{0, 0, 0}, {0, 0, 1}}, 1 << 16), expected, 0.02);
    }
}

/// E = pi L (R/D)^2 cos(tilt) while the whole sphere is above the horizon.
TEST(SphereSource, IlluminanceOfAWholeSphereIsExactWhateverItsSize)
{
    for (const double radius : {1e-6, 1e-3, 0.2, 0.6}) {
        SCOPED_TRACE(radius);
        Scene scene;
        scene.root.add_sphere({{0, 0, 1}, radius}, Shape::sphere, scene.add_material("lamp", light_of(luminance)),
                              "ball");
        const Simulation simulation(std::move(scene));
        const Direction tilted{std::sin(0.4), 0, std::cos(0.4)};
        expect_agrees(illuminance_at(simulation, {{0, 0, 0}, tilted}, 1 << 14),
                      pi * luminance * radius * radius * std::cos(0.4), 0.005);
    }
}

/// Lambert's sum over the edges: E = L/2 sum Theta_i (n . (v_i x v_i+1) / |v_i x v_i+1|).
double lambert(const std::vector<Point>& corners, const Point& at, const Direction& normal)
{
    double sum = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 a = corners[i] - at, b = corners[(i + 1) % corners.size()] - at, c = cross(a, b);
        sum += std::atan2(length(c), dot(a, b)) * dot(normal, c) / length(c);
    }
    return 0.5 * luminance * std::fabs(sum);
}

TEST(PolygonSource, ConcaveOutlinesAndRectanglesMatchLambert)
{
    const std::vector<std::vector<Point>> outlines{{{0, 0, 3}, {0, 2, 3}, {1, 2, 3}, {1, 1, 3}, {2, 1, 3}, {2, 0, 3}},
                                                   {{-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2}},
                                                   {{0, 0, 2}, {0.3, 1, 1.8}, {1, 0.2, 2.5}}};
    for (const auto& outline : outlines) {
        Scene scene;
        scene.root.add_polygon(outline, scene.add_material("lamp", light_of(luminance)), "lamp");
        const Simulation simulation(std::move(scene));
        for (const Point& at : {Point{0.5, 0.5, 0}, Point{4, -1, 0.5}}) {
            SCOPED_TRACE(testing::Message() << outline.size() << " corners, x = " << at.x);
            expect_agrees(illuminance_at(simulation, {at, {0, 0, 1}}, 1 << 16), lambert(outline, at, {0, 0, 1}), 0.01);
        }
    }
}

/// A fifth of the panel lies before the sensor: Lambert's sum over that part alone.
TEST(PolygonSource, OfALampThatTheHorizonCutsThePartInViewCounts)
{
    Scene scene;
    scene.root.add_polygon({{1, -0.5, 2.5}, {1, 0.5, 2.5}, {2, 0.5, 2.5}, {2, -0.5, 2.5}},
                           scene.add_material("lamp", light_of(luminance)), "lamp");
    const Point at{1.2, 0.5, 0.3};
    const std::vector<Point> seen{{1, -0.5, 2.5}, {1, 0.5, 2.5}, {1.2, 0.5, 2.5}, {1.2, -0.5, 2.5}};
    expect_agrees(illuminance_at(Simulation(std::move(scene)), {at, {-1, 0, 0}}, 1 << 14),
                  lambert(seen, at, {-1, 0, 0}), 0.01);
}

TEST(PolygonSource, ALampInsideAMirroredAndTurnedInstanceShinesOnItsFrontSide)
{
    const std::vector<Point> panel{{-0.3, -0.3, 0}, {-0.3, 0.3, 0}, {0.3, 0.3, 0}, {0.3, -0.3, 0}}; // front down
    for (const double mirror : {1.0, -1.0}) {
        Scene scene;
        const ModifierId lamp = scene.add_material("lamp", light_of(luminance));
        Part fixture;
        fixture.name = "fixture";
        fixture.add_polygon(panel, lamp, "panel");
        scene.prototypes.push_back(fixture);
        const Affine place =
            compose(Affine::translate({0.5, 0, 2.5}), compose(Affine::rotate(2, 0.3), Affine::scale({mirror, 1, 1})));
        scene.root.add_instance({0, place, {}}, "fixture");
        std::vector<Point> corners;
        for (const Point& p : panel)
            corners.push_back(place.point(p));
        const Simulation simulation(std::move(scene));
        expect_agrees(illuminance_at(simulation, {{0, 0, 0}, {0, 0, 1}}, 1 << 12),
                      lambert(corners, {0, 0, 0}, {0, 0, 1}), 0.01);
        EXPECT_EQ(illuminance_at(simulation, {{0, 0, 4}, {0, 0, -1}}, 1 << 8).value, 0);
    }
}

/// A sheet that scatters 0.3 and lets 0.3 pass straight gives what one that scatters 0.3 gives, and 0.3 of the lamp.
TEST(TranslucentSheet, LightThatPassesStraightIsCountedOnceBesideWhatIsScattered)
{
    const auto under_sheet = [](double transmission, double straight) {
        Scene scene;
        const ModifierId lamp = scene.add_material("lamp", light_of(luminance));
        const ModifierId sheet = scene.add_material("sheet", Trans{Spectrum::grey(1), 0, 0, transmission, straight});
        scene.root.add_ring({{0, 0, 1.2}, {0, 0, -1}, 0, 1}, lamp, "lamp");
        scene.root.add_ring({{0, 0, 1}, {0, 0, -1}, 0, 3}, sheet, "sheet");
        return pooled_illuminance_at(Simulation(std::move(scene)), {{0, 0, 0}, {0, 0, 1}}, 1 << 15);
    };
    const Found scattered = under_sheet(0.3, 0), both = under_sheet(0.6, 0.5);
    const double lamp_alone = pi * luminance / (1 + 1.2 * 1.2);
    expect_agrees({both.value, std::hypot(both.error, scattered.error)}, scattered.value + 0.3 * lamp_alone, 0.05, 1e-9,
                  pooled_interval);
}

TEST(Sun, DiscGivesPiLTimesSineSquaredThroughClearAirAndGlass)
{
    for (const double full_angle : {1e-6, 0.533, 5.0}) {
        Scene scene;
        const double half = 0.5 * full_angle * radians_per_degree;
        const double cd_per_m2 = 1e5 / (pi * std::sin(half) * std::sin(half)); // 100 klx
        const Direction to_sun{std::cos(1.0), 0, std::sin(1.0)};
        scene.root.add_source({to_sun, full_angle}, scene.add_material("solar", light_of(cd_per_m2)), "sun");
        const Simulation simulation(std::move(scene));
        expect_agrees(illuminance_at(simulation, {{0, 0, 0}, to_sun}, 1 << 16), 1e5, 0.005);
        expect_agrees(illuminance_at(simulation, {{0, 0, 0}, {0, 0, 1}}, 1 << 16), 1e5 * std::sin(1.0), 0.005);
    }
}

TEST(Simulation, ResultsDoNotChangeWithPlaceAndScale)
{
    const auto measure = [](double size, const Vec3& offset) {
        Scene scene;
        const ModifierId lamp = scene.add_material("lamp", light_of(luminance));
        const ModifierId grey = scene.add_material("grey", Plastic{Spectrum::grey(0.6), 0.02, 0.1});
        const Affine place = compose(Affine::translate(offset), Affine::scale(size));
        const auto add = [&](std::vector<Point> corners, ModifierId modifier) {
            for (Point& p : corners)
                p = place.point(p);
            scene.root.add_polygon(corners, modifier, "p");
        };
        add({{0, 0, 3}, {0, 1, 3}, {1, 1, 3}, {1, 0, 3}}, lamp);
        add({{-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}}, grey);
        add({{-3, -3, 0}, {-3, 3, 0}, {-3, 3, 4}, {-3, -3, 4}}, grey);
        const Simulation simulation(std::move(scene));
        return illuminance_at(simulation, {place.point({-1, 0.5, 1}), {0, 0, 1}}, 1 << 10).value;
    };
    const double reference = measure(1, {});
    for (const int power : {-30, -10, 10, 30})
        EXPECT_EQ(measure(std::ldexp(1.0, power), {}), reference) << "scale 2^" << power;
    for (const double scale : {1e-9, 1e-4, 1e9})
        EXPECT_NEAR(measure(scale, {}), reference, 1e-9 * reference) << "scale " << scale;
    EXPECT_NEAR(measure(1, {1e6, -1e6, 5e5}), reference, 1e-6 * reference);
}

} // namespace
} // namespace lightwell
