// Direct light of round spotlights by testing all of them in many places: the reference of the theatre.
// Usage: bench_exhaustive_spots SCENE.rad POINTS PLACES   (PLACES on each lamp, in four independent turns)
// Prints a line `value standard_error` for each point x y z nx ny nz: luminous weights applied, without 179 lm/W. It
// shares the reader and the ray queries with the program, and nothing of its sources and direct light.
//
// A lamp's light falls off from the focal point behind it, as far away as its aim is long: along a ray of length d to
// the lamp the solid angle is multiplied by (d / (d + focal length))^2, as Radiance does.

#include "engine/accel/ray_queries.h"
#include "engine/base/frame.h"
#include "engine/base/random.h"
#include "importers/radiance/radiance.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <vector>

namespace {

using namespace lightwell;

constexpr int turns = 4;
constexpr double golden_angle_rad = 2.399963229728653; // pi (3 - sqrt 5): the points of a sunflower fill a disc evenly
constexpr double red_weight = 0.265, green_weight = 0.670, blue_weight = 0.065;

struct Lamp {
    Point centre;
    Direction normal;
    double radius;
    Direction aim;
    double focal_length_m, cosine_of_half_angle, radiance;
};

std::vector<Lamp> find_lamps(const Scene& scene)
{
    std::vector<Lamp> lamps;
    for (const Surface& surface : scene.root.surfaces) {
        const auto* material = resolve(scene, surface.modifier).material;
        const auto* spot = material ? std::get_if<Spotlight>(material) : nullptr;
        if (!spot || surface.shape != Shape::ring)
            continue;
        const Ring& ring = scene.root.rings[surface.index];
        const Spectrum& l = spot->radiance;
        lamps.push_back({ring.centre, normalized(ring.normal), ring.outer_radius, normalized(spot->aim),
                         length(spot->aim), std::cos(spot->full_angle_deg / 2 * radians_per_degree),
                         red_weight * l.r + green_weight * l.g + blue_weight * l.b});
    }
    return lamps;
}

/// Irradiance from one place on a lamp per unit of its area, unless something stands between.
double from_place(const RayQueries& queries, const Lamp& lamp, const Point& place, const Point& at,
                  const Direction& normal)
{
    const Vec3 way = place - at;
    const double distance = length(way);
    const Direction to_lamp = way / distance;
    const double cos_receiver = dot(to_lamp, normal), cos_lamp = -dot(to_lamp, lamp.normal);
    if (cos_receiver <= 0 || cos_lamp <= 0 || -dot(to_lamp, lamp.aim) < lamp.cosine_of_half_angle)
        return 0;
    constexpr double short_of_the_lamp = 1 - 1e-9;
    if (queries.transmittance({at, way, short_of_the_lamp}).is_black())
        return 0;
    const double behind = distance + lamp.focal_length_m;
    return lamp.radiance * cos_receiver * cos_lamp / (behind * behind);
}

/// Can any of the lamp's light arrive? Its beam, widened by the lamp's own size, holds the point.
bool may_reach(const Lamp& lamp, const Point& at)
{
    const Vec3 way = at - lamp.centre;
    const double distance = length(way);
    const double angle = std::acos(std::fmin(1, dot(way, lamp.aim) / distance));
    return angle <= std::acos(lamp.cosine_of_half_angle) + std::asin(std::fmin(1, lamp.radius / distance));
}

double from_lamp(const RayQueries& queries, const Lamp& lamp, const Point& at, const Direction& normal, int places,
                 double turn_rad)
{
    const Frame frame = frame_about(lamp.normal);
    double sum = 0;
    for (int i = 0; i < places; ++i) {
        const double r = lamp.radius * std::sqrt((i + 0.5) / places), angle = turn_rad + i * golden_angle_rad;
        const Vec3 offset = frame.to_world({r * std::cos(angle), r * std::sin(angle), 0});
        sum += from_place(queries, lamp, lamp.centre + offset, at, normal);
    }
    return sum / places * pi * lamp.radius * lamp.radius;
}

void measure(const Scene& scene, std::istream& points, int places)
{
    const RayQueries queries(scene);
    const std::vector<Lamp> lamps = find_lamps(scene);
    RandomStream random(1);
    Point at;
    Vec3 normal;
    while (points >> at.x >> at.y >> at.z >> normal.x >> normal.y >> normal.z) {
        double sum = 0, variance = 0;
        for (const Lamp& lamp : lamps) {
            if (!may_reach(lamp, at))
                continue;
            double mean = 0, square = 0;
            for (int turn = 0; turn < turns; ++turn) {
                const double found =
                    from_lamp(queries, lamp, at, normalized(normal), places / turns, 2 * pi * random.next());
                mean += found / turns;
                square += found * found / turns;
            }
            sum += mean;
            variance += std::fmax(square - mean * mean, 0) / (turns - 1);
        }
        std::printf("%.9g %.3g\n", sum, std::sqrt(variance));
    }
}

} // namespace

int main(int argc, char** argv)
{
    const int places = argc == 4 ? std::atoi(argv[3]) : 0;
    if (places < turns) {
        std::fprintf(stderr, "usage: bench_exhaustive_spots SCENE.rad POINTS PLACES\n");
        return 2;
    }
    try {
        Report report;
        const Scene scene = read_radiance(argv[1], report);
        validate(scene);
        std::ifstream points(argv[2]);
        measure(scene, points, places);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 3;
    }
}
