#include "engine/plan/surroundings.h"

#include "engine/base/frame.h"
#include "engine/base/random.h"
#include "engine/sampling/warps.h"
#include "materials/mirror.h"

#include <array>
#include <cmath>

namespace lightwell {
namespace {

constexpr std::size_t walks = 512;
/// Bounces over which weakening is measured: the first differ from the later ones.
constexpr std::size_t bounces = 5;
/// Panes and mirrors on the way are passed without counting as a bounce; more of them end the walk.
constexpr int most_passed = 32;

/// Weight of the walks at their n-th surface, and what the first rays met.
struct Sums {
    std::array<double, bounces + 1> weight{};
    double open = 0, distance_m = 0;
};

/// Follows one ray to the next surface that scatters; false when it meets none.
bool next_surface(const Scene& scene, const RayQueries& rays, Ray& ray, Hit& hit, double& weight, double& reflectance)
{
    for (int passed = 0; passed < most_passed; ++passed) {
        if (!rays.closest(ray, hit))
            return false;
        const Material* material = resolve(scene, hit.modifier).material;
        if (material == nullptr) {
            ray.origin = hit.leave(ray.direction);
            continue;
        }
        if (const auto* glass = std::get_if<Glass>(material)) {
            weight *= photopic(glass->transmissivity);
            ray.origin = hit.leave(ray.direction);
        } else if (const auto* mirror = std::get_if<Mirror>(material)) {
            weight *= photopic(mirror->reflectance);
            const Vec3 d = ray.direction;
            ray.direction = d - hit.normal * (2 * dot(d, hit.normal));
            ray.origin = hit.leave(ray.direction);
        } else {
            reflectance = is_emitter(*material) ? 0 : photopic(typical_reflectance(*material));
            return true;
        }
    }
    return false;
}

void walk(const Scene& scene, const RayQueries& rays, const Lookout& place, RandomStream& random, Sums& sums)
{
    const Direction start = normalized(place.towards);
    Ray ray{place.position + start * place.lift_m, frame_about(start).to_world(cosine_hemisphere(random.square())),
            infinity};
    double weight = 1;
    for (std::size_t bounce = 0; bounce <= bounces && weight > 0; ++bounce) {
        Hit hit;
        double reflectance = 0;
        const Point from = ray.origin;
        if (!next_surface(scene, rays, ray, hit, weight, reflectance)) {
            sums.open += bounce == 0 ? 1 : 0;
            return;
        }
        if (bounce == 0)
            sums.distance_m += length(hit.position - from);
        sums.weight[bounce] += weight;
        weight *= reflectance;
        const Direction side = dot(hit.normal, ray.direction) <= 0 ? hit.normal : -hit.normal;
        ray.direction = frame_about(side).to_world(cosine_hemisphere(random.square()));
        ray.origin = hit.leave(ray.direction);
    }
}

} // namespace

Surroundings look_around(const Scene& scene, const RayQueries& rays, const std::vector<Lookout>& places)
{
    Sums sums;
    for (std::size_t i = 0; i < walks; ++i) {
        RandomStream random(1, i, 0);
        walk(scene, rays, places[i * places.size() / walks], random, sums);
    }
    Surroundings found;
    found.open_share = sums.open / walks;
    if (sums.weight.front() > 0) {
        found.distance_m = sums.distance_m / (walks - sums.open);
        found.kept_per_bounce = std::pow(sums.weight.back() / sums.weight.front(), 1.0 / bounces);
    }
    return found;
}

} // namespace lightwell
