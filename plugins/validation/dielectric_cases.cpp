#include "plugins/validation/case.h"
#include "plugins/validation/glass_formulas.h"

#include <algorithm>

namespace lightwell {
namespace {

constexpr double luminance = 1000, accepted = 0.003;
/// Where light meets two boundaries the engine takes each as unpolarized: up to 0.4 % at the angles measured here.
constexpr double accepted_two_boundaries = 0.005;

void add_facing_out(Scene& scene, std::vector<Point> corners, const Point& inside, ModifierId modifier)
{
    if (dot(polygon_area_vector(corners.data(), corners.size()), corners[0] - inside) < 0)
        std::reverse(corners.begin(), corners.end());
    scene.root.add_polygon(corners, modifier, "face");
}

/// A lamp that a ray meets only when its direction is right to 1e-4 degrees.
void add_target(Scene& scene, const Perturbation& p, const Point& exit, const Direction& direction, double distance)
{
    const double radius = distance * std::tan(1e-4 * radians_per_degree);
    scene.root.add_ring({exit + direction * distance, -direction, 0, radius},
                        scene.add_material("lamp", p.lamp(luminance)), "target");
}

/// The reflectance alone: what enters the block is absorbed within the width of a hair.
Setup reflection(double index, double degrees)
{
    const double angle = degrees * radians_per_degree;
    const Direction down{std::sin(angle), 0, -std::cos(angle)};
    return {[=](const Perturbation& p) {
                Scene scene;
                constexpr double w = 1000, depth = 10;
                scene.root.add_source({{0, 0, 1}, 180}, scene.add_material("glow", p.surroundings(luminance)), "sky");
                const ModifierId ink = scene.add_material("ink", Dielectric{Spectrum::grey(1e-30), index, 0});
                const Point inside{0, 0, -0.5 * depth};
                for (const double z : {0.0, -depth})
                    add_facing_out(scene, {{-w, -w, z}, {w, -w, z}, {w, w, z}, {-w, w, z}}, inside, ink);
                for (const double s : {-w, w}) {
                    add_facing_out(scene, {{s, -w, 0}, {s, w, 0}, {s, w, -depth}, {s, -w, -depth}}, inside, ink);
                    add_facing_out(scene, {{-w, s, 0}, {w, s, 0}, {w, s, -depth}, {-w, s, -depth}}, inside, ink);
                }
                return scene;
            },
            {luminance_check(numbered("reflected at ", degrees), luminance * boundary(angle, index).mean(), accepted,
                             down * -3.0, down)}};
}

Case fresnel_case(const std::string& id, double index)
{
    Case result{id, Technique::specular | Technique::sky};
    for (const double degrees : {0.0, 30.0, 45.0, 70.0, 80.0, 85.0, 89.0, 89.9}) {
        const double angle = degrees * radians_per_degree;
        const Reflectances r = boundary(angle, index);
        const std::string key = numbered("outside.", degrees);
        result.references.emplace_back(key + ".Rs", r.senkrecht);
        result.references.emplace_back(key + ".Rp", r.parallel);
        result.references.emplace_back(key + ".R", r.mean());
        result.references.emplace_back(key + ".refraction_angle_deg",
                                       std::asin(std::sin(angle) / index) / radians_per_degree);
        if (degrees <= 89)
            result.setups.push_back(reflection(index, degrees));
    }
    for (const double degrees : {10.0, 30.0, 60.0, 85.0})
        result.references.emplace_back(numbered("inside_R.", degrees),
                                       boundary(degrees * radians_per_degree, 1 / index).mean());
    result.references.emplace_back("critical_angle_deg", std::asin(1 / index) / radians_per_degree);
    result.references.emplace_back("brewster_deg", std::atan(index) / radians_per_degree);
    return result;
}

Direction in_plane(double angle)
{
    return {std::cos(angle), 0, std::sin(angle)};
}

Case ball_case(const std::string& id, double radius, double index)
{
    Case result{id, Technique::specular | Technique::direct};
    for (const double b : {0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99}) {
        const BallPassage passage = through_ball(b, index);
        const std::string key = numbered("b/R=", b);
        result.references.emplace_back(key + ".deviation_transmitted_deg", passage.deviation_rad / radians_per_degree);
        result.references.emplace_back(key + ".deviation_one_internal_reflection_deg",
                                       passage.deviation_reflected_rad / radians_per_degree);
        result.references.emplace_back(key + ".externally_reflected", passage.externally_reflected);
        result.references.emplace_back(key + ".first_transmitted", passage.transmitted);
        result.references.emplace_back(key + ".one_internal_reflection", passage.reflected_once);
        constexpr double largest_impact = 0.8; // beyond, light is polarized by the first boundary
        if (b > largest_impact)
            continue;
        const Point exit = radius * in_plane(2 * std::asin(b / index) - std::asin(b));
        result.setups.push_back(
            {[=](const Perturbation& p) {
                 Scene scene;
                 scene.root.add_sphere({{0, 0, 0}, radius}, Shape::sphere,
                                       scene.add_material("clear", Dielectric{Spectrum::grey(1), index, 0}), "ball");
                 add_target(scene, p, exit, in_plane(-passage.deviation_rad), 10 * radius);
                 return scene;
             },
             {luminance_check(key + " passes", luminance * passage.transmitted, accepted_two_boundaries,
                              {-4 * radius, 0, b * radius}, {1, 0, 0})}});
    }
    result.references.emplace_back("focal_distance", radius * index / (2 * (index - 1)));
    return result;
}

/// A prism with its edge along y, its body below; the ray meets the first face one metre from the edge.
Scene prism_scene(const Perturbation& p, double apex, double index, const Point& exit, const Direction& direction)
{
    constexpr double leg = 3, half_length = 1;
    Scene scene;
    const ModifierId clear = scene.add_material("clear", Dielectric{Spectrum::grey(1), index, 0});
    const double x = leg * std::sin(0.5 * apex), z = -leg * std::cos(0.5 * apex), y = half_length;
    const Point inside{0, 0, 0.5 * z};
    add_facing_out(scene, {{0, -y, 0}, {0, y, 0}, {-x, y, z}, {-x, -y, z}}, inside, clear);
    add_facing_out(scene, {{0, -y, 0}, {0, y, 0}, {x, y, z}, {x, -y, z}}, inside, clear);
    add_facing_out(scene, {{-x, -y, z}, {-x, y, z}, {x, y, z}, {x, -y, z}}, inside, clear);
    for (const double side : {-y, y})
        add_facing_out(scene, {{0, side, 0}, {-x, side, z}, {x, side, z}}, inside, clear);
    add_target(scene, p, exit, direction, 10);
    return scene;
}

Case prism_case(const std::string& id, double apex_deg, double index)
{
    Case result{id, Technique::specular | Technique::direct};
    const double apex = apex_deg * radians_per_degree;
    const double least = 2 * std::asin(index * std::sin(0.5 * apex)) - apex;
    result.references.emplace_back("minimum_deviation_deg", least / radians_per_degree);
    for (const double degrees : {0.0, 20.0, 40.0, 60.0, 80.0}) {
        const double incidence = degrees * radians_per_degree;
        const PrismPassage passage = through_prism(apex, index, incidence);
        if (passage.total)
            continue;
        const std::string key = numbered("i", degrees);
        result.references.emplace_back(key + ".deviation_deg", passage.deviation_rad / radians_per_degree);
        result.references.emplace_back(key + ".exit_angle_deg", passage.exit_rad / radians_per_degree);
        result.references.emplace_back(key + ".transmittance_no_internal_reflections", passage.transmittance);
        constexpr double steepest = 70; // beyond, light is polarized by the first boundary
        if (degrees > steepest)
            continue;
        const Direction arriving = in_plane(incidence - 0.5 * apex),
                        within = in_plane(std::asin(std::sin(incidence) / index) - 0.5 * apex),
                        second_normal = in_plane(0.5 * apex), leaving = in_plane(0.5 * apex - passage.exit_rad);
        const Point enter{-std::sin(0.5 * apex), 0, -std::cos(0.5 * apex)};
        const Point exit = enter - within * (dot(second_normal, enter) / dot(second_normal, within));
        result.setups.push_back({[=](const Perturbation& p) { return prism_scene(p, apex, index, exit, leaving); },
                                 {luminance_check(key + " passes", luminance * passage.transmittance,
                                                  accepted_two_boundaries, enter - arriving * 5.0, arriving)}});
    }
    return result;
}

} // namespace

std::vector<Case> dielectric_cases()
{
    std::vector<Case> cases{fresnel_case("cl_fresnel_n1.33", 1.33),     fresnel_case("cl_fresnel_n1.52", 1.52),
                            fresnel_case("cl_fresnel_n2.4", 2.4),       ball_case("cl_ball_n1.5", 1, 1.5),
                            ball_case("cl_ball_n1.333", 0.5, 1.333),    prism_case("cl_prism_A60_n1.5", 60, 1.5),
                            prism_case("cl_prism_A30_n1.49", 30, 1.49), prism_case("cl_prism_A10_n1.52", 10, 1.52)};
    for (Case& c : cases)
        for (Setup& setup : c.setups)
            for (Check& check : setup.checks)
                check.exact = true; // at two boundaries both the mirrored and the passing light are followed
    return cases;
}

} // namespace lightwell
