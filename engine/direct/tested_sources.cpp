#include "engine/direct/tested_sources.h"

#include "engine/sources/weighted_choice.h"
#include "materials/emission.h"

#include <algorithm>
#include <bit>

namespace lightwell {
namespace {

/// The first shadow rays to a source, to its rim, where every straight shadow begins; more of them for a source that
/// would get many rays. They only decide how many follow: were they part of the sum, their agreement would bias it.
constexpr int few_probes = 4, most_probes = 8, many_rays = 32;
/// A source that all probes see gets so many times fewer rays. Where they see none it gets no fewer: what a dark place
/// misses is all the light it has.
constexpr int visible_divisor = 8;
/// Most shadow rays to one source, of one kind.
constexpr int most_rays_at_all = 256;
/// Most pieces of a source without a closed form: finer ones would say no more about its irradiance.
constexpr int most_pieces = 64;
/// Weight of irradiance beside radiance in a potential: black surfaces still want to know what falls on them.
constexpr double irradiance_part = 0.05 / pi;
/// A potential by the middle of a source may miss what its edge gives: not below this share of a safe estimate.
constexpr double least_potential = 0.1;
/// A lamp seen smaller than this (size over distance) is ordered by its middle alone, right to half a percent; its
/// exact irradiance is worked out when it is tested.
constexpr double rough_size = 0.12;
/// In choosing one of the untested sources, each has at least this share of its potential.
constexpr double least_expectation = 0.05;

bool same(const Spectrum& a, const Spectrum& b)
{
    const Spectrum difference = a - b;
    return std::fabs(difference.r) + std::fabs(difference.g) + std::fabs(difference.b) <= 1e-12 * (a.max() + b.max());
}

int power_of_two(double wanted, int most)
{
    const double clamped = std::clamp(wanted, 1.0, static_cast<double>(std::min(most, most_rays_at_all)));
    return static_cast<int>(std::bit_floor(static_cast<unsigned>(clamped)));
}

/// A point near the boundary of the unit square, which all shapes map to their rim or their edges.
/// @param turn  [0, 1)
UnitSquare on_rim(double turn)
{
    constexpr double inset = 0.01;
    const double along = inset + (1 - 2 * inset) * (4 * turn - std::floor(4 * turn));
    switch (static_cast<int>(4 * turn)) {
    case 0:
        return {along, inset};
    case 1:
        return {1 - inset, along};
    case 2:
        return {1 - along, 1 - inset};
    default:
        return {inset, 1 - along};
    }
}

/// One for each thread, so that gathering takes no memory.
template <class T>
std::vector<T>& reused()
{
    thread_local std::vector<T> items;
    items.clear();
    return items;
}

} // namespace

double nominal_rays(std::size_t lamps, const DirectSettings& settings) noexcept
{
    return settings.tree && lamps > settings.most_lamps
               ? static_cast<double>(settings.lamp_groups) / static_cast<double>(lamps)
               : 1;
}

TestedSources::TestedSources(const Context& context, const Vertex& vertex, const SourceShares& shares,
                             PathRandom& random)
    : context_(context), vertex_(vertex), shares_(shares), random_(random), lamps_(context.sources.lamps().size()),
      candidates_(reused<Candidate>())
{
    const Spectrum upright = diffuse_value({0, 0, 1}), upright_below = diffuse_value({0, 0, -1});
    constexpr double grazing = 0.05; // cosine at which a lobe with Fresnel's losses would show them
    const Direction slanted{std::sqrt(1 - grazing * grazing), 0, grazing};
    const Direction slanted_below{slanted.x, 0, -grazing};
    even_value_[near_side] = upright;
    even_value_[far_side] = upright_below;
    even_ = same(upright, diffuse_value(slanted)) && same(upright_below, diffuse_value(slanted_below));
}

Spectrum TestedSources::diffuse_value(const Direction& local) const noexcept
{
    if (even_)
        return even_value_[local.z > 0 ? near_side : far_side];
    return vertex_.bsdf.value_per_sr(vertex_.to_viewer, local, LobeSet::diffuse);
}

/// What the highlight could give where the source comes nearest to its peak.
double TestedSources::highlight_potential(const Candidate& c, const Direction& to_middle, Side side) const noexcept
{
    const Direction& v = vertex_.to_viewer;
    const Direction peak = side == near_side ? Direction{-v.x, -v.y, v.z} : -v;
    const double between = std::atan2(length(cross(to_middle, peak)), dot(to_middle, peak));
    const double radius = std::atan(0.5 * c.size);
    const Direction nearest =
        between <= radius ? peak : normalized(to_middle * std::sin(between - radius) + peak * std::sin(radius));
    if ((nearest.z > 0) != (side == near_side))
        return 0;
    const double solid_angle_sr = c.projected_sr[side] / std::fmax(std::fabs(nearest.z), 0.5 * c.size);
    const double weight =
        std::isinf(c.mis)
            ? 1
            : shadow_ray_weight(c.mis, solid_angle_sr * vertex_.bsdf.density_per_sr(v, nearest, LobeSet::specular));
    return weight * c.projected_sr[side] * photopic(vertex_.bsdf.value_per_sr(v, nearest, LobeSet::specular));
}

void TestedSources::finish(Candidate& c, const Direction& to_middle, Spectrum source_radiance)
{
    Direction local = vertex_.frame.to_local(to_middle);
    double highlight = 0;
    for (const Side side : {near_side, far_side}) {
        if (!(c.projected_sr[side] > 0))
            continue;
        // A source that reaches over the horizon counts on both sides, whichever its middle is on.
        local.z = side == near_side ? std::fabs(local.z) : -std::fabs(local.z);
        const Spectrum arriving = source_radiance * (c.projected_sr[side] * c.weight);
        c.radiance += arriving * diffuse_value(local);
        if (side == near_side)
            c.irradiance += arriving;
        if (!vertex_.bsdf.lobes().glossy)
            continue;
        const double density = std::fabs(local.z) / c.projected_sr[side]; // of a sample of the source, about
        c.radiance += arriving * vertex_.bsdf.value_per_sr(vertex_.to_viewer, local, LobeSet::specular) *
                      mis_weight(c, density, local);
        highlight += photopic(source_radiance) * c.weight * std::fmax(0, highlight_potential(c, local, side));
    }
    c.potential = photopic(c.radiance) + highlight + irradiance_part * photopic(c.irradiance);
    if (!(c.potential > 0))
        return;
    expected_ += c.potential;
    candidates_.push_back(c);
}

void TestedSources::add_lamp(std::size_t lamp, double weight)
{
    const LocalSource& source = context_.sources.lamps()[lamp];
    const double safe = source.potential(shares_.from, shares_.normal, shares_.transmits);
    const Spectrum radiance = source.typical_radiance(shares_.from);
    const double photopic_radiance = photopic(radiance);
    if (!(safe > 0) || !(photopic_radiance > 0))
        return;
    Candidate c{lamp, weight};
    c.passes_fronts = passes_illum_fronts(source.material());
    c.size = source.seen_size(shares_.from);
    c.mis = std::holds_alternative<Illum>(source.material()) ? infinity : nominal_rays(lamps_, context_.settings);
    const Vec3 to_middle = normalized(source.centre() - shares_.from);
    c.rough = c.size < rough_size && dot(vertex_.frame.z, to_middle) > c.size && !shares_.transmits;
    if (c.rough)
        c.projected_sr[near_side] = source.middle_solid_angle_sr(shares_.from, vertex_.frame.z);
    else
        find_projected(c);
    if (!c.closed_form)
        c.projected_sr[near_side] = std::fmax(c.projected_sr[near_side], least_potential * safe / photopic_radiance);
    finish(c, to_middle, radiance);
}

/// The projected solid angles, from a closed form where one is known.
void TestedSources::find_projected(Candidate& c) const noexcept
{
    const LocalSource& source = context_.sources.lamps()[c.source];
    c.rough = false;
    c.closed_form = context_.settings.analytic;
    for (const Side side : {near_side, far_side}) {
        if (side == far_side && !shares_.transmits)
            continue;
        const Direction normal = side == near_side ? vertex_.frame.z : -vertex_.frame.z;
        const std::optional<double> exact = source.projected_solid_angle_sr(shares_.from, normal);
        c.closed_form = c.closed_form && exact;
        c.projected_sr[side] = exact ? *exact : source.middle_solid_angle_sr(shares_.from, normal);
    }
    // Few samples of a source that the horizon cuts may all lie below it: scaling the others to the whole loses light.
    c.closed_form = c.closed_form && !source.crosses_horizon(shares_.from, vertex_.frame.z);
}

void TestedSources::add_sun(std::size_t sun)
{
    const SunSource& source = context_.sources.suns()[sun];
    const Direction& to_sun = source.disc.to_source;
    const double half = 0.5 * source.disc.full_angle_deg * radians_per_degree;
    const double cosine = dot(vertex_.frame.z, to_sun), sine = std::sin(half);
    Candidate c{lamps_ + sun, 1};
    // Below the horizon by less than its half-angle, the sun still gives some light.
    const double edge = least_potential * sine;
    c.projected_sr[near_side] = pi * sine * sine * (cosine > -sine ? std::fmax(cosine, edge) : 0);
    if (shares_.transmits)
        c.projected_sr[far_side] = pi * sine * sine * (cosine < sine ? std::fmax(-cosine, edge) : 0);
    c.closed_form = context_.settings.analytic && std::fabs(cosine) > sine;
    c.size = 2 * sine;
    finish(c, to_sun, source.radiance);
}

void TestedSources::find_candidates()
{
    const DirectSettings& settings = context_.settings;
    const bool lamps = context_.kinds.lamps;
    if (lamps && settings.tree && lamps_ > settings.most_lamps) {
        auto& found = reused<LampTree::Representative>();
        context_.sources.lamp_tree().cut({shares_.from, shares_.normal, shares_.transmits}, settings.lamp_groups,
                                         random_.one(), found);
        // Of very many lamps, the chosen ones lie far apart in memory: asked for together, they arrive together.
        for (const LampTree::Representative& r : found)
            context_.sources.lamps()[static_cast<std::size_t>(r.lamp)].prefetch();
        for (const LampTree::Representative& r : found)
            add_lamp(static_cast<std::size_t>(r.lamp), 1 / r.probability);
    } else {
        for (std::size_t i = 0; lamps && i < lamps_; ++i)
            add_lamp(i, 1);
    }
    for (std::size_t i = 0; context_.kinds.suns && i < context_.sources.suns().size(); ++i)
        add_sun(i);
    std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
        return a.potential > b.potential || (a.potential == b.potential && a.source < b.source);
    });
}

