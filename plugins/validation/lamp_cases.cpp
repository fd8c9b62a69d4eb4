#include "plugins/validation/case.h"
#include "plugins/validation/lamp_formulas.h"

#include <algorithm>

namespace lightwell {
namespace {

constexpr double accepted = 0.003, accepted_polygon = 0.005;
constexpr unsigned direct = static_cast<unsigned>(Technique::direct);
constexpr Direction up{0, 0, 1};

Case disc_case(const std::string& id, double radius, double height, double luminance, bool detection)
{
    Setup setup;
    setup.scene = [=](const Perturbation& p) {
        Scene scene;
        scene.root.add_ring({{0, 0, height}, {0, 0, -1}, 0, radius}, scene.add_material("lamp", p.lamp(luminance)),
                            "disc");
        return scene;
    };
    for (const double aside : {0.0, 0.25, 0.5, 1.0, 2.0, 5.0}) {
        const Check check = illuminance_check(numbered("a", aside), disc_illuminance(radius, height, aside, luminance),
                                              accepted, {{aside, 0, 0}, up});
        setup.checks.push_back(detection ? detecting(check) : check);
    }
    return {id, direct, {setup}};
}

Case sphere_case(const std::string& id, double radius, double luminance)
{
    Setup setup;
    setup.scene = [=](const Perturbation& p) {
        Scene scene;
        scene.root.add_sphere({{0, 0, 1}, radius}, Shape::sphere, scene.add_material("lamp", p.lamp(luminance)),
                              "ball");
        return scene;
    };
    const double whole = sphere_illuminance(radius, 1, 0, luminance);
    for (const double degrees : {0.0, 30.0, 60.0, 80.0, 90.0, 95.0, 100.0}) {
        const double tilt = degrees * radians_per_degree, expected = sphere_illuminance(radius, 1, tilt, luminance);
        Check check = illuminance_check(numbered("tilt", degrees), expected, 0.005,
                                        {{0, 0, 0}, {std::sin(tilt), 0, std::cos(tilt)}});
        // Where only a sliver is above the horizon, the accuracy that counts is that of the whole sphere.
        check.tolerance = std::max(check.tolerance, 0.001 * whole);
        setup.checks.push_back(check);
    }
    return {id, direct, {setup}};
}

/// A sheet that shines on both sides: for each sensor the side that faces it.
Case polygon_case(const std::string& id, const std::vector<Point>& corners, const std::vector<Sensor>& sensors,
                  bool detection)
{
    constexpr double luminance = 1000;
    Case result{id, direct};
    const Vec3 front = polygon_area_vector(corners.data(), corners.size());
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        const Sensor& sensor = sensors[i];
        std::vector<Point> facing = corners;
        if (dot(front, sensor.position - corners[0]) < 0)
            std::reverse(facing.begin(), facing.end());
        const double expected = polygon_illuminance(corners, luminance, sensor.position, sensor.normal);
        const Check check =
            illuminance_check(numbered("s", static_cast<double>(i)), expected, accepted_polygon, sensor);
        result.setups.push_back({[=](const Perturbation& p) {
                                     Scene scene;
                                     scene.root.add_polygon(facing, scene.add_material("lamp", p.lamp(luminance)),
                                                            "sheet");
                                     return scene;
                                 },
                                 {detection ? detecting(check) : check}});
    }
    return result;
}

Case line_case()
{
    constexpr double half = 0.6, height = 2, radius = 0.001, luminance = 10000;
    Setup setup;
    setup.scene = [](const Perturbation& p) {
        Scene scene;
        scene.root.add_cone({{{-half, 0, height}, {half, 0, height}}, {radius, radius}}, Shape::cylinder,
                            scene.add_material("lamp", p.lamp(luminance)), "tube");
        return scene;
    };
    for (const double along : {0.0, 0.3, 0.6, 1.5})
        setup.checks.push_back(illuminance_check(numbered("x", along),
                                                 line_illuminance(half, height, along, luminance * 2 * radius),
                                                 accepted, {{along, 0, 0}, up}));
    return {"cl_line_l1.2_h2", direct, {setup}};
}

} // namespace

std::vector<Case> lamp_cases()
{
    const std::vector<Point> triangle{{0, 0, 2}, {1, 0.2, 2.5}, {0.3, 1, 1.8}};
    const std::vector<Point> angle{{0, 0, 3}, {2, 0, 3}, {2, 1, 3}, {1, 1, 3}, {1, 2, 3}, {0, 2, 3}};
    const std::vector<Point> annulus{{-1, -1, 2},     {1, -1, 2},     {1, 1, 2},     {-1, 1, 2},     {-1, -1, 2},
                                     {-0.5, -0.5, 2}, {-0.5, 0.5, 2}, {0.5, 0.5, 2}, {0.5, -0.5, 2}, {-0.5, -0.5, 2}};
    return {
        disc_case("cl_disc_light_R0.5_h2", 0.5, 2, 1000, true),
        disc_case("cl_disc_light_R1_h0.1", 1, 0.1, 5000, false),
        sphere_case("cl_sphere_light_R0.2_D1", 0.2, 2000),
        sphere_case("cl_sphere_light_R0.9_D1", 0.9, 1000),
        polygon_case(
            "cl_polygon_triangle", triangle,
            {{{0, 0, 0}, up}, {{2, 1, 0}, up}, {{0.4, 0.3, 1.9}, {1, 0, 0}}, {{-1, -1, 0.5}, normalized({1, 1, 1})}},
            true),
        polygon_case("cl_polygon_L_shape", angle,
                     {{{0.5, 0.5, 0}, up},
                      {{3, 3, 0}, up},
                      {{1.5, 1.5, 2.5}, up},
                      {{-0.5, 1, 1}, {1, 0, 0}},
                      {{1.2, -1, 2}, normalized({0, 1, 0.2})}},
                     true),
        polygon_case("cl_polygon_annulus_with_seam", annulus,
                     {{{0, 0, 0}, up}, {{0.9, 0.7, 0}, up}, {{0, 0, 1.5}, up}, {{3, 0, 0.5}, normalized({-1, 0, 0.3})}},
                     true),
        line_case()};
}

} // namespace lightwell
