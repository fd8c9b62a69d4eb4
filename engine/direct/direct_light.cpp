#include "engine/direct/direct_light.h"

#include "engine/direct/tested_sources.h"
#include "engine/sources/weighted_choice.h"
#include "materials/emission.h"

namespace lightwell {
namespace {

/// A shadow ray stops this share of its length before the lamp, beyond the rounding of the lamp's own position.
constexpr double before_lamp = 1 - 1e-9;
/// A way of finding a source that is this much less likely than the other adds only noise.
constexpr double hopeless = 1e-3;

/// Up to so many lamps the potentials of all are summed: they say more than the bounds of a tree, and cost less than a
/// shadow ray.
constexpr std::size_t most_summed_lamps = 128;

} // namespace

Ray shadow_ray(const Hit& from, const SourceSample& sample) noexcept
{
    const Point start = from.leave(sample.to_light);
    if (std::isinf(sample.distance_m))
        return {start, sample.to_light, infinity, from.in};
    return {start, from.position + sample.to_light * sample.distance_m - start, before_lamp, from.in};
}

double shadow_ray_weight(double shadow_density, double scattered_density) noexcept
{
    if (scattered_density < hopeless * shadow_density)
        return 1;
    if (shadow_density < hopeless * scattered_density)
        return 0;
    return shadow_density / (shadow_density + scattered_density);
}

void add_light(Gathered& sum, const Vertex& vertex, const Brought& brought, const FoundToo& too) noexcept
{
    const double scattered =
        too.by_scattering ? vertex.bsdf.density_per_sr(vertex.to_viewer, brought.local, too.lobes) : 0;
    const double weight = shadow_ray_weight(brought.density_per_sr, scattered);
    const Spectrum light = brought.radiance * (std::fabs(brought.local.z) / brought.density_per_sr);
    if (too.lobes == LobeSet::all) {
        sum.radiance += light * brought.value_per_sr * weight;
        if (brought.local.z > 0)
            sum.irradiance += light * weight;
        return;
    }
    const Spectrum found_too = vertex.bsdf.value_per_sr(vertex.to_viewer, brought.local, too.lobes);
    sum.radiance += light * (brought.value_per_sr - found_too * (1 - weight));
    if (brought.local.z > 0)
        sum.irradiance += light;
}

/// Gathering at one vertex.
struct DirectLight::Task {
    const Vertex& vertex;
    const GatherWish& wish;
    Gathered& sum;
};

void DirectLight::add(const Task& task, const SourceSample& sample, double density_per_sr, const Finding& by) const
{
    if (!(density_per_sr > 0) || sample.radiance.is_black())
        return;
    const Vertex& vertex = task.vertex;
    const Direction local = vertex.frame.to_local(sample.to_light);
    if (!vertex.same_side(sample.to_light, local))
        return;
    const Spectrum value = vertex.bsdf.value_per_sr(vertex.to_viewer, local);
    if (local.z <= 0 && value.is_black())
        return;
    ++task.sum.shadow_rays;
    bool illum_front = false; // which scattered rays do not pass
    const Spectrum seen =
        rays_.transmittance(shadow_ray(vertex.hit, sample), by.passes_illum_fronts ? &illum_front : nullptr);
    if (seen.is_black())
        return;
    add_light(task.sum, vertex, {local, value, sample.radiance * seen, density_per_sr},
              {task.wish.scattered, by.scattering && !illum_front && !task.wish.alone});
}

bool DirectLight::few_lamps() const noexcept
{
    return !settings_.tree || sources_.lamps().size() <= most_summed_lamps;
}

void DirectLight::lamp(const Task& task, std::size_t at, double probability, UnitSquare u,
                       const SourceShares& shares) const
{
    const LocalSource& lamp = sources_.lamps()[at];
    const auto* glow = settings_.glow_radii ? std::get_if<Glow>(&lamp.material()) : nullptr;
    if (glow != nullptr && !(length(lamp.centre() - shares.from) <= glow->max_radius_m))
        return;
    const SourceSample sample = lamp.sample(shares.from, u);
    add(task, sample, sample.density_per_sr * shares.lamp_rays * probability,
        {glow == nullptr && !std::holds_alternative<Illum>(lamp.material()), passes_illum_fronts(lamp.material())});
}

void DirectLight::lamps(const Task& task, PathRandom& random, SourceShares& shares) const
{
    thread_local std::vector<double> summed;
    const std::vector<LocalSource>& all = sources_.lamps();
    const Receiver receiver{shares.from, shares.normal, shares.transmits};
    double total = 0;
    if (few_lamps()) {
        summed.resize(all.size());
        for (std::size_t i = 0; i < all.size(); ++i)
            summed[i] = total += all[i].potential(shares.from, shares.normal, shares.transmits);
        shares.lamp_total = total;
    }
    const double offset = random.one();
    for (int k = 0; k < shares.lamp_rays; ++k) {
        const UnitSquare u = random.pair();
        // One random number places all rays evenly along the summed potentials, or the leaves of the tree.
        const double wanted = (k + offset) / shares.lamp_rays;
        if (!few_lamps()) {
            const LampTree::Chosen chosen = sources_.lamp_tree().choose(receiver, wanted);
            if (chosen.lamp >= 0)
                lamp(task, static_cast<std::size_t>(chosen.lamp), chosen.probability, u, shares);
        } else if (total > 0) {
            const WeightedChoice chosen = choose(summed.data(), summed.size(), wanted);
            if (chosen.share > 0)
                lamp(task, chosen.index, chosen.share, u, shares);
        }
    }
}

SourceSample DirectLight::sky_sample(const SourceShares& shares, double choice, UnitSquare u) const
{
    SourceSample sample;
    if (choice < shares.portal_share) {
        const SampledDirection d = sources_.guide().sample(shares.portals, shares.from, u);
        if (d.density_per_sr > 0)
            sample = {d.direction, infinity, 1, sources_.sky().radiance(d.direction)};
    } else {
        sample = sources_.sky().sample(u);
    }
    if (sample.density_per_sr > 0)
        sample.density_per_sr = sky_density(shares, sample.to_light);
    return sample;
}

void DirectLight::sky(const Task& task, PathRandom& random, SourceShares& shares) const
{
    shares.portals = sources_.guide().shares(shares.from, shares.normal, shares.transmits);
    shares.portal_share = shares.portals.portal_share;
    const double offset = random.one();
    for (int k = 0; k < shares.sky_rays; ++k) {
        const SourceSample sample = sky_sample(shares, (k + offset) / shares.sky_rays, random.pair());
        add(task, sample, sample.density_per_sr, {true, false});
    }
}

Gathered DirectLight::gather(const Vertex& vertex, const GatherWish& wish, PathRandom& random,
                             SourceShares& shares) const
{
    Gathered sum;
    const Task task{vertex, wish, sum};
    shares.from = vertex.hit.position;
    shares.normal = vertex.side;
    shares.transmits = vertex.transmits();
    shares.lamp_rays = wish.kinds.lamps ? wish.rays : 0;
    shares.sky_rays = wish.kinds.sky ? wish.rays : 0;
    shares.portal_share = 0;
    shares.lamp_total = 0;
    shares.tested = false;
    if (wish.kinds.lamps && !sources_.lamps().empty())
        lamps(task, random, shares);
    if (wish.kinds.suns)
        for (const SunSource& sun : sources_.suns()) {
            const SourceSample sample = sun.sample(random.pair());
            add(task, sample, sample.density_per_sr, {true, true});
        }
    if (wish.kinds.sky && !sources_.sky().empty())
        sky(task, random, shares);
    return sum;
}

Gathered DirectLight::gather_tested(const Vertex& vertex, const SourceKinds& kinds, const TestedGeneration& generation,
                                    PathRandom& random, SourceShares& shares) const
{
    shares.from = vertex.hit.position;
    shares.normal = vertex.side;
    shares.transmits = vertex.transmits();
    shares.tested = true;
    shares.lamp_rays = shares.sky_rays = 0;
    shares.portal_share = 0;
    return TestedSources({sources_, rays_, settings_, generation, kinds}, vertex, shares, random).gather();
}

double DirectLight::lamp_density(const SourceShares& shares, int lamp, const Direction& direction,
                                 const Hit& hit) const noexcept
{
    const LocalSource& source = sources_.lamps()[static_cast<std::size_t>(lamp)];
    if (shares.tested)
        return source.density_per_sr(shares.from, direction, hit) * nominal_rays(sources_.lamps().size(), settings_);
    double probability = 0;
    if (!few_lamps())
        probability = sources_.lamp_tree().probability(lamp, {shares.from, shares.normal, shares.transmits});
    else if (shares.lamp_total > 0)
        probability = source.potential(shares.from, shares.normal, shares.transmits) / shares.lamp_total;
    return source.density_per_sr(shares.from, direction, hit) * shares.lamp_rays * probability;
}

double DirectLight::sky_density(const SourceShares& shares, const Direction& direction) const noexcept
{
    double density = (1 - shares.portal_share) * sources_.sky().density_per_sr(direction);
    if (shares.portal_share > 0)
        density += shares.portal_share * sources_.guide().density_per_sr(shares.portals, shares.from, direction);
    return density * shares.sky_rays;
}

} // namespace lightwell
