#include "tests/extremes/extremes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace lightwell {

ExtremeValues illuminance_at(const Scene& scene, const std::vector<Sensor>& sensors, int samples,
                             const Preparation& preparation)
{
    GridSettings settings;
    settings.samples = samples;
    SensorGrid grid;
    grid.sensors = sensors;
    const GridResult result = Simulation(Scene(scene), preparation).illuminance(grid, settings);
    ExtremeValues found;
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        found.values.push_back(result.values[i].value);
        found.errors.push_back(result.standard_errors[i].value);
    }
    return found;
}

ExtremeRow::ExtremeRow(std::string id, std::string item, std::string radiance)
    : id_(std::move(id)), item_(std::move(item)), radiance_(std::move(radiance))
{
}

ExtremeRow::~ExtremeRow()
{
    std::printf("| %s | %s | %.2g | %.2g | %s |\n", id_.c_str(), item_.c_str(), worst_, tolerance_,
                radiance_.empty() ? "-" : radiance_.c_str());
}

void ExtremeRow::compare(double found, double expected, double tolerance, double standard_error)
{
    EXPECT_LE(standard_error, std::max(tolerance * std::fabs(expected), 1e-300))
        << id_ << " " << item_ << ": too noisy to tell";
    holds(found, expected, tolerance, standard_error);
}

void ExtremeRow::holds(double found, double expected, double tolerance, double standard_error)
{
    const double size = std::fabs(expected), off = std::fabs(found - expected);
    EXPECT_LE(off, tolerance * size + 3 * standard_error)
        << id_ << " " << item_ << ": found " << found << " +- " << standard_error << ", expected " << expected;
    const double relative = size > 0 ? off / size : off;
    if (relative / tolerance > ratio_) {
        ratio_ = relative / tolerance;
        worst_ = relative;
        tolerance_ = tolerance;
    }
}

void add_lamp(Scene& scene, std::vector<Point> corners, double luminance, const Point& to)
{
    if (dot(polygon_area_vector(corners.data(), corners.size()), to - corners[0]) < 0)
        std::reverse(corners.begin(), corners.end());
    ModifierId lamp = scene.find_modifier("lamp");
    if (lamp == void_modifier)
        lamp = scene.add_material("lamp", Light{Spectrum::grey(luminance / lumens_per_watt)});
    scene.root.add_polygon(corners, lamp, "lamp");
}

std::vector<Point> base_square()
{
    return {{-0.5, -0.5, 2}, {-0.5, 0.5, 2}, {0.5, 0.5, 2}, {0.5, -0.5, 2}};
}

std::vector<Sensor> base_sensors()
{
    return {{{0, 0, 0}, {0, 0, 1}}, {{0.7, 0.3, 0}, {0, 0, 1}}, {{2.5, -1, 0.5}, {0, 0, 1}}};
}

Scene white_box(double reflectance, const Vec3& at)
{
    const double passed = 1 - reflectance;
    Scene scene;
    scene.root.add_source({{0, 0, 1}, 360},
                          scene.add_material("glow", Glow{Spectrum::grey(1 / (pi * passed) / lumens_per_watt), 0}),
                          "outside");
    const ModifierId wall = scene.add_material("wall", Trans{Spectrum::grey(1), 0, 0, passed, 0});
    const Point s{4, 4, 3};
    const auto face = [&](std::vector<Point> corners) {
        for (Point& p : corners)
            p += at;
        scene.root.add_polygon(corners, wall, "wall");
    };
    face({{0, 0, 0}, {s.x, 0, 0}, {s.x, s.y, 0}, {0, s.y, 0}});
    face({{0, 0, s.z}, {0, s.y, s.z}, {s.x, s.y, s.z}, {s.x, 0, s.z}});
    face({{0, 0, 0}, {0, s.y, 0}, {0, s.y, s.z}, {0, 0, s.z}});
    face({{s.x, 0, 0}, {s.x, 0, s.z}, {s.x, s.y, s.z}, {s.x, s.y, 0}});
    face({{0, 0, 0}, {0, 0, s.z}, {s.x, 0, s.z}, {s.x, 0, 0}});
    face({{0, s.y, 0}, {s.x, s.y, 0}, {s.x, s.y, s.z}, {0, s.y, s.z}});
    return scene;
}

double seen_in_furnace(double roughness, double degrees, double& error)
{
    Scene scene;
    scene.root.add_source({{0, 0, 1}, 360}, scene.add_material("glow", Glow{Spectrum::grey(1), 0}), "all_around");
    constexpr double wide = 1e3;
    scene.root.add_polygon({{-wide, -wide, 0}, {wide, -wide, 0}, {wide, wide, 0}, {-wide, wide, 0}},
                           scene.add_material("metal", Metal{Spectrum::grey(1), 1, roughness}), "plate");
    View view;
    const double a = degrees * radians_per_degree;
    view.position = {-std::sin(a), 0, std::cos(a)};
    view.direction = {std::sin(a), 0, -std::cos(a)};
    view.up = {0, 1, 0};
    view.horizontal = view.vertical = 1e-6;
    PictureSettings settings;
    settings.width = settings.height = 1;
    settings.samples = 1 << 14;
    settings.unbiased = true;
    const Picture picture = Simulation(std::move(scene)).render(view, settings).picture;
    error = picture.at("error.G", 0, 0);
    return picture.at("G", 0, 0);
}

} // namespace lightwell
