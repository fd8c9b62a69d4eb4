#include "engine/simulate/walk.h"

#include "materials/emission.h"

#include <algorithm>

namespace lightwell {
namespace {

/// Panes of glass on the way from the eye at which noise would be seen if one of the two ways were left to chance.
constexpr int eye_splits = 2;
/// Paths are never ended before this many scatterings.
constexpr int sure_scatterings = 3;
/// Even a path that loses nothing ends some day.
constexpr double most_survival = 0.9999;
/// At a site one shadow ray a lamp will do: a mean over several places is wanted.
DirectSettings at_sites(DirectSettings settings)
{
    settings.subdivide = false;
    return settings;
}

/// Numbers that someone reads: of the lamps below the threshold one is tested, since what all of them are taken to give
/// would agree with itself however wrong it is. Where interreflection is limited, as in Radiance, they follow its rule.
DirectSettings for_sensors(const DirectSettings& wanted, bool limited)
{
    DirectSettings settings = wanted;
    settings.sampled_remainder = settings.sampled_remainder || !limited;
    return settings;
}

/// Several paths share a pixel: each tests the lamps that give most, with one shadow ray, and one of the rest.
DirectSettings for_eyes(const DirectSettings& wanted)
{
    DirectSettings settings = at_sites(wanted);
    settings.threshold = 0.5;
    settings.sampled_remainder = true;
    return settings;
}

/// Behind a scattering one lamp is tested, chosen by what each would give here: where all are seen, that is exact.
DirectSettings behind_scattering(const DirectSettings& wanted)
{
    DirectSettings settings = at_sites(wanted);
    settings.threshold = infinity;
    settings.sampled_remainder = true;
    return settings;
}

/// What is seen in place of a surface; void: nothing.
ModifierId alternate_of(const Scene& scene, const Material& material)
{
    const auto* illum = std::get_if<Illum>(&material);
    const auto* mirror = std::get_if<Mirror>(&material);
    const std::string name = illum != nullptr ? illum->alternate : mirror != nullptr ? mirror->alternate : "";
    return name.empty() || name == "void" ? void_modifier : scene.find_modifier(name);
}

} // namespace

/// Ambient irradiance on both sides of a vertex: in numbers, or as shares of the deep field's sites.
struct PathTracer::AmbientHere {
    struct Side {
        Spectrum reflected; ///< of what falls on this side, the share that goes to the viewer
        CachedAmbient cached;
        DeepField::Weight weights[DeepField::most_weights];
        std::size_t count = 0; ///< of weights; 0: cached
    };
    Side sides[2]; ///< viewer's, other
};

PathTracer::PathTracer(const Scene& scene, const RayQueries& rays, const SourceList& sources,
                       const VirtualSources& virtual_sources, const AmbientLight& ambient,
                       const DirectSettings& settings)
    : scene_(scene), rays_(rays), sources_(sources), virtual_sources_(virtual_sources), ambient_(ambient),
      direct_(sources, rays, settings), mirrored_(virtual_sources, sources, rays),
      sensor_direct_(sources, rays, for_sensors(settings, ambient.limit.has_value())),
      eye_direct_(sources, rays, for_eyes(settings)), site_direct_(sources, rays, at_sites(settings)),
      quick_direct_(sources, rays, behind_scattering(settings)), varied_(scene),
      white_(Plastic{Spectrum::grey(1), 0, 0})
{
    for (std::size_t i = 0; i < scene.modifiers.size(); ++i) {
        const Material* material = resolve(scene, static_cast<ModifierId>(i)).material;
        materials_.push_back(material);
        alternates_.push_back(material != nullptr ? alternate_of(scene, *material) : void_modifier);
    }
}

void PathTracer::meet_distant(Walk& walk) const
{
    if (walk.aimed)
        return;
    const Direction direction = walk.ray.direction;
    if (!sources_.sky().empty()) {
        const Spectrum radiance = sources_.sky().radiance(direction);
        if (!radiance.is_black()) {
            const bool in_full = walk.sources == Walk::Sources::in_full || walk.chain.mirrored();
            const double weight = walk.weight(in_full ? 0 : direct_.sky_density(walk.shares, direction));
            if (walk.straight_from_receiver) // an arrival tells what its ray sees apart from what it counts for
                walk.add(radiance, weight);
            else
                walk.add(radiance * weight);
        }
    }
    for (std::size_t i = 0; i < sources_.suns().size(); ++i) {
        const SunSource& sun = sources_.suns()[i];
        const double density = sun.density_per_sr(direction);
        const int index = static_cast<int>(i);
        if (!(density > 0) || answered(walk, true, index))
            continue;
        if (walk.sources == Walk::Sources::in_full)
            walk.add(sun.radiance);
        else if (walk.chain.mirrored())
            walk.add(sun.radiance *
                     walk.weight(mirrored_.sun_density(walk.mirror_shares, walk.chain, index, direction)));
        else
            walk.add(sun.radiance * walk.weight(density));
    }
}

/// Whether the light of a lamp or a sun that a ray has met has come by shadow rays alone. In a mirror that is so for
/// those that have an image there; the others count in full, but not where interreflection is limited as in other
/// programs, which leave them out.
bool PathTracer::answered(const Walk& walk, bool is_sun, int source) const
{
    const bool in_full = walk.sources == Walk::Sources::in_full ||
                         (walk.chain.mirrored() && !mirrored_.answered(walk.chain, is_sun, source));
    if (in_full)
        return ambient_.limit && walk.bent;
    return walk.sources == Walk::Sources::answered;
}

void PathTracer::meet_emitter(Walk& walk, const Hit& hit, const Material& material) const
{
    const Direction direction = walk.ray.direction;
    const Spectrum radiance =
        emitted_towards(material, -dot(hit.normal, direction), -direction) * beam_share(material, walk.way_m);
    if (radiance.is_black() || walk.aimed || (walk.bent && is_only_seen(material)))
        return;
    if (const auto* glow = std::get_if<Glow>(&material); glow != nullptr && ambient_.limit && walk.bent) {
        if (hit.t > glow->max_radius_m) // nearer, shadow rays find it
            walk.add(radiance);
        return;
    }
    const int lamp = sources_.lamp_at(hit);
    double shadow_density = 0;
    if (lamp >= 0 && (walk.sources != Walk::Sources::in_full || (ambient_.limit && walk.bent))) {
        const bool has_image = walk.chain.mirrored() && mirrored_.answered(walk.chain, false, lamp);
        const bool by_shadow_rays_alone =
            std::holds_alternative<Illum>(material) && (has_image || !walk.chain.mirrored());
        if (answered(walk, false, lamp) || by_shadow_rays_alone) {
            walk.met_lamp = walk.straight_from_receiver && walk.scatterings == 1;
            return;
        }
        if (has_image)
            shadow_density = mirrored_.lamp_density(walk.mirror_shares, walk.chain, lamp, direction, hit);
        else if (!walk.chain.mirrored())
            shadow_density = direct_.lamp_density(walk.shares, lamp, direction, hit);
    }
    walk.add(radiance * walk.weight(shadow_density));
}

bool PathTracer::find_ambient(const Walk& walk, const Vertex& vertex, AmbientHere& here) const
{
    const bool deep = walk.bent;
    if (deep ? ambient_.deep == nullptr : ambient_.cache == nullptr)
        return false;
    const Lobes& lobes = vertex.bsdf.lobes();
    here.sides[0].reflected = lobes.diffuse_reflectance;
    here.sides[1].reflected = lobes.diffuse_transmittance;
    for (int i = 0; i < 2; ++i) {
        AmbientHere::Side& side = here.sides[i];
        if (side.reflected.is_black() && !(i == 0 && walk.at_first))
            continue;
        const Direction normal = i == 0 ? vertex.side : -vertex.side;
        if (!deep && ambient_.cache->irradiance(vertex.hit.position, normal, side.cached))
            continue;
        // In corners and on things thinner than a few pixels no record answers: the deep field stands in for them.
        const bool stands_in = !deep && !ambient_.cache->records().empty() && ambient_.deep != nullptr;
        if (deep || stands_in)
            side.count = ambient_.deep->weights(vertex.hit.position, normal, side.weights);
        if (side.count == 0)
            return false;
    }
    return true;
}

void PathTracer::add_ambient(Walk& walk, const AmbientHere& here) const
{
    for (const AmbientHere::Side& side : here.sides) {
        if (walk.bent && walk.dependences != nullptr) {
            for (std::size_t i = 0; i < side.count; ++i)
                walk.dependences->push_back(
                    {side.weights[i].site, walk.arriving_throughput * side.reflected * (side.weights[i].weight / pi)});
            continue;
        }
        Spectrum irradiance;
        if (side.count > 0) {
            for (std::size_t i = 0; i < side.count; ++i)
                irradiance += ambient_.deep->ambient(side.weights[i].site, walk.replicate) * side.weights[i].weight;
        } else if (const double level = photopic(side.cached.irradiance); level > 0) {
            const double off = side.cached.deviation[static_cast<std::size_t>(walk.replicate)];
            irradiance = side.cached.irradiance * std::fmax(0, 1 + off / level);
        }
        walk.add(irradiance * side.reflected / pi);
        if (walk.at_first && &side == here.sides)
            walk.irradiance = irradiance;
    }
}

void PathTracer::add_direct(Walk& walk, const Gathered& direct, double share, ModifierId at) const
{
    walk.radiance += walk.throughput * direct.radiance * share;
    const Spectrum irradiance =
        walk.at_first ? direct.irradiance * share : walk.arriving_throughput * direct.radiance * share;
    walk.irradiance += irradiance;
    if (walk.listener != nullptr)
        walk.listener->added(irradiance, walk.at_first ? void_modifier : at);
}

void PathTracer::gather_plainly(Walk& walk, const Vertex& vertex, const GatherWish& wish, PathRandom& random) const
{
    add_direct(walk, direct_.gather(vertex, wish, random, walk.here), 1, vertex.hit.modifier);
    add_direct(walk, mirrored_.gather(vertex, wish, random, walk.mirror_here), 1, vertex.hit.modifier);
}

void PathTracer::gather_beside_ambient(Walk& walk, const Vertex& vertex, const AmbientHere& here,
                                       PathRandom& random) const
{
    if (!walk.bent) {
        const GatherWish wish{first_rays, {true, true, false}, LobeSet::specular};
        add_direct(walk, eye_direct_.gather_tested(vertex, wish.kinds, {}, random, walk.here), 1, vertex.hit.modifier);
        add_direct(walk, mirrored_.gather(vertex, wish, random, walk.mirror_here), 1, vertex.hit.modifier);
        return;
    }
    const Lobes& lobes = vertex.bsdf.lobes();
    const bool field_stands_in = !lobes.glossy && lobes.diffuse_transmittance.is_black() && !sources_.lamps().empty();
    if (!field_stands_in || !sources_.suns().empty()) {
        gather_plainly(walk, vertex, {later_rays, {!field_stands_in, true, false}, LobeSet::specular}, random);
    }
    if (!field_stands_in)
        return;
    // The field's direct light stands in; now and then the difference to a test is added, which keeps the sum unbiased.
    Spectrum usual;
    double tested_share = 0;
    const AmbientHere::Side& side = here.sides[0];
    for (std::size_t i = 0; i < side.count; ++i) {
        usual += ambient_.deep->direct(side.weights[i].site) * side.weights[i].weight;
        tested_share = std::max(tested_share, ambient_.deep->tested_share(side.weights[i].site));
    }
    usual = usual * side.reflected / pi;
    walk.add(usual);
    if (random.one() < tested_share) {
        const Gathered tested = quick_direct_.gather_tested(vertex, {true, false, false}, {}, random, walk.here);
        add_direct(walk, tested, 1 / tested_share, vertex.hit.modifier);
        const GatherWish wish{later_rays, {true, false, false}, LobeSet::specular};
        add_direct(walk, mirrored_.gather(vertex, wish, random, walk.mirror_here), 1 / tested_share,
                   vertex.hit.modifier);
        walk.add(usual * (-1 / tested_share));
    }
}

bool PathTracer::survives(Walk& walk, PathRandom& random) const
{
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

/// @return false where the light ends
bool PathTracer::follow(Walk& walk, const Vertex& vertex, const BsdfSample& scattered, LobeSet set) const
{
    const Direction local = scattered.to_light;
    const Direction world = scattered.straight ? walk.ray.direction : vertex.frame.to_world(local);
    if (scattered.weight.is_black() || !vertex.same_side(world, local))
        return false;
    if (!walk.at_first)
        walk.arriving_throughput *= scattered.weight;
    else if (!scattered.delta && local.z > 0 && set == LobeSet::all)
        walk.arriving_throughput = Spectrum::grey(local.z / scattered.density_per_sr);
    else // its irradiance is known already, or cannot be told by this ray
        walk.arriving_throughput = {};
    walk.throughput *= scattered.weight;
    walk.ray = {vertex.hit.leave(world), normalized(world), infinity, vertex.hit.in};
    if (local.z < 0 && walk.jump_m > 0)
        walk.ray.origin = walk.ray.origin - vertex.side * walk.jump_m;
    if (!scattered.straight) { // a straight passage leaves the weights of the last scattering as they are
        if (walk.straight_from_receiver)
            walk.settle_aim();
        walk.straight_from_receiver = false;
        if (scattered.delta) {
            walk.chain.reflect(virtual_sources_.mirrors().mirror_at(vertex.hit));
            if (!walk.chain.mirrored())
                walk.sources = Walk::Sources::in_full;
        } else {
            walk.shares = walk.here;
            walk.mirror_shares = walk.mirror_here;
            walk.sources = Walk::Sources::weighted;
            walk.scattered_density = scattered.density_per_sr;
            walk.chain.begin();
            walk.way_m = 0;
            walk.bent = true;
        }
    }
    if (walk.listener != nullptr && !walk.at_first && !scattered.straight)
        walk.listener->bent(vertex.hit.modifier);
    ++walk.scatterings;
    walk.at_first = false;
    return true;
}

/// Follows the mirrored light to its end; the walk is left with what passes.
void PathTracer::split(Walk& walk, const Vertex& vertex, double mirrored_choice, PathRandom& random) const
{
    --walk.splits_left;
    Walk other = walk;
    other.radiance = other.irradiance = {};
    walk.throughput = walk.throughput * (1 - mirrored_choice);
    other.throughput = other.throughput * mirrored_choice;
    const std::optional<BsdfSample> sample = vertex.bsdf.sample(vertex.to_viewer, 0, {});
    if (sample && follow(other, vertex, *sample, LobeSet::all))
        run(other, random);
    walk.radiance += other.radiance;
    walk.irradiance += other.irradiance;
}

bool PathTracer::scatter(Walk& walk, const Vertex& vertex, LobeSet set, PathRandom& random) const
{
    double choice = random.one();
    if (walk.splits_left > 0 && !walk.bent) {
        const double mirrored_choice = vertex.bsdf.mirrored_choice(vertex.to_viewer);
        if (mirrored_choice > 0 && mirrored_choice < 1) {
            split(walk, vertex, mirrored_choice, random);
            choice = mirrored_choice; // passes
        }
    }
    const std::optional<BsdfSample> scattered = vertex.bsdf.sample(vertex.to_viewer, choice, random.pair(), set);
    return scattered && follow(walk, vertex, *scattered, set) && survives(walk, random);
}

/// What the walk's ray meets: the material with its patterns, or what eyes see in its place; null: nothing. Textures
/// bend the shading normal of the hit.
const Material* PathTracer::seen_material(const Walk& walk, Hit& hit, SeenMaterial& seen) const
{
    ModifierId modifier = hit.modifier;
    const Material& own = *materials_[static_cast<std::size_t>(modifier)];
    const bool from_behind = dot(hit.normal, walk.ray.direction) > 0;
    if ((std::holds_alternative<Illum>(own) && (!walk.bent || from_behind)) ||
        (std::holds_alternative<Mirror>(own) && !std::get<Mirror>(own).alternate.empty()))
        modifier = alternates_[static_cast<std::size_t>(modifier)];
    if (!varied_.varies(modifier))
        return modifier == void_modifier ? nullptr : materials_[static_cast<std::size_t>(modifier)];
    varied_.look(modifier, pattern_place(hit, walk.ray.direction, hit.t), seen);
    if (!(seen.bend == Vec3{}))
        hit.shading_normal = bent_normal(hit.shading_normal, seen.bend, walk.ray.direction);
    if (seen.material != nullptr && stands_for_geometry(*seen.material)) {
        const double thickness_m = std::get<Measured>(*seen.material).thickness_m;
        if (!walk.bent || (thickness_m > 0) == from_behind)
            return nullptr; // the geometry itself is seen
    }
    return seen.material;
}

bool PathTracer::meet_surface(Walk& walk, PathRandom& random) const
{
    Hit hit;
    const bool met = rays_.closest(walk.ray, hit);
    if (walk.ray.in.inside != 0 && scatter_in_haze(walk, met ? hit.t : infinity, random))
        return !walk.throughput.is_black() || !walk.arriving_throughput.is_black();
    if (!met) {
        meet_distant(walk);
        return false;
    }
    const bool passed = rays_.volumes().any() && cross_volume(walk, hit);
    if (!walk.first)
        walk.first = hit;
    walk.way_m += hit.t;
    SeenMaterial seen;
    const Material* material = passed ? nullptr : seen_material(walk, hit, seen);
    if (material == nullptr) { // invisible: the ray goes on as if it had met nothing
        walk.ray = {hit.leave(walk.ray.direction), walk.ray.direction, infinity, walk.ray.in};
        return true;
    }
    if (const auto* prism = std::get_if<Prism>(material))
        return turn_in_prism(walk, hit, *prism, random);
    if (is_emitter(*material)) {
        meet_emitter(walk, hit, *material);
        return false;
    }
    const Vertex vertex(hit, walk.ray.direction, *material);
    absorb_inside(walk, hit, *material);
    walk.jump_m = stands_for_geometry(*material) ? std::fabs(std::get<Measured>(*material).thickness_m) : 0;
    const Lobes& lobes = vertex.bsdf.lobes();
    walk.first_is_diffuse = walk.at_first ? !lobes.diffuse_reflectance.is_black() : walk.first_is_diffuse;
    if (walk.straight_from_receiver && (is_diffuse(lobes) || lobes.glossy))
        walk.settle_aim();
    if (ambient_.limit && is_diffuse(lobes))
        return scatter_within_limit(walk, vertex, *material, random);
    AmbientHere here;
    if (is_diffuse(lobes) && find_ambient(walk, vertex, here)) {
        add_ambient(walk, here);
        gather_beside_ambient(walk, vertex, here, random);
        return (lobes.glossy || lobes.delta) && scatter(walk, vertex, LobeSet::specular, random);
    }
    if (is_diffuse(lobes) || lobes.glossy)
        gather_plainly(walk, vertex, {walk.at_first ? first_rays : later_rays}, random);
    return scatter(walk, vertex, LobeSet::all, random);
}

void PathTracer::run(Walk& walk, PathRandom& random) const
{
    while (meet_surface(walk, random)) {
    }
}

PathSample PathTracer::sample(const Ray& ray, int replicate, PathRandom& random) const
{
    Walk walk;
    walk.ray = ray;
    walk.ray.in = rays_.volumes_at(ray.origin);
    walk.replicate = replicate;
    walk.splits_left = eye_splits;
    run(walk, random);
    PathSample result;
    result.radiance = walk.radiance;
    result.irradiance = walk.irradiance;
    if (!walk.first)
        return result;
    const Hit& first = *walk.first;
    result.met_surface = true;
    result.distance_m = length(first.position - ray.origin);
    result.normal = facing(first.normal, ray.direction);
    // A surface without a diffuse lobe tells nothing about what falls on it: ask with a white sensor there.
    if (!walk.first_is_diffuse)
        result.irradiance = irradiance({first.position, result.normal, first.error_m}, replicate, random);
    return result;
}

Spectrum PathTracer::irradiance(const SurfacePlace& receiver, int replicate, PathRandom& random,
                                PathListener* listener) const
{
    const Vertex vertex = white_vertex(receiver);
    Walk walk;
    walk.ray.direction = -receiver.normal;
    walk.replicate = replicate;
    walk.listener = listener;
    if (listener != nullptr)
        listener->begin();
    AmbientHere here;
    if (find_ambient(walk, vertex, here)) {
        add_ambient(walk, here);
        gather_beside_ambient(walk, vertex, here, random);
        return walk.irradiance;
    }
    if (ambient_.limit && ambient_.limit->bounces == 0) {
        gather_plainly(walk, vertex, {first_rays, {true, true, false}, LobeSet::specular}, random);
        return walk.irradiance + ambient_.limit->radiance * pi;
    }
    gather_plainly(walk, vertex, {first_rays}, random);
    walk.diffuse_bounces = 1;
    if (scatter(walk, vertex, LobeSet::all, random))
        run(walk, random);
    return walk.irradiance;
}

} // namespace lightwell
