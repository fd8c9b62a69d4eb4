#include "engine/simulate/path_tracer.h"

#include "materials/emission.h"

#include <algorithm>

namespace lightwell {
namespace {

/// Shadow rays to lamps and to the sky at the first vertex, where their noise is seen directly, and at later ones.
constexpr int first_rays = 4, later_rays = 1;
/// Paths are never ended before this many scatterings.
constexpr int sure_scatterings = 3;
/// Even a path that loses nothing ends some day.
constexpr double most_survival = 0.9999;

} // namespace

/// A path on its way.
struct PathTracer::Walk {
    Ray ray;
    Spectrum throughput = Spectrum::grey(1);
    Spectrum radiance;
    Spectrum arriving_throughput; ///< the same for the irradiance on the first surface
    Spectrum irradiance;
    bool at_first = true;          ///< no scattering has happened yet
    std::optional<Hit> first;      ///< what the ray from the eye met
    bool first_is_diffuse = false; ///< so that its scattered light tells its irradiance
    Spectrum first_reflectance;    ///< diffuse
    Spectrum direct_irradiance;    ///< on the first surface
    double closeness_per_m = 0;
    bool no_shadow_rays = true;   ///< the last scattering was a single direction: sources are met in full
    double scattered_density = 0; ///< of the last scattering
    SourceShares shares;          ///< of the shadow rays there
    SourceShares here;            ///< of the shadow rays at this vertex; they become `shares` when the path bends
    int scatterings = 0;

