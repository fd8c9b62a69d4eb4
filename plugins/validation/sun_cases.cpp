#include "plugins/validation/case.h"
#include "plugins/validation/lamp_formulas.h"

namespace lightwell {
namespace {

constexpr unsigned direct = static_cast<unsigned>(Technique::direct);
constexpr double half_angle_deg = 0.2665, half_angle = half_angle_deg * radians_per_degree;

/// The sun in the south.
Direction sun_at(double altitude_deg)
{
    return {0, -std::cos(altitude_deg * radians_per_degree), std::sin(altitude_deg * radians_per_degree)};
}

Scene with_sun(const Perturbation& p, const Direction& to_sun, double luminance)
{
    Scene scene;
    scene.root.add_source({to_sun, 2 * half_angle_deg}, scene.add_material("solar", p.lamp(luminance)), "sun");
    return scene;
}

Case disc_case(const std::string& id, double altitude_deg, double luminance)
{
    const Direction to_sun = sun_at(altitude_deg);
    const double normal = sun_illuminance(half_angle, luminance), horizontal = normal * to_sun.z;
    Case result{id, direct};
    result.setups.push_back({[=](const Perturbation& p) { return with_sun(p, to_sun, luminance); },
                             {detecting(illuminance_check("normal", normal, 0.001, {{0, 0, 0}, to_sun})),
                              detecting(illuminance_check("horizontal", horizontal, 0.001, {{0, 0, 0}, {0, 0, 1}}))}});
    result.references = {{"normal", normal},
                         {"horizontal", horizontal},
                         {"solid_angle_sr", 4 * pi * std::pow(std::sin(0.5 * half_angle), 2)}};
    return result;
}

/// A wide black sheet across the sun's direction, its straight edge `offset` half angles from the disc's centre.
Scene with_edge(const Perturbation& p, const Direction& to_sun, double luminance, double offset)
{
    constexpr double distance = 10, wide = 1;
    Scene scene = with_sun(p, to_sun, luminance);
    const Vec3 side{1, 0, 0}, across = cross(to_sun, side);
    const Point middle = to_sun * distance;
    const double edge = -offset * distance * std::tan(half_angle);
    scene.root.add_polygon({middle + side * edge - across * wide, middle + side * edge + across * wide,
                            middle - side * wide + across * wide, middle - side * wide - across * wide},
                           scene.add_material("black", Plastic{}), "sheet");
    return scene;
}

Case penumbra_case(const std::string& id, double altitude_deg, double luminance)
{
    constexpr double accepted = 0.01; // of the whole disc
    const Direction to_sun = sun_at(altitude_deg);
    const double whole = sun_illuminance(half_angle, luminance);
    Case result{id, direct};
    for (const double offset : {-1.2, -1.0, -0.75, -0.5, -0.25, 0.0, 0.25, 0.5, 0.75, 1.0, 1.2}) {
        const double part = free_part_of_disc(offset);
        result.references.emplace_back(numbered("", offset), part);
        Check check = illuminance_check(numbered("edge at ", offset), part * whole, 0, {{0, 0, 0}, to_sun});
        check.tolerance = accepted * whole;
        result.setups.push_back(
            {[=](const Perturbation& p) { return with_edge(p, to_sun, luminance, offset); }, {check}});
    }
    return result;
}

} // namespace

std::vector<Case> sun_cases()
{
    return {disc_case("cl_sun_disc_0.2665_60", 60, 1.6e9), penumbra_case("cl_penumbra_0.2665_60", 60, 1.6e9),
            disc_case("cl_sun_disc_0.2665_10", 10, 1.2e9), penumbra_case("cl_penumbra_0.2665_10", 10, 1.2e9)};
}

} // namespace lightwell
