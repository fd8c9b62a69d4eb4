#include "engine/simulate/walk.h"

#include "materials/emission.h"

/// \file What single rays bring to a place, and the places that light comes by.
namespace lightwell {

/// @param weight  of what the ray brings from surfaces
PathTracer::Walk PathTracer::arriving_walk(const Vertex& vertex, const Direction& direction, double weight) const
{
    Walk walk;
    walk.ray = {vertex.hit.leave(direction), direction, infinity, vertex.hit.in};
    walk.arriving_throughput = Spectrum::grey(pi);
    walk.aim_weight = weight;
    walk.at_first = false;
    walk.bent = true;
    walk.sources = Walk::Sources::answered;
    walk.chain.begin();
    walk.scattered_density = cosine_hemisphere_density_per_sr(dot(direction, vertex.side));
    walk.scatterings = 1;
    walk.straight_from_receiver = true;
    return walk;
}

Arrival PathTracer::arrive(const SurfacePlace& receiver, const Direction& direction, PathRandom& random,
                           std::vector<Dependence>& dependences) const
{
    const Vertex vertex = white_vertex(receiver);
    Arrival arrival;
    SourceShares shares;
    if (!sources_.sky().empty()) {
        const GatherWish sky{later_rays, {false, false, true}, LobeSet::all};
        arrival.irradiance = direct_.gather(vertex, sky, random, shares).irradiance;
    }
    const Aim aim(ambient_.deep != nullptr ? &ambient_.deep->bright() : nullptr, ambient_.secondary, receiver.position,
                  receiver.normal);
    const auto cosine_density = [&](const Direction& d) {
        return cosine_hemisphere_density_per_sr(dot(d, receiver.normal));
    };
    const double weight = aim ? 1 - shadow_ray_weight(aim.density_per_sr(direction), cosine_density(direction)) : 1;
    Walk walk = arriving_walk(vertex, direction, weight);
    walk.shares = shares;
    walk.dependences = &dependences;
    run(walk, random);
    arrival.irradiance += walk.irradiance;
    arrival.radiance = walk.radiance;
    arrival.met_lamp = walk.met_lamp;
    if (walk.first)
        arrival.met = {length(walk.first->position - receiver.position), facing(walk.first->normal, direction)};
    const SampledDirection aimed = aim ? aim.sample(random.pair()) : SampledDirection{};
    const double cosine = cosine_density(aimed.direction);
    if (aimed.density_per_sr > 0 && cosine > 0) {
        const double share = shadow_ray_weight(aimed.density_per_sr, cosine);
        Walk second = arriving_walk(vertex, aimed.direction, share * cosine / aimed.density_per_sr);
        second.aimed = true;
        second.dependences = &dependences;
        run(second, random);
        arrival.irradiance += second.irradiance;
    }
    return arrival;
}

Spectrum PathTracer::scattered_radiance(const Point& to, const Direction& direction, PathRandom& random) const
{
    Walk walk;
    walk.ray = {to, direction, infinity};
    walk.at_first = false;
    walk.bent = true;
    walk.sources = Walk::Sources::answered;
    walk.chain.begin();
    walk.straight_from_receiver = true;
    walk.aimed = true;
    run(walk, random);
    return walk.radiance;
}

void PathTracer::receivers_along(const Ray& ray, int scatterings, PathRandom& random,
                                 std::vector<SurfacePlace>& found) const
{
    Walk walk;
    walk.ray = ray;
    int bends = 0;
    constexpr int most_steps = 32;
    for (int step = 0; step < most_steps; ++step) {
        Hit hit;
        if (!rays_.closest(walk.ray, hit))
            return;
        SeenMaterial seen;
        const bool passed = rays_.volumes().any() && cross_volume(walk, hit);
        const Material* material = passed ? nullptr : seen_material(walk, hit, seen);
        if (material == nullptr) {
            walk.ray = {hit.leave(walk.ray.direction), walk.ray.direction, infinity, walk.ray.in};
            continue;
        }
        if (is_emitter(*material) || std::holds_alternative<Prism>(*material))
            return;
        const Vertex vertex(hit, walk.ray.direction, *material);
        const Lobes& lobes = vertex.bsdf.lobes();
        if (!lobes.diffuse_reflectance.is_black() || walk.at_first)
            found.push_back({hit.position, vertex.side, hit.error_m});
        if (!lobes.diffuse_transmittance.is_black())
            found.push_back({hit.position, -vertex.side, hit.error_m});
        if (is_diffuse(lobes) && bends++ == scatterings)
            return;
        if (!scatter(walk, vertex, LobeSet::all, random))
            return;
    }
}

} // namespace lightwell