    void add(Spectrum light)
    {
        radiance += throughput * light;
        irradiance += arriving_throughput * light;
    }
    /// Weight of a source met by a scattered ray against shadow rays of this density.
    double weight(double shadow_density) const
    {
        return no_shadow_rays ? 1 : 1 - shadow_ray_weight(shadow_density, scattered_density);
    }
};

PathTracer::PathTracer(const Scene& scene, const RayQueries& rays, const SourceList& sources)
    : scene_(scene), rays_(rays), sources_(sources), direct_(sources, rays), white_(Plastic{Spectrum::grey(1), 0, 0})
{
    for (std::size_t i = 0; i < scene.modifiers.size(); ++i) {
        const Material* material = resolve(scene, static_cast<ModifierId>(i)).material;
        materials_.push_back(material);
        const Illum* illum = material != nullptr ? std::get_if<Illum>(material) : nullptr;
        const bool has_alternate = illum != nullptr && !illum->alternate.empty() && illum->alternate != "void";
        alternates_.push_back(has_alternate ? resolve(scene, scene.find_modifier(illum->alternate)).material : nullptr);
    }
}

void PathTracer::meet_distant(Walk& walk) const
{
    const Direction direction = walk.ray.direction;
    if (!sources_.sky().empty()) {
        const Spectrum radiance = sources_.sky().radiance(direction);
        if (!radiance.is_black())
            walk.add(radiance * walk.weight(walk.no_shadow_rays ? 0 : direct_.sky_density(walk.shares, direction)));
    }
    for (const SunSource& sun : sources_.suns())
        if (const double density = sun.density_per_sr(direction); density > 0)
            walk.add(sun.radiance * walk.weight(density));
}

void PathTracer::meet_emitter(Walk& walk, const Hit& hit, const Material& material) const
{
    const Direction direction = walk.ray.direction;
    const double distance_m = walk.no_shadow_rays ? hit.t : length(hit.position - walk.shares.from);
    const Spectrum radiance =
        emitted_towards(material, -dot(hit.normal, direction), -direction) * beam_share(material, distance_m);
    if (radiance.is_black())
        return;
    const int lamp = sources_.lamp_at(hit);
    double shadow_density = 0;
    if (lamp >= 0 && !walk.no_shadow_rays) {
        if (std::holds_alternative<Illum>(material))
            return; // its light has come by shadow rays alone
        shadow_density = direct_.lamp_density(walk.shares, lamp, direction, hit);
    }
    walk.add(radiance * walk.weight(shadow_density));
}

void PathTracer::gather_at(Walk& walk, const Vertex& vertex, PathRandom& random) const
{
    const bool first = walk.at_first;
    const Gathered direct = direct_.gather(vertex, first ? first_rays : later_rays, random, walk.here);
    walk.radiance += walk.throughput * direct.radiance;
    if (first)
        walk.irradiance = walk.direct_irradiance = direct.irradiance;
    else
        walk.irradiance += walk.arriving_throughput * direct.radiance;
}

bool PathTracer::scatter(Walk& walk, const Vertex& vertex, PathRandom& random) const
{
    const double choice = random.one();
    const std::optional<BsdfSample> scattered = vertex.bsdf.sample(vertex.to_viewer, choice, random.pair());
    const Direction local = scattered ? scattered->to_light : Direction{};
    const Direction world = scattered && scattered->straight ? walk.ray.direction : vertex.frame.to_world(local);
    if (!scattered || scattered->weight.is_black() || !vertex.same_side(world, local))
        return false;
    if (walk.at_first && !scattered->delta && local.z > 0)
        walk.arriving_throughput = Spectrum::grey(local.z / scattered->density_per_sr);
    else if (walk.at_first)
        walk.arriving_throughput = {};
    else
        walk.arriving_throughput *= scattered->weight;
    walk.throughput *= scattered->weight;
    walk.ray = {vertex.hit.leave(world), normalized(world), infinity};
    if (!scattered->straight) { // a straight passage leaves the weights of the last scattering as they are
        walk.shares = walk.here;
        walk.no_shadow_rays = scattered->delta;
        walk.scattered_density = scattered->density_per_sr;
    }
    ++walk.scatterings;
    walk.at_first = false;
    if (walk.scatterings < sure_scatterings)
        return true;
    const double survival =
        std::min(most_survival, std::max(walk.throughput.max(), walk.arriving_throughput.max() / pi));
    if (random.one() >= survival)
        return false;
    walk.throughput = walk.throughput / survival;
    walk.arriving_throughput = walk.arriving_throughput / survival;
    return true;
}

bool PathTracer::meet_surface(Walk& walk, PathRandom& random) const
{
    Hit hit;
    if (!rays_.closest(walk.ray, hit)) {
        meet_distant(walk);
        return false;
    }
    if (!walk.first)
        walk.first = hit;
    if (walk.scatterings ==
        1) // arriving_throughput / pi turns the mean over scattered rays into the cosine-weighted one
        walk.closeness_per_m = walk.arriving_throughput.max() / (pi * hit.t);
    const auto modifier = static_cast<std::size_t>(hit.modifier);
    const Material* material = materials_[modifier];
    if (std::holds_alternative<Illum>(*material) && (walk.no_shadow_rays || dot(hit.normal, walk.ray.direction) > 0)) {
        material = alternates_[modifier];
        if (material == nullptr) { // invisible: the ray goes on as if it had met nothing
            walk.ray = {hit.leave(walk.ray.direction), walk.ray.direction, infinity};
            return true;
        }
    }
    if (is_emitter(*material)) {
        meet_emitter(walk, hit, *material);
        return false;
    }
    const Vertex vertex(hit, walk.ray.direction, *material);
    const auto* body = std::get_if<Dielectric>(material);
    if (body != nullptr && dot(hit.normal, walk.ray.direction) > 0) { // the way here was inside the body
        const Spectrum left = body->transmission_per_m;
        const Spectrum kept{std::pow(left.r, hit.t), std::pow(left.g, hit.t), std::pow(left.b, hit.t)};
        walk.throughput *= kept;
        walk.arriving_throughput *= kept;
    }
    const Lobes& lobes = vertex.bsdf.lobes();
    if (walk.at_first) {
        walk.first_is_diffuse = !lobes.diffuse_reflectance.is_black();
        walk.first_reflectance = lobes.diffuse_reflectance;
    }
    if (!lobes.diffuse_reflectance.is_black() || !lobes.diffuse_transmittance.is_black() || lobes.glossy)
        gather_at(walk, vertex, random);
    return scatter(walk, vertex, random);
}

void PathTracer::run(Walk& walk, PathRandom& random) const
{
    while (meet_surface(walk, random)) {
    }
}

PathSample PathTracer::sample(const Ray& ray, PathRandom& random) const
{
    Walk walk;
    walk.ray = ray;
    run(walk, random);
    PathSample result;
    result.radiance = walk.radiance;
    result.irradiance = walk.irradiance;
    result.indirect_irradiance = walk.irradiance - walk.direct_irradiance;
    result.diffuse_reflectance = walk.first_reflectance;
    result.closeness_per_m = walk.closeness_per_m;
    if (!walk.first)
        return result;
    const Hit& first = *walk.first;
    result.met_surface = true;
    result.distance_m = length(first.position - ray.origin);
    result.normal = dot(first.normal, ray.direction) <= 0 ? first.normal : -first.normal;
    // A surface without a diffuse lobe tells nothing about what falls on it: ask with a white sensor there.
    if (!walk.first_is_diffuse)
        result.irradiance = irradiance(first, result.normal, random);
    return result;
}

Spectrum PathTracer::irradiance(Hit here, const Direction& normal, PathRandom& random) const
{
    here.normal = here.shading_normal = normal;
    const Vertex vertex(here, -normal, white_);
    Walk walk;
    walk.ray.direction = -normal;
    gather_at(walk, vertex, random);
    if (scatter(walk, vertex, random))
        run(walk, random);
    return walk.irradiance;
}

} // namespace lightwell
