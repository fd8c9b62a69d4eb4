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
                               scene.add_material("mirror", Mirror{Spectrum::grey(reflectance)}), "mirror");
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
        scene.root.add_polygon(mirror, scene.add_material("mirror", Mirror{Spectrum::grey(reflectance)}), "mirror");
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

} // namespace

std::vector<Case> mirror_cases()
{
    return {plane_case(), finite_case()};
}

} // namespace lightwell