/// What the irradiance of a source without a closed form takes, however visible it is.
int TestedSources::pieces(const Candidate& c) const noexcept
{
    const double along = c.size / context_.settings.subdivision;
    return c.closed_form ? 1 : power_of_two(along * along, most_pieces);
}

int TestedSources::rays_for(const Candidate& c) const noexcept
{
    if (!context_.settings.subdivide)
        return 1;
    // n rays to a source half hidden err by its potential / (2 sqrt(n)); sources share the noise by their potentials.
    const double noise = context_.settings.penumbra_noise;
    return std::max(power_of_two(c.potential / (4 * noise * noise * expected_), context_.settings.most_rays),
                    pieces(c));
}

double TestedSources::mis_weight(const Candidate& c, double density_per_sr, const Direction& local) const noexcept
{
    if (std::isinf(c.mis))
        return 1;
    return shadow_ray_weight(c.mis * density_per_sr,
                             vertex_.bsdf.density_per_sr(vertex_.to_viewer, local, LobeSet::specular));
}

void TestedSources::test_sample(const Candidate& c, const SourceSample& sample, Tested& tested)
{
    ++tested.samples;
    if (!(sample.density_per_sr > 0))
        return;
    const Direction local = vertex_.frame.to_local(sample.to_light);
    const Side side = local.z > 0 ? near_side : far_side;
    if (side == far_side && !shares_.transmits)
        return;
    const double cosine = std::fabs(local.z) / sample.density_per_sr;
    tested.cosines[side] += cosine;
    tested.all += cosine;
    ++tested.rays;
    Spectrum seen;
    bool illum_front = false; // which scattered rays do not pass
    if (!sample.radiance.is_black() && vertex_.same_side(sample.to_light, local)) {
        ++sum_.shadow_rays;
        seen = context_.rays.transmittance(shadow_ray(vertex_.hit, sample), c.passes_fronts ? &illum_front : nullptr);
    }
    if (seen.is_black()) {
        ++tested.blocked;
        return;
    }
    tested.visible += photopic(seen) * cosine;
    tested.clear += seen == Spectrum::grey(1) ? cosine : 0;
    const Spectrum light = sample.radiance * seen * cosine;
    tested.reflected[side] += light * diffuse_value(local);
    if (side == near_side)
        tested.arriving += light;
    if (vertex_.bsdf.lobes().glossy)
        tested.highlight += light * vertex_.bsdf.value_per_sr(vertex_.to_viewer, local, LobeSet::specular) *
                            (illum_front ? 1 : mis_weight(c, sample.density_per_sr, local));
}

