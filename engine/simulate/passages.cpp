#include "engine/simulate/walk.h"
#include "materials/haze.h"
#include "materials/patterns/place_program.h"

#include <algorithm>
#include <cmath>

/// \file What a path does other than meet a surface and leave it by a lobe: haze, volumes that erase surfaces, prisms,
/// light lost inside bodies, and a limit to diffuse interreflection.
namespace lightwell {
namespace {

/// Points of a way through haze at which sources are asked.
constexpr int haze_points = 2;

Spectrum power(const Spectrum& s, double exponent)
{
    return {std::pow(s.r, exponent), std::pow(s.g, exponent), std::pow(s.b, exponent)};
}

/// The diffuse material that stands for one with functions, or with a slight highlight, where other programs ask these
/// for the light of lamps and suns alone. Patterns are in the colours already.
std::optional<Material> stand_in(const Material& material, const AmbientLimit& limit)
{
    if (const auto* m = std::get_if<Functional>(&material); m != nullptr && m->kind != Functional::Kind::BRTDfunc)
        return Trans{m->colour, 0, 0, m->transmission * (1 - m->specularity), 0};
    const auto* m = std::get_if<Plastic>(&material);
    if (m != nullptr && m->roughness > 0 && m->specularity > 0 && m->specularity <= limit.unsampled_specularity)
        return Plastic{m->colour * (1 - m->specularity) + Spectrum::grey(m->specularity), 0, 0};
    return {};
}

} // namespace

/// A surface that bounds a volume, or that is erased by one, is passed.
/// @return false for surfaces that are there; that is also the cut through an erased body, which the hit then is
bool PathTracer::cross_volume(Walk& walk, Hit& hit) const
{
    const Volumes& volumes = rays_.volumes();
    const bool entering = dot(hit.normal, walk.ray.direction) < 0;
    const ModifierId cut = volumes.cut_face(walk.ray.in, hit.modifier, entering);
    if (cut != void_modifier) {
        hit.modifier = cut;
        hit.normal = -hit.normal;
        hit.shading_normal = -hit.shading_normal;
        return false;
    }
    const bool passed = volumes.bounds(hit.modifier) || volumes.erased(walk.ray.in, hit.modifier);
    walk.ray.in = volumes.behind(walk.ray.in, hit.modifier, entering);
    return passed;
}

/// Light that sources send to a point of haze, scattered along the walk.
void PathTracer::gather_in_haze(Walk& walk, const Spectrum& weight, double eccentricity, const Point& at,
                                PathRandom& random) const
{
    Hit point;
    point.position = at;
    point.normal = point.shading_normal = -walk.ray.direction;
    point.in = walk.ray.in;
    Mist mist;
    mist.eccentricity = eccentricity;
    const Material haze = mist;
    const Vertex vertex(point, walk.ray.direction, haze);
    // Of the sky, scattered rays bring the light.
    const GatherWish wish{1, {true, true, false}, LobeSet::all};
    const Spectrum found = direct_.gather(vertex, wish, random, walk.here).radiance +
                           mirrored_.gather(vertex, wish, random, walk.mirror_here).radiance;
    walk.radiance += walk.throughput * weight * found;
    if (walk.at_first)
        return;
    const Spectrum irradiance = walk.arriving_throughput * weight * found;
    walk.irradiance += irradiance;
    if (walk.listener != nullptr)
        walk.listener->added(irradiance, void_modifier);
}

/// Loses what haze takes from a way of this length, and adds what it scatters into it.
/// @return true when the walk goes on from within the haze, in another direction, or has lost all its light
/// Source  Chandrasekhar 1960, equation of transfer; distances by the mean extinction, colours by weights
bool PathTracer::scatter_in_haze(Walk& walk, double length_m, PathRandom& random) const
{
    const Volumes::Haze haze = rays_.volumes().haze(walk.ray.in);
    if (!haze.thick())
        return false;
    const double mean = photopic(haze.extinction_per_m);
    const double stopped = -std::expm1(-mean * length_m);
    const double offset = random.one();
    const auto distance_at = [&](double u) { return -std::log1p(-u * stopped) / mean; };
    /// Scattered at a distance, over the density with which that was drawn.
    const auto weight_at = [&](double distance) {
        return haze.scattering_per_m * left_by_haze(haze.extinction_per_m, distance) *
               (stopped / (mean * std::exp(-mean * distance)));
    };
    const bool scatters = mean > 0 && !haze.scattering_per_m.is_black();
    if (scatters && !walk.aimed)
        for (int k = 0; k < haze_points; ++k) {
            const double distance = distance_at((k + offset) / haze_points);
            gather_in_haze(walk, weight_at(distance) / haze_points, haze.eccentricity,
                           walk.ray.origin + walk.ray.direction * distance, random);
        }
    const Spectrum left = left_by_haze(haze.extinction_per_m, length_m);
    if (ambient_.limit) { // what is scattered again is taken to be the constant light
        const Spectrum taken = haze.scattering_per_m * (stopped / std::max(mean, 1e-300));
        walk.add(ambient_.limit->radiance * taken);
        walk.throughput *= left;
        walk.arriving_throughput *= left;
        return false;
    }
    const double again = scatters ? stopped * photopic(haze.scattering_per_m) / mean : 0;
    if (random.one() >= again) {
        walk.throughput *= left / (1 - again);
        walk.arriving_throughput *= left / (1 - again);
        return walk.throughput.is_black() && walk.arriving_throughput.is_black();
    }
    const double distance = distance_at(random.one());
    const Spectrum weight = weight_at(distance) / again;
    walk.throughput *= weight;
    walk.arriving_throughput *= weight;
    const UnitSquare u = random.pair();
    const double cosine = HazeScattering(haze.eccentricity).sample_cosine(u.u);
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine)), azimuth = 2 * pi * u.v;
    const Direction turned = normalized(
        frame_about(walk.ray.direction).to_world({sine * std::cos(azimuth), sine * std::sin(azimuth), cosine}));
    walk.ray = {walk.ray.origin + walk.ray.direction * distance, turned, infinity, walk.ray.in};
    walk.here = walk.shares = {};
    walk.mirror_here = walk.mirror_shares = {};
    walk.sources = Walk::Sources::answered;
    walk.chain.begin();
    walk.bent = true;
    walk.at_first = walk.straight_from_receiver = false;
    walk.way_m = 0;
    ++walk.scatterings;
    if (!survives(walk, random))
        walk.throughput = walk.arriving_throughput = {};
    return true;
}

