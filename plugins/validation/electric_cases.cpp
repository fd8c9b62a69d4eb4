#include "plugins/validation/case.h"
#include "plugins/validation/glass_formulas.h"
#include "plugins/validation/lamp_formulas.h"
#include "plugins/validation/quadrature.h"
#include "plugins/validation/room_frame.h"

#include <algorithm>

/// \file The cases of electric light of CIE 171:2006 (5.2 to 5.8), their values from closed forms.
namespace lightwell {
namespace {

constexpr unsigned direct = static_cast<unsigned>(Technique::direct);
constexpr double accepted_area = 0.005, accepted_reflected = 0.01;
constexpr Direction up{0, 0, 1}, down{0, 0, -1}, inwards{0, 1, 0};

/// Small enough that the light of a disc is that of a point to 1e-6.
constexpr double point_radius = 0.002;

Case point_case(bool lambertian)
{
    constexpr double height = 3, intensity = 1000, accepted = 1e-4;
    const double luminance = intensity / (pi * point_radius * point_radius);
    Setup setup;
    setup.scene = [=](const Perturbation& p) {
        Scene scene;
        const ModifierId lamp = scene.add_material("lamp", p.lamp(luminance));
        if (lambertian)
            scene.root.add_ring({{0, 0, height}, down, 0, point_radius}, lamp, "lamp");
        else
            scene.root.add_sphere({{0, 0, height}, point_radius}, Shape::sphere, lamp, "lamp");
        return scene;
    };
    constexpr double places[][2] = {{0, 0},   {0.5, 0},   {1, 0}, {1.5, 0}, {0.5, 0.5},
                                    {1, 0.5}, {1.5, 0.5}, {1, 1}, {1.5, 1}, {1.5, 1.5}};
    char name = 'A';
    for (const auto& at : places) {
        const double square = at[0] * at[0] + at[1] * at[1] + height * height, cosine = height / std::sqrt(square);
        const double expected = intensity * cosine / square * (lambertian ? cosine : 1);
        setup.checks.push_back(illuminance_check(std::string(1, name++), expected, accepted, {{at[0], at[1], 0}, up}));
    }
    return {lambertian ? "cie171_point_lambertian" : "cie171_point_isotropic", direct, {setup}};
}

/// Fourteen places of the report: six on the wall y = 0 from `first_z` on, eight along the floor or the ceiling.
std::vector<Sensor> wall_and_level(double first_z, double step_z, double level_z, const Direction& level_normal)
{
    std::vector<Sensor> sensors;
    for (int i = 0; i < 6; ++i)
        sensors.push_back({{2, 0, first_z + step_z * i}, inwards});
    for (int i = 0; i < 8; ++i)
        sensors.push_back({{2, 0.25 + 0.5 * i, level_z}, level_normal});
    return sensors;
}

Case area_case()
{
    const std::vector<Point> lamp{{1.5, 1.5, 3}, {1.5, 2.5, 3}, {2.5, 2.5, 3}, {2.5, 1.5, 3}};
    constexpr double luminance = 1000;
    Setup setup;
    setup.scene = [=](const Perturbation& p) {
        Scene scene;
        scene.root.add_polygon(lamp, scene.add_material("lamp", p.lamp(luminance)), "lamp");
        return scene;
    };
    char name = 'A';
    for (const Sensor& sensor : wall_and_level(2.75, -0.5, 0, up))
        setup.checks.push_back(illuminance_check(std::string(1, name++),
                                                 polygon_illuminance(lamp, luminance, sensor.position, sensor.normal),
                                                 accepted_area, sensor));
    return {"cie171_area_direct", direct, {setup}};
}

/// Sensors over a rectangle, weighted to give its mean times `share`.
void spread(const RoomFace& face, int nodes, double share, std::vector<WeightedSensor>& sensors)
{
    for (const QuadratureNode& u : gauss_legendre(nodes, 0, 1))
        for (const QuadratureNode& v : gauss_legendre(nodes, 0, 1))
            sensors.push_back({{face.corner + face.u * u.x + face.v * v.x, face.normal}, share * u.weight * v.weight});
}

constexpr Point room_size{4, 4, 3};
constexpr double flux_lm = 10000;

std::function<Scene(const Perturbation&)> lamp_in_box(double reflectance)
{
    return [=](const Perturbation& p) {
        Scene scene;
        // A closed box of one reflectance: after a reflection all of the light comes back.
        const ModifierId wall = scene.add_material("wall", p.diffuse(reflectance, 1));
        for (const RoomFace& face : room_faces(room_size))
            scene.root.add_polygon(face.corners(), wall, face.name);
        const double intensity = flux_lm / (4 * pi);
        scene.root.add_sphere({room_size * 0.5, point_radius}, Shape::sphere,
                              scene.add_material("lamp", p.lamp(intensity / (pi * point_radius * point_radius))),
                              "lamp");
        return scene;
    };
}

/// Solid angle of a rectangle a by b seen from above its middle.
double solid_angle(double a, double b, double height)
{
    return 4 * std::atan(a * b / (2 * height * std::sqrt(a * a + b * b + 4 * height * height)));
}

Case flux_case()
{
    constexpr double accepted = 0.003;
    constexpr int nodes = 10;
    Case result{"cie171_flux_conservation", direct};
    Setup setup{lamp_in_box(0), {}};
    Check total{"total_flux_lm", flux_lm, accepted * flux_lm, {}, {}, false, "lm"};
    for (const RoomFace& face : room_faces(room_size)) {
        const double a = length(face.u), b = length(face.v), area = a * b;
        const double height = dot(room_size * 0.5 - face.corner, face.normal);
        const double mean = flux_lm / (4 * pi) * solid_angle(a, b, height) / area;
        Check check{face.name, mean, accepted * mean, {}, {}, false, "lx"};
        spread(face, nodes, 1, check.sensors);
        spread(face, nodes, area, total.sensors);
        setup.checks.push_back(check);
    }
    setup.checks.push_back(total);
    result.setups.push_back(setup);
    return result;
}

Case enclosure_case(double reflectance)
{
    constexpr int nodes = 6;
    constexpr double most_usual = 0.9;
    const double accepted = reflectance > most_usual ? 0.01 : 0.005;
    Case result{numbered("cie171_enclosure_mean_rho", reflectance), Technique::direct | Technique::interreflection};
    double area = 0;
    for (const RoomFace& face : room_faces(room_size))
        area += length(face.u) * length(face.v);
    const double direct_mean = flux_lm / area, total = direct_mean / (1 - reflectance);
    Check check{"mean_total", total, accepted * total, {}, {}, false, "lx"};
    for (const RoomFace& face : room_faces(room_size))
        spread(face, nodes, length(face.u) * length(face.v) / area, check.sensors);
    check.only_full = reflectance > 0.5;
    result.setups.push_back({lamp_in_box(reflectance), {check}});
    result.references = {{"mean_total", total}, {"mean_direct", direct_mean}, {"mean_indirect", total - direct_mean}};
    return result;
}

/// What a ray brings through the pane, and back from it, out of a sky on one side.
Case pane_case(const std::string& id, double index, double transmissivity)
{
    constexpr double luminance = 1000, wide = 1000, accepted = 0.001;
    Case result{id, Technique::sky | Technique::glass};
    Setup setup;
    setup.scene = [=](const Perturbation& p) {
        Scene scene;
        scene.root.add_source({up, 180}, scene.add_material("glow", p.surroundings(luminance)), "sky");
        scene.root.add_polygon({{-wide, -wide, 1}, {wide, -wide, 1}, {wide, wide, 1}, {-wide, wide, 1}},
                               scene.add_material("pane", p.pane(transmissivity, index)), "pane");
        return scene;
    };
    for (const double degrees : {0.0, 10.0, 20.0, 30.0, 40.0, 45.0, 50.0, 60.0, 65.0, 70.0, 75.0, 80.0, 85.0, 89.0}) {
        const double angle = degrees * radians_per_degree, passed = pane_transmittance(transmissivity, index, angle);
        Check check = luminance_check(numbered("", degrees), luminance * passed, accepted, {0, 0, 0},
                                      {std::sin(angle), 0, std::cos(angle)});
        check.exact = true;
        setup.checks.push_back(check);
        result.references.emplace_back(numbered("", degrees), passed);
    }
    result.setups.push_back(setup);
    return result;
}

Case reflected_case(const std::string& name, double low, double high)
{
    // So narrow that the walls, along its light, get a ten thousandth of what they are to get from the square.
    constexpr double half_angle_deg = 1e-5, illuminance = 1000, reflectance = 0.3;
    const double sine = std::sin(half_angle_deg * radians_per_degree);
    const double luminance = illuminance / (pi * sine * sine);
    const std::vector<Point> square{{low, low, 0}, {high, low, 0}, {high, high, 0}, {low, high, 0}};
    Setup setup;
    setup.scene = [=](const Perturbation& p) {
        Scene scene;
        scene.root.add_source({up, 2 * half_angle_deg}, scene.add_material("solar", p.lamp(luminance)), "sun");
        scene.root.add_polygon(square, scene.add_material("square", p.diffuse(reflectance, 0)), "s2");
        return scene;
    };
    Check check{"14 places", 0, 0, {}, {}, false, "%"};
    check.tolerance_part = accepted_reflected;
    const std::string names = "ABCDEFGHIJKLMN";
    std::vector<Sensor> sensors = wall_and_level(0.25, 0.5, 3, down);
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        const Sensor& sensor = sensors[i];
        const double factor = polygon_illuminance(square, 1 / pi, sensor.position, sensor.normal);
        check.sensors.push_back({sensor, 100 / (illuminance * reflectance)});
        check.each.push_back(100 * factor);
        check.names.emplace_back(1, names[i]);
    }
    check.only_full = high < 3;
    setup.checks = {check};
    return {"cie171_diffuse_reflection_" + name, Technique::direct | Technique::interreflection, {setup}};
}

/// The black block is as wide as the wall behind it: it hides the wall up to one height.
double lowest_visible(const Point& from)
{
    constexpr double top = 1, near_y = 2.5, far_y = 2.7, wall_y = 4, wall_height = 3;
    if (from.z < top && from.y >= near_y)
        return wall_height;
    const double edge = from.z < top ? near_y : far_y; // which of its two upper edges the sight grazes
    const double height = from.z + (top - from.z) * (wall_y - from.y) / (edge - from.y);
    return std::clamp(height, 0.0, wall_height);
}

Case obstruction_case()
{
    constexpr double exitance = 1000;
    Setup setup;
    setup.scene = [](const Perturbation& p) {
        Scene scene;
        scene.root.add_polygon({{0, 4, 0}, {4, 4, 0}, {4, 4, 3}, {0, 4, 3}},
                               scene.add_material("lamp", p.lamp(exitance / pi)), "s2");
        const ModifierId black = scene.add_material("black", Plastic{});
        for (const RoomFace& face : room_faces({4, 0.2, 1}))
            scene.root.add_polygon(face.corners({0, 2.5, 0}), black, face.name);
        return scene;
    };
    Check check{"11 places", 0, 0.005, {}, {}, false, "%"};
    check.tolerance_part = accepted_reflected;
    const std::string names = "ABCDEFGHIJK";
    std::vector<Sensor> sensors = wall_and_level(2.75, -0.5, 0, up);
    for (std::size_t i = 0; i < names.size(); ++i) {
        const double z = lowest_visible(sensors[i].position);
        const std::vector<Point> seen{{0, 4, z}, {4, 4, z}, {4, 4, 3}, {0, 4, 3}};
        const double factor = z < 3 ? polygon_illuminance(seen, 1 / pi, sensors[i].position, sensors[i].normal) : 0;
        check.sensors.push_back({sensors[i], 100 / exitance});
        check.each.push_back(100 * factor);
        check.names.emplace_back(1, names[i]);
    }
    setup.checks = {check};
    return {"cie171_obstruction", direct, {setup}};
}

} // namespace

std::vector<Case> electric_cases()
{
    std::vector<Case> cases{point_case(true),
                            point_case(false),
                            area_case(),
                            flux_case(),
                            pane_case("cie171_glass_n1.52_ti1", 1.52, 1),
                            pane_case("cie171_glass_n1.52_ti0.96", 1.52, 0.96),
                            pane_case("cie171_glass_n1.526_ti0.9", 1.526, 0.9),
                            reflected_case("0.5m", 1.75, 2.25),
                            reflected_case("4m", 0, 4),
                            reflected_case("500m", -248, 252),
                            obstruction_case()};
    for (const double reflectance : {0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95})
        cases.push_back(enclosure_case(reflectance));
    return cases;
}

} // namespace lightwell