TestedSources::Tested TestedSources::probe(const Candidate& c, int probes)
{
    UnitSquare points[most_probes];
    const double offset = random_.one();
    for (int i = 0; i < probes; ++i)
        points[i] = on_rim((i + offset) / probes);
    return trace(c, points, probes);
}

TestedSources::Tested TestedSources::trace(const Candidate& c, int count)
{
    auto& points = reused<UnitSquare>();
    points.resize(static_cast<std::size_t>(count));
    random_.pairs(count, points.data());
    return trace(c, points.data(), count);
}

TestedSources::Tested TestedSources::trace(const Candidate& c, const UnitSquare* points, int count)
{
    auto& samples = reused<SourceSample>();
    samples.resize(static_cast<std::size_t>(count));
    if (is_lamp(c)) {
        context_.sources.lamps()[c.source].sample(shares_.from, points, count, samples.data());
    } else {
        const SunSource& sun = context_.sources.suns()[c.source - lamps_];
        for (int i = 0; i < count; ++i)
            samples[static_cast<std::size_t>(i)] = sun.sample(points[i]);
    }
    Tested tested;
    for (const SourceSample& sample : samples)
        test_sample(c, sample, tested);
    return tested;
}

TestedSources::Light TestedSources::test(Candidate& c)
{
    if (c.rough)
        find_projected(c);
    int count = rays_for(c);
    if (count > few_probes && probe(c, count < many_rays ? few_probes : most_probes).blocked == 0)
        count = std::max(count / visible_divisor, pieces(c));
    const Tested tested = trace(c, count);
    // A mean over the samples; where the whole is known, the visible share of it.
    const auto scale = [&](Side side) {
        return c.closed_form && tested.cosines[side] > 0 ? c.projected_sr[side] / tested.cosines[side]
                                                         : 1.0 / tested.samples;
    };
    Light light;
    light.irradiance = tested.arriving * (scale(near_side) * c.weight);
    light.radiance = (tested.reflected[near_side] * scale(near_side) + tested.reflected[far_side] * scale(far_side) +
                      tested.highlight / tested.samples) *
                     c.weight;
    light.visible_share = tested.all > 0 ? std::min(1.0, tested.visible / tested.all) : 0;
    light.hemisphere_share = tested.all > 0 ? hemisphere_share(c) * std::min(1.0, tested.clear / tested.all) : 0;
    if (context_.generation.counts != nullptr)
        context_.generation.counts->record(c.source, light.visible_share);
    return light;
}

