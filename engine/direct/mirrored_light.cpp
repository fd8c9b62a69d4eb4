#include "engine/direct/mirrored_light.h"

#include "materials/emission.h"

namespace lightwell {
namespace {

/// A shadow ray stops this share of its length before the lamp, beyond the rounding of the lamp's own position.
constexpr double before_lamp = 1 - 1e-9;
/// Up to this many candidates are tested one and all even where a single ray is wanted: the choice among so few would
/// cost more in noise than the rays that it saves.
constexpr int few_candidates = 2;

/// A direction before the real source, as the receiver sees it in the mirrors.
Direction folded(const MirrorRoute& route, const Direction& direction)
{
    return {dot(route.unfold.x, direction), dot(route.unfold.y, direction), dot(route.unfold.z, direction)};
}

} // namespace

/// Gathering at one vertex.
struct MirroredLight::Task {
    const Vertex& vertex;
    const GatherWish& wish;
    Gathered& sum;
};

/// Where the source is seen from the mirrored receiver; the direction is that before the source.
SourceSample MirroredLight::aim(const Task& task, const VirtualSource& image, UnitSquare u) const noexcept
{
    if (image.is_sun)
        return real_.suns()[image.source].sample(u);
    const Point unfolded = sources_.routes()[image.route].unfold.point(task.vertex.hit.position);
    return real_.lamps()[image.source].sample(unfolded, u);
}

/// What mirrors and everything between let through on the way to a sampled place of the source.
Spectrum MirroredLight::seen(const Vertex& vertex, const MirrorRoute& route, const SourceSample& sample,
                             bool* illum_front) const noexcept
{
    std::array<Ray, Reflections::most + 1> legs;
    Direction direction = folded(route, sample.to_light);
    Point at = vertex.hit.position, start = vertex.hit.leave(direction);
    double left_m = sample.distance_m;
    for (int i = 0; i < route.reflections.count; ++i) {
        const auto index = static_cast<std::size_t>(route.reflections.mirrors[static_cast<std::size_t>(i)]);
        const PlanarMirror& mirror = sources_.mirrors().mirrors()[index];
        const double slope = dot(mirror.frame.z, direction), away_m = -mirror.height_m(at) / slope;
        if (!(away_m > 0 && away_m < left_m))
            return {};
        Point met = at + direction * away_m;
        met = met - mirror.frame.z * mirror.height_m(met);
        if (!sources_.mirrors().holds(index, met))
            return {};
        // The leg ends, and the next begins, just before the mirror.
        const Point before = met - mirror.frame.z * std::copysign(mirror.error_m + vertex.hit.error_m, slope);
        legs[static_cast<std::size_t>(i)] = {start, before - start, 1, vertex.hit.in};
        direction = mirror.reflect_vector(direction);
        at = met;
        start = before;
        left_m -= away_m;
    }
    Ray& last = legs[static_cast<std::size_t>(route.reflections.count)];
    last = std::isinf(left_m) ? Ray{start, direction, infinity, vertex.hit.in}
                              : Ray{start, at + direction * left_m - start, before_lamp, vertex.hit.in};
    Spectrum left = route.reflectance;
    for (int i = route.reflections.count; i >= 0 && !left.is_black(); --i)
        left *= rays_.transmittance(legs[static_cast<std::size_t>(i)], illum_front);
    return left;
}

void MirroredLight::test(const Task& task, const VirtualSource& image, double rays, UnitSquare u) const
{
    const SourceSample sample = aim(task, image, u);
    if (!(sample.density_per_sr > 0) || sample.radiance.is_black())
        return;
    const Vertex& vertex = task.vertex;
    const MirrorRoute& route = sources_.routes()[image.route];
    const Direction to_image = folded(route, sample.to_light), local = vertex.frame.to_local(to_image);
    if (!vertex.same_side(to_image, local))
        return;
    const Spectrum value = vertex.bsdf.value_per_sr(vertex.to_viewer, local);
    if (local.z <= 0 && value.is_black())
        return;
    const Material* lamp = image.is_sun ? nullptr : &real_.lamps()[image.source].material();
    bool illum_front = false; // which scattered rays do not pass
    const Spectrum arriving =
        seen(vertex, route, sample, lamp == nullptr || passes_illum_fronts(*lamp) ? &illum_front : nullptr);
    if (arriving.is_black())
        return;
    // Scattered rays leave the light of an Illum to shadow rays, and do not see mirrors that show something else.
    const bool found_by_scattering =
        !illum_front && !task.wish.alone &&
        !sources_.mirrors().hidden(route.reflections.mirrors.data(), route.reflections.count) &&
        (lamp == nullptr || !std::holds_alternative<Illum>(*lamp));
    add_light(task.sum, vertex, {local, value, sample.radiance * arriving, sample.density_per_sr * rays},
              {task.wish.scattered, found_by_scattering});
}

Gathered MirroredLight::gather(const Vertex& vertex, const GatherWish& wish, PathRandom& random,
                               MirrorShares& shares) const
{
    Gathered sum;
    shares = {{vertex.hit.position, vertex.side, vertex.transmits()}, 0, std::max(wish.rays, few_candidates), false};
    if (sources_.empty())
        return sum;
    thread_local std::vector<VirtualSources::Candidate> found;
    sources_.candidates(shares.receiver, wish.kinds.lamps, wish.kinds.suns, found);
    const int count = static_cast<int>(found.size()), most_rays = shares.rays;
    // As many numbers for every path, whatever it finds, so that the samples of a set stay well spread.
    const double offset = random.one();
    for (const VirtualSources::Candidate& candidate : found)
        shares.total += candidate.potential;
    shares.each = count <= most_rays;
    if (shares.each && count > 0)
        shares.rays = most_rays / count;
    const Task task{vertex, wish, sum};
    double summed = 0;
    std::size_t at = 0;
    for (int k = 0; k < most_rays; ++k) {
        const UnitSquare u = random.pair();
        if (count == 0)
            continue;
        if (shares.each) {
            if (k < shares.rays * count)
                test(task, sources_.images()[found[static_cast<std::size_t>(k % count)].image], shares.rays, u);
            continue;
        }
        // One random number places all rays evenly along the summed potentials.
        const double wanted = shares.total * (k + offset) / shares.rays;
        while (at + 1 < found.size() && summed + found[at].potential <= wanted)
            summed += found[at++].potential;
        test(task, sources_.images()[found[at].image], shares.rays * found[at].potential / shares.total, u);
    }
    return sum;
}

/// Mean number of shadow rays that gather() aims at a source by way of a chain.
double MirroredLight::rays_of(const MirrorShares& shares, const MirrorChain& chain, bool is_sun,
                              int source) const noexcept
{
    if (!chain.mirrored() || !(shares.total > 0))
        return 0;
    const int image = sources_.image_of(chain.reflections(), is_sun, source);
    if (image < 0)
        return 0;
    const double potential = sources_.potential(sources_.images()[static_cast<std::size_t>(image)], shares.receiver);
    if (!(potential > 0))
        return 0;
    return shares.each ? shares.rays : shares.rays * potential / shares.total;
}

bool MirroredLight::answered(const MirrorChain& chain, bool is_sun, int source) const noexcept
{
    return chain.mirrored() && sources_.image_of(chain.reflections(), is_sun, source) >= 0;
}

double MirroredLight::lamp_density(const MirrorShares& shares, const MirrorChain& chain, int lamp,
                                   const Direction& direction, const Hit& hit) const noexcept
{
    const double rays = rays_of(shares, chain, false, lamp);
    if (!(rays > 0))
        return 0;
    const int image = sources_.image_of(chain.reflections(), false, lamp);
    const MirrorRoute& route = sources_.routes()[sources_.images()[static_cast<std::size_t>(image)].route];
    const Point unfolded = route.unfold.point(shares.receiver.at);
    return rays * real_.lamps()[static_cast<std::size_t>(lamp)].density_per_sr(unfolded, direction, hit);
}

double MirroredLight::sun_density(const MirrorShares& shares, const MirrorChain& chain, int sun,
                                  const Direction& direction) const noexcept
{
    return rays_of(shares, chain, true, sun) * real_.suns()[static_cast<std::size_t>(sun)].density_per_sr(direction);
}

} // namespace lightwell