/// What the body that the walk has come through has taken of its light.
void PathTracer::absorb_inside(Walk& walk, const Hit& hit, const Material& material) const
{
    const bool from_inside = dot(hit.normal, walk.ray.direction) > 0;
    Spectrum per_m = Spectrum::grey(1);
    if (const auto* body = std::get_if<Dielectric>(&material); body != nullptr && from_inside)
        per_m = body->transmission_per_m;
    else if (const auto* border = std::get_if<Interface>(&material))
        per_m = from_inside ? border->inner_transmission_per_m : border->outer_transmission_per_m;
    else
        return;
    const Spectrum kept = power(per_m, hit.t);
    walk.throughput *= kept;
    walk.arriving_throughput *= kept;
}

/// Goes on in one of the directions that a prism's functions give.
bool PathTracer::turn_in_prism(Walk& walk, const Hit& hit, const Prism& prism, PathRandom& random) const
{
    double values[8]{};
    prism.function->at(prism.place, values);
    const double first = std::clamp(values[0], 0.0, 1.0);
    const double second = prism.rays == 2 ? std::clamp(values[4], 0.0, 1 - first) : 0;
    const double share = first + second;
    if (!(share > 0))
        return false;
    const std::size_t at = random.one() * share < first ? 0 : 4;
    const Vec3 turned = prism.function->direction(prism.place, {values[at + 1], values[at + 2], values[at + 3]});
    if (!(length(turned) > 0))
        return false;
    if (walk.straight_from_receiver)
        walk.settle_aim();
    walk.straight_from_receiver = false;
    walk.throughput = walk.throughput * share;
    walk.arriving_throughput = walk.at_first ? Spectrum{} : walk.arriving_throughput * share;
    walk.ray = {hit.leave(turned), turned, infinity, hit.in};
    if (walk.listener != nullptr && !walk.at_first)
        walk.listener->bent(hit.modifier);
    walk.chain.end();
    walk.sources = Walk::Sources::in_full;
    walk.at_first = false;
    ++walk.scatterings;
    return survives(walk, random);
}