double TestedSources::hemisphere_share(const Candidate& c) const noexcept
{
    return is_lamp(c) ? c.projected_sr[near_side] * c.weight / pi : 0;
}

double TestedSources::history(std::size_t i) const noexcept
{
    return context_.generation.history != nullptr ? context_.generation.history->rate(candidates_[i].source) : 1;
}

void TestedSources::add(const Light& light, double share)
{
    sum_.radiance += light.radiance * share;
    sum_.irradiance += light.irradiance * share;
    sum_.lamp_share += light.hemisphere_share * share;
}

void TestedSources::add_untested(const AdaptiveOutcome& outcome)
{
    if (!context_.settings.sampled_remainder) {
        for (std::size_t i = outcome.tested; i < candidates_.size(); ++i) {
            const Candidate& c = candidates_[i];
            add({c.radiance, c.irradiance, 1, hemisphere_share(c)},
                expected_visibility(outcome.success_ratio, history(i)));
        }
        sum_.doubt = outcome.doubt();
        return;
    }
    auto& summed = reused<double>();
    double total = 0;
    for (std::size_t i = outcome.tested; i < candidates_.size(); ++i) {
        const double expected = std::fmax(expected_visibility(outcome.success_ratio, history(i)), least_expectation);
        summed.push_back(total += expected * candidates_[i].potential);
    }
    if (!(total > 0))
        return;
    const WeightedChoice chosen = choose(summed.data(), summed.size(), random_.one());
    if (chosen.share > 0)
        add(test(candidates_[outcome.tested + chosen.index]), 1 / chosen.share);
}

Gathered TestedSources::gather()
{
    find_candidates();
    const DirectSettings& settings = context_.settings;
    const AdaptiveOutcome outcome = test_adaptively(
        candidates_.size(), [&](std::size_t i) { return candidates_[i].potential; },
        [&](std::size_t i) { return history(i); },
        [&](std::size_t i) {
            const Light light = test(candidates_[i]);
            add(light, 1);
            expected_ -= (1 - light.visible_share) * candidates_[i].potential;
            return light.visible_share;
        },
        settings.adaptive ? settings.threshold : 0, settings.certainty);
    sum_.tested = static_cast<int>(outcome.tested);
    sum_.untested = static_cast<int>(candidates_.size() - outcome.tested);
    if (sum_.untested > 0)
        add_untested(outcome);
    return sum_;
}

} // namespace lightwell
