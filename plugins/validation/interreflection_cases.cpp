#include "plugins/validation/case.h"
#include "plugins/validation/room_formulas.h"

namespace lightwell {
namespace {

constexpr unsigned lit_by_lamp = Technique::direct | Technique::interreflection;

/// A lamp small enough to be a point (its light is exactly that of a point) and to hide a millionth of the wall.
Case sphere_case(const std::string& id, double radius, double reflectance, const Point& lamp, double flux_lm,
                 double accepted)
{
    const double lamp_radius = 1e-3 * radius, intensity = flux_lm / (4 * pi);
    const double indirect = sphere_indirect(radius, reflectance, flux_lm);
    Case result{id, lit_by_lamp};
    Setup setup;
    setup.scene = [=](const Perturbation& p) {
        Scene scene;
        scene.root.add_sphere({{0, 0, 0}, radius}, Shape::bubble, scene.add_material("wall", p.diffuse(reflectance, 1)),
                              "wall");
        scene.root.add_sphere({lamp, lamp_radius}, Shape::sphere,
                              scene.add_material("lamp", p.lamp(intensity / (pi * lamp_radius * lamp_radius))), "lamp");
        return scene;
    };
    int number = 0;
    for (const Direction& place :
         {Direction{0, 0, 1}, Direction{0, 0, -1}, Direction{1, 0, 0}, normalized({1, 1, 1})}) {
        const Vec3 to_lamp = lamp - place * radius;
        const double distance = length(to_lamp), cosine = -dot(place, to_lamp) / distance;
        const double expected = intensity * cosine / (distance * distance) + indirect;
        const std::string name = numbered("p", number);
        result.references.emplace_back(name, expected);
        Check check = illuminance_check(name, expected, accepted, {place * radius, -place});
        // Many reflections are dear: one sensor is enough for a quick look, coarsely where paths are very long.
        constexpr double short_paths = 0.5, long_paths = 0.95, mostly_reflected = 0.8;
        check.only_full = reflectance > short_paths && number != 0;
        check.quick_relative = reflectance > long_paths ? 0.02 : 0.01;
        if (reflectance > short_paths)
            check.method = Method::usual;
        const bool telling = number == 0 && reflectance < long_paths && indirect > mostly_reflected * expected;
        setup.checks.push_back(telling ? detecting(check) : check);
        ++number;
    }
    result.setups.push_back(setup);
    result.references.emplace_back("indirect_everywhere", indirect);
    return result;
}

/// Squares a million times as wide as their distance. The lower one lets diffuse light in from below: that is its own
/// exitance M = tau pi L, beside which it reflects 1 - tau.
Case planes_case(const std::string& id, double reflectance1, double reflectance2, double quick_relative)
{
    constexpr double exitance = 1000, wide = 0.5e6, accepted = 0.003;
    const double passed = 1 - reflectance1, luminance = exitance / (pi * passed);
    const PlaneIlluminances e = parallel_planes(exitance, reflectance1, reflectance2);
    Setup setup;
    setup.scene = [=](const Perturbation& p) {
        Scene scene;
        scene.root.add_source({{0, 0, -1}, 180}, scene.add_material("glow", p.surroundings(luminance)), "below");
        const auto add_square = [&](double z, ModifierId modifier) {
            scene.root.add_polygon({{-wide, -wide, z}, {wide, -wide, z}, {wide, wide, z}, {-wide, wide, z}}, modifier,
                                   "square");
        };
        add_square(0, scene.add_material("sheet", Trans{Spectrum::grey(1), 0, 0, passed, 0}));
        add_square(1, scene.add_material("upper", p.diffuse(reflectance2, reflectance1)));
        return scene;
    };
    setup.checks = {illuminance_check("E_on_2", e.on_second, accepted, {{0, 0, 1}, {0, 0, -1}}),
                    illuminance_check("E_on_1", e.on_first, accepted, {{0, 0, 0}, {0, 0, 1}})};
    for (Check& check : setup.checks)
        check.quick_relative = quick_relative;
    constexpr double lets_much_in = 0.5;
    if (passed >= lets_much_in)
        setup.checks[1] = detecting(setup.checks[1]); // all of it has been reflected
    // Paths of a hundred reflections take minutes: each place is a task of its own.
    Setup other = setup;
    other.checks.erase(other.checks.begin());
    setup.checks.pop_back();
    Case result{id, Technique::sky | Technique::interreflection, {setup, other}};
    result.references = {{"E_on_2", e.on_second},
                         {"E_on_1", e.on_first},
                         {"radiosity_1", exitance + reflectance1 * e.on_first},
                         {"radiosity_2", reflectance2 * e.on_second}};
    return result;
}

/// Strips 2000 times as long as the floor is wide, under a narrow sun that lights both alike.
Case corner_case(const std::string& id, double floor_reflectance, double wall_reflectance, double height)
{
    constexpr double direct = 1000, accepted = 0.005, half_length = 1000, half_angle_deg = 0.01;
    const double sine = std::sin(half_angle_deg * radians_per_degree);
    const double luminance = direct * std::sqrt(2.0) / (pi * sine * sine);
    const Corner corner(floor_reflectance, wall_reflectance, height, direct);
    Setup setup;
    setup.scene = [=](const Perturbation& p) {
        Scene scene;
        scene.root.add_source({normalized({1, 0, 1}), 2 * half_angle_deg},
                              scene.add_material("solar", p.lamp(luminance)), "sun");
        constexpr double l = half_length;
        scene.root.add_polygon({{0, -l, 0}, {1, -l, 0}, {1, l, 0}, {0, l, 0}},
                               scene.add_material("floor", p.diffuse(floor_reflectance, 0)), "floor");
        scene.root.add_polygon({{0, -l, 0}, {0, l, 0}, {0, l, height}, {0, -l, height}},
                               scene.add_material("wall", p.diffuse(wall_reflectance, 0)), "wall");
        return scene;
    };
    Case result{id, lit_by_lamp};
    for (const double x : {0.01, 0.05, 0.1, 0.25, 0.5, 0.75, 1.0})
        setup.checks.push_back(
            illuminance_check(numbered("floor_x", x), corner.on_floor(x), accepted, {{x, 0, 0}, {0, 0, 1}}));
    for (const double part : {0.01, 0.1, 0.5, 1.0})
        setup.checks.push_back(illuminance_check(numbered("wall_z", part * height), corner.on_wall(part * height),
                                                 accepted, {{0, 0, part * height}, {1, 0, 0}}));
    for (const Check& check : setup.checks)
        result.references.emplace_back(check.quantity, check.expected);
    // In the edge each surface is half the other's surroundings.
    const double shared = direct / (1 - 0.25 * floor_reflectance * wall_reflectance);
    result.references.emplace_back("edge_limit_floor", shared * (1 + 0.5 * wall_reflectance));
    result.references.emplace_back("edge_limit_wall", shared * (1 + 0.5 * floor_reflectance));
    result.setups.push_back(setup);
    return result;
}

} // namespace

std::vector<Case> interreflection_cases()
{
    return {sphere_case("cl_integrating_sphere_R1_rho0.5", 1, 0.5, {0, 0, 0}, 1000, 0.005),
            sphere_case("cl_integrating_sphere_R1_rho0.9", 1, 0.9, {0.3, -0.2, 0.5}, 1000, 0.005),
            sphere_case("cl_integrating_sphere_R0.25_rho0.98", 0.25, 0.98, {0, 0, 0.2}, 500, 0.01),
            planes_case("cl_parallel_planes_0.5_0.5", 0.5, 0.5, 0.01),
            planes_case("cl_parallel_planes_0.9_0.2", 0.9, 0.2, 0.01),
            planes_case("cl_parallel_planes_0.99_0.999", 0.99, 0.999, 0.05),
            corner_case("cl_corner_0.5_0.5_1", 0.5, 0.5, 1),
            corner_case("cl_corner_0.8_0.8_1", 0.8, 0.8, 1),
            corner_case("cl_corner_0.2_0.7_2", 0.2, 0.7, 2)};
}

} // namespace lightwell