/// What stands in for all further diffuse interreflection.
/// @return false: the walk ends
bool PathTracer::add_constant(Walk& walk, const Lobes& lobes) const
{
    walk.add(ambient_.limit->radiance * (lobes.diffuse_reflectance + lobes.diffuse_transmittance));
    if (walk.at_first)
        walk.irradiance += ambient_.limit->radiance * pi;
    return false;
}

/// Light of lamps and suns by shadow rays as the vertex scatters it; all other light as a diffuse material does.
bool PathTracer::scatter_as(Walk& walk, const Vertex& vertex, const Material& diffuse, PathRandom& random) const
{
    const int rays = walk.at_first ? first_rays : later_rays;
    gather_plainly(walk, vertex, {rays, {true, true, false}, LobeSet::all, true}, random);
    const Vertex instead(vertex.hit, walk.ray.direction, diffuse);
    if (walk.diffuse_bounces >= ambient_.limit->bounces)
        return add_constant(walk, instead.bsdf.lobes());
    add_direct(walk, direct_.gather(instead, {rays, {false, false, true}}, random, walk.here), 1, vertex.hit.modifier);
    ++walk.diffuse_bounces;
    if (!scatter(walk, instead, LobeSet::all, random))
        return false;
    walk.sources = Walk::Sources::answered;
    return true;
}

/// Diffuse scattering up to a number of times, constant light instead beyond.
bool PathTracer::scatter_within_limit(Walk& walk, const Vertex& vertex, const Material& material,
                                      PathRandom& random) const
{
    if (const std::optional<Material> plain = stand_in(material, *ambient_.limit))
        return scatter_as(walk, vertex, *plain, random);
    const Lobes& lobes = vertex.bsdf.lobes();
    const bool sharp_too = lobes.glossy || lobes.delta;
    const int rays = walk.at_first ? first_rays : later_rays;
    if (walk.diffuse_bounces >= ambient_.limit->bounces) {
        gather_plainly(walk, vertex, {rays, {true, true, false}, LobeSet::specular}, random);
        add_constant(walk, lobes);
        return sharp_too && scatter(walk, vertex, LobeSet::specular, random);
    }
    gather_plainly(walk, vertex, {rays}, random);
    if (!sharp_too) {
        ++walk.diffuse_bounces;
        return scatter(walk, vertex, LobeSet::all, random);
    }
    const bool diffuse = random.one() < 0.5;
    walk.diffuse_bounces += diffuse ? 1 : 0;
    walk.throughput = walk.throughput * 2;
    walk.arriving_throughput = walk.arriving_throughput * 2;
    const double before = walk.scattered_density;
    if (!scatter(walk, vertex, diffuse ? LobeSet::diffuse : LobeSet::specular, random))
        return false;
    // Shadow rays have been weighed against all lobes together.
    if (walk.scattered_density != before)
        walk.scattered_density =
            vertex.bsdf.density_per_sr(vertex.to_viewer, vertex.frame.to_local(walk.ray.direction));
    return true;
}

} // namespace lightwell
