#include "engine/direct/direct_light.h"

#include <algorithm>

namespace lightwell {
namespace {

/// A shadow ray stops this share of its length before the lamp, beyond the rounding of the lamp's own position.
constexpr double before_lamp = 1 - 1e-9;
/// Half of the sky's rays aim at windows where there are windows: indoors that is where the sky is, outdoors the
/// other half finds it.
constexpr double share_of_portals = 0.5;
/// A way of finding a source that is this much less likely than the other adds only noise.
constexpr double hopeless = 1e-3;

Ray shadow_ray(const Hit& from, const SourceSample& sample)
{
    const Point start = from.leave(sample.to_light);
    if (std::isinf(sample.distance_m))
        return {start, sample.to_light, infinity};
    return {start, from.position + sample.to_light * sample.distance_m - start, before_lamp};
}

} // namespace

double shadow_ray_weight(double shadow_density, double scattered_density) noexcept
{
    if (scattered_density < hopeless * shadow_density)
        return 1;
    if (shadow_density < hopeless * scattered_density)
        return 0;
    return shadow_density / (shadow_density + scattered_density);
}

void DirectLight::add(const Vertex& vertex, const SourceSample& sample, double density_per_sr, bool found_by_scattering,
                      Gathered& sum) const
{
    if (!(density_per_sr > 0) || sample.radiance.is_black())
        return;
    const Direction local = vertex.frame.to_local(sample.to_light);
    if (!vertex.same_side(sample.to_light, local))
        return;
    const Spectrum value = vertex.bsdf.value_per_sr(vertex.to_viewer, local);
    if (local.z <= 0 && value.is_black())
        return;
    const Spectrum seen = rays_.transmittance(shadow_ray(vertex.hit, sample));
    if (seen.is_black())
        return;
    const double scattered = found_by_scattering ? vertex.bsdf.density_per_sr(vertex.to_viewer, local) : 0;
    const double weight = shadow_ray_weight(density_per_sr, scattered);
    const Spectrum light = sample.radiance * seen * (weight * std::fabs(local.z) / density_per_sr);
    sum.radiance += light * value;
    if (local.z > 0)
        sum.irradiance += light;
}

void DirectLight::lamps(const Vertex& vertex, PathRandom& random, SourceShares& shares, Gathered& sum) const
{
    thread_local std::vector<double> summed;
    const std::vector<LocalSource>& all = sources_.lamps();
    summed.resize(all.size());
    double total = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
        summed[i] = total += all[i].potential(shares.from, shares.normal, shares.transmits);
    shares.lamp_total = total;
    const double offset = random.one();
    for (int k = 0; k < shares.lamp_rays; ++k) {
        const UnitSquare u = random.pair();
        if (!(total > 0))
            continue;
        // One random number places all rays evenly along the summed potentials.
        const double wanted = total * (k + offset) / shares.lamp_rays;
        const auto at =
            static_cast<std::size_t>(std::upper_bound(summed.begin(), summed.end() - 1, wanted) - summed.begin());
        const double part = summed[at] - (at == 0 ? 0 : summed[at - 1]);
        if (!(part > 0))
            continue;
        const SourceSample sample = all[at].sample(shares.from, u);
        add(vertex, sample, sample.density_per_sr * shares.lamp_rays * part / total,
            !std::holds_alternative<Illum>(all[at].material()), sum);
    }
}

void DirectLight::sky(const Vertex& vertex, PathRandom& random, SourceShares& shares, Gathered& sum) const
{
    const UnitSquare u = random.pair();
    const double choice = random.one();
    if (!sources_.portals().empty()) {
        shares.portals = sources_.portals().shares(shares.from, shares.normal, shares.transmits);
        shares.portal_share = shares.portals.total() > 0 ? share_of_portals : 0;
    }
    SourceSample sample;
    if (choice < shares.portal_share) {
        const SampledDirection d = sources_.portals().sample(shares.portals, shares.from, u);
        if (!(d.density_per_sr > 0))
            return;
        sample = {d.direction, infinity, 1, sources_.sky().radiance(d.direction)};
    } else {
        sample = sources_.sky().sample(u);
    }
    if (sample.density_per_sr > 0)
        add(vertex, sample, sky_density(shares, sample.to_light), true, sum);
}

Gathered DirectLight::gather(const Vertex& vertex, int lamp_rays, PathRandom& random, SourceShares& shares) const
{
    Gathered sum;
    shares.from = vertex.hit.position;
    shares.normal = vertex.side;
    shares.transmits = vertex.transmits();
    shares.lamp_rays = lamp_rays;
    shares.portal_share = 0;
    shares.lamp_total = 0;
    if (!sources_.lamps().empty())
        lamps(vertex, random, shares, sum);
    for (const SunSource& sun : sources_.suns()) {
        const SourceSample sample = sun.sample(random.pair());
        add(vertex, sample, sample.density_per_sr, true, sum);
    }
    if (!sources_.sky().empty())
        sky(vertex, random, shares, sum);
    return sum;
}

double DirectLight::lamp_density(const SourceShares& shares, int lamp, const Direction& direction,
                                 const Hit& hit) const noexcept
{
    const LocalSource& source = sources_.lamps()[static_cast<std::size_t>(lamp)];
    if (!(shares.lamp_total > 0))
        return 0;
    return source.density_per_sr(shares.from, direction, hit) * shares.lamp_rays *
           source.potential(shares.from, shares.normal, shares.transmits) / shares.lamp_total;
}

double DirectLight::sky_density(const SourceShares& shares, const Direction& direction) const noexcept
{
    double density = (1 - shares.portal_share) * sources_.sky().density_per_sr(direction);
    if (shares.portal_share > 0)
        density += shares.portal_share * sources_.portals().density_per_sr(shares.portals, shares.from, direction);
    return density;
}

} // namespace lightwell
