#include "plugins/validation/case.h"
#include "plugins/validation/lamp_formulas.h"

namespace lightwell {
namespace {

constexpr unsigned techniques = Technique::direct | Technique::specular;

Point mirrored(const Point& p)
{
    return {-p.x, p.y, p.z};
}

/// A ball in place of the point: the light of a whole ball is that of a point, and so is that of its image, which a
/// scattered ray finds the more easily the larger it is.
Case plane_case()
{
    constexpr double reflectance = 0.9, intensity = 1000, radius = 1.2, wide = 5000, accepted = 0.002;
    const Point lamp{2, 0, 3};
    Case result{"cl_mirror_plane", techniques};
    Setup setup;
    setup.scene = [=](const Perturbation& p) {
        Scene scene;
        scene.root.add_polygon({{0, -wide, -wide}, {0, wide, -wide}, {0, wide, wide}, {0, -wide, wide}},
                               scene.add_material("mirror", p.mirror(reflectance)), "mirror");
        scene.root.add_sphere({lamp, radius}, Shape::sphere,
                              scene.add_material("lamp", p.lamp(intensity / (pi * radius * radius))), "lamp");
        return scene;
    };
    const std::vector<Point> places{{1, 0, 0}, {3, 1, 0}, {0.1, -2, 0.5}};
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto from = [&](const Point& source) {
            const Vec3 to = source - places[i];
            return intensity * to.z / std::pow(length(to), 3);
        };
        const std::string name = numbered("s", static_cast<double>(i));
        const double direct = from(lamp), reflected = reflectance * from(mirrored(lamp));
        result.references.emplace_back(name + ".direct", direct);
        result.references.emplace_back(name + ".via_mirror", reflected);
        setup.checks.push_back(
            illuminance_check(name + " total", direct + reflected, accepted, {places[i], {0, 0, 1}}));
    }
    result.setups.push_back(setup);
    return result;
}

/// The image of the lamp, cut by the pyramid from the sensor through the mirror's outline.
double seen_in_mirror(const std::vector<Point>& lamp, const std::vector<Point>& mirror, double luminance,
                      const Sensor& sensor)
{
    std::vector<Vec3> image;
    for (const Point& corner : lamp)
        image.push_back(mirrored(corner) - sensor.position);
    Vec3 middle;
    for (const Point& corner : mirror)
        middle += (corner - sensor.position) / static_cast<double>(mirror.size());
    for (std::size_t i = 0; i < mirror.size(); ++i) {
        Vec3 side = cross(mirror[i] - sensor.position, mirror[(i + 1) % mirror.size()] - sensor.position);
        image = front_part(image, dot(side, middle) > 0 ? side : -side);
    }
    return image.empty() ? 0 : polygon_illuminance(image, luminance, {}, sensor.normal);
}

Case finite_case()
{
    constexpr double reflectance = 0.85, luminance = 2000, accepted = 0.01;
    const std::vector<Point> lamp{{1, -0.5, 2.5}, {1, 0.5, 2.5}, {2, 0.5, 2.5}, {2, -0.5, 2.5}}; // front down
    const std::vector<Point> mirror{{0, -0.4, 0.8}, {0, 0.4, 0.8}, {0, 0.4, 1.6}, {0, -0.4, 1.6}};
    Case result{"cl_finite_mirror_area_light", techniques};
    Setup setup;
    setup.scene = [=](const Perturbation& p) {
        Scene scene;
        scene.root.add_polygon(lamp, scene.add_material("lamp", p.lamp(luminance)), "lamp");
        scene.root.add_polygon(mirror, scene.add_material("mirror", p.mirror(reflectance)), "mirror");
        return scene;
    };
    const std::vector<Sensor> sensors{{{1.5, 0, 0}, {0, 0, 1}},
                                      {{1, 0.4, 0}, {0, 0, 1}},
                                      {{2, 0, 0.2}, normalized({-1, 0, 1})},
                                      {{1.2, 0.5, 0.3}, {-1, 0, 0}}};
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        const std::string name = numbered("s", static_cast<double>(i));
        const double direct = polygon_illuminance(lamp, luminance, sensors[i].position, sensors[i].normal);
        const double reflected = reflectance * seen_in_mirror(lamp, mirror, luminance, sensors[i]);
        result.references.emplace_back(name + ".direct", direct);
        result.references.emplace_back(name + ".via_mirror", reflected);
        setup.checks.push_back(illuminance_check(name + " total", direct + reflected, accepted, sensors[i]));
    }
    result.setups.push_back(setup);
    return result;
}

/// A point lamp between two mirrors x = 0 and x = gap: its images up to an order, and all that count.
class ParallelMirrors {
public:
    static constexpr double gap = 1.5, reflectance = 0.9, intensity = 1000;
    static constexpr Point lamp{0.4, 0, 2};
    /// Terms fall as reflectance^order: beyond this they are below 1e-16.
    static constexpr int all_orders = 400;

    static double up_to(int order, const Point& at)
    {
        double sum = term(lamp.x, at);
        for (const bool first_at_zero : {true, false}) {
            double x = lamp.x, weight = 1;
            for (int k = 1; k <= order; ++k) {
                x = ((k % 2 == 1) == first_at_zero) ? -x : 2 * gap - x;
                sum += (weight *= reflectance) * term(x, at);
            }
        }
        return sum;
    }

private:
    static double term(double x, const Point& at)
    {
        const Vec3 to = Point{x, lamp.y, lamp.z} - at;
        return intensity * to.z / std::pow(length(to), 3);
    }
};

/// Chains of twelve mirrors leave less than a part in a thousand to what scattered rays would find.
Case parallel_case()
{
    constexpr double wide = 5000, radius = 1e-3, accepted = 0.005;
    Case result{"cl_mirrors_parallel", techniques};
    Setup setup;
    setup.preparation.virtual_depth = 12;
    setup.scene = [=](const Perturbation& p) {
        Scene scene;
        const ModifierId mirror = scene.add_material("mirror", p.mirror(ParallelMirrors::reflectance));
        for (const double x : {0.0, ParallelMirrors::gap})
            scene.root.add_polygon({{x, -wide, -wide}, {x, wide, -wide}, {x, wide, wide}, {x, -wide, wide}}, mirror,
                                   "mirror");
        scene.root.add_sphere({ParallelMirrors::lamp, radius}, Shape::sphere,
                              scene.add_material("lamp", p.lamp(ParallelMirrors::intensity / (pi * radius * radius))),
                              "lamp");
        return scene;
    };
    const std::vector<Point> places{{0.75, 0, 0}, {1.2, 0.5, 0}, {0.1, -2, 0.5}};
    for (std::size_t i = 0; i < places.size(); ++i) {
        const std::string name = numbered("s", static_cast<double>(i));
        const double total = ParallelMirrors::up_to(ParallelMirrors::all_orders, places[i]);
        result.references.emplace_back(name + ".total", total);
        for (int order = 0; order <= 4; ++order)
            result.references.emplace_back(numbered(name + ".up_to_order_", order),
                                           ParallelMirrors::up_to(order, places[i]));
        setup.checks.push_back(illuminance_check(name + " total", total, accepted, {places[i], {0, 0, 1}}));
    }
    result.setups.push_back(setup);
    return result;
}

} // namespace

std::vector<Case> mirror_cases()
{
    return {plane_case(), parallel_case(), finite_case()};
}

} // namespace lightwell
