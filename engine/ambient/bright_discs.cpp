#include "engine/ambient/bright_discs.h"

#include "engine/base/frame.h"

#include <algorithm>

namespace lightwell {
namespace {

/// The brightest pieces that give this share of the reflected light are worth aiming at when rays that follow the
/// cosine meet them no more often than that.
constexpr double share_of_light = 0.8, most_of_visits = 0.1;
/// A disc seen edge-on or from behind by a little may still show a part: no smaller cosine in a potential.
constexpr double least_cosine = 0.05;

double area_m2(const BrightDiscs::Lit& piece)
{
    return pi * piece.radius_m * piece.radius_m;
}

/// Each piece takes in those of its plane within so many of its radii that are not brighter: where light is very
/// uneven, pieces are small and many. @param pieces  brightest first
std::vector<BrightDiscs::Lit> merged(const std::vector<BrightDiscs::Lit>& pieces, double radii)
{
    constexpr double same_plane = 0.94; // cosine
    std::vector<BrightDiscs::Lit> discs;
    std::vector<double> reach_m, light_W;
    for (const BrightDiscs::Lit& piece : pieces) {
        std::size_t i = 0;
        for (; i < discs.size(); ++i) {
            const Vec3 way = piece.centre - discs[i].centre;
            if (dot(way, way) < reach_m[i] * reach_m[i] && dot(piece.normal, discs[i].normal) > same_plane)
                break;
        }
        const double found_W = piece.irradiance * area_m2(piece);
        if (i == discs.size()) {
            discs.push_back(piece);
            reach_m.push_back(radii * piece.radius_m);
            light_W.push_back(found_W);
            continue;
        }
        discs[i].radius_m = std::max(discs[i].radius_m, length(piece.centre - discs[i].centre) + piece.radius_m);
        light_W[i] += found_W;
        discs[i].visits += piece.visits;
    }
    for (std::size_t i = 0; i < discs.size(); ++i)
        discs[i].irradiance = light_W[i] / area_m2(discs[i]);
    return discs;
}

} // namespace

BrightDiscs::BrightDiscs(std::vector<Lit> pieces)
{
    const auto brighter = [](const Lit& a, const Lit& b) { return a.irradiance > b.irradiance; };
    std::sort(pieces.begin(), pieces.end(), brighter);
    double light = 0, visits = 0;
    for (const Lit& piece : pieces) {
        light += piece.irradiance * piece.visits;
        visits += piece.visits;
    }
    constexpr double first_radii = 2, most_radii = 32; // wider discs would aim at what is dark
    bool too_many = keep_brightest(pieces, light, visits);
    for (double radii = first_radii; too_many && radii <= most_radii; radii *= 2) {
        std::vector<Lit> discs = merged(pieces, radii);
        std::sort(discs.begin(), discs.end(), brighter);
        too_many = keep_brightest(discs, light, visits);
    }
}

bool BrightDiscs::keep_brightest(const std::vector<Lit>& pieces, double light, double visits)
{
    discs_.clear();
    double kept_light = 0, kept_visits = 0;
    for (const Lit& piece : pieces) {
        if (kept_light >= share_of_light * light || discs_.size() == most_discs)
            break;
        kept_light += piece.irradiance * piece.visits;
        kept_visits += piece.visits;
        discs_.push_back(piece);
    }
    constexpr double least_of_light = 0.5; // when the number of discs ends the list
    const bool too_many = light > 0 && kept_light < least_of_light * light;
    if (too_many || !(light > 0) || kept_visits > most_of_visits * visits)
        discs_.clear();
    return too_many;
}

BrightDiscs::Shares BrightDiscs::shares(const Point& from, const Direction& normal) const noexcept
{
    Shares shares;
    shares.from = from;
    for (std::size_t i = 0; i < discs_.size(); ++i) {
        const Lit& disc = discs_[i];
        const Vec3 way = disc.centre - from;
        const double squared = dot(way, way), distance = std::sqrt(squared), radius = disc.radius_m;
        const double above = dot(normal, way), before = -dot(disc.normal, way);
        double potential = 0;
        if (above + radius > 0 && before > 0) {
            const double reached = std::max(distance, radius);
            const double leaving = std::max(least_cosine, before / reached);
            const double arriving = std::max(least_cosine, std::min(1.0, (above + 0.5 * radius) / reached));
            potential = disc.irradiance * std::min(1.0, area_m2(disc) * leaving / squared) * arriving;
        }
        shares.total += potential;
        shares.summed[i] = shares.total;
    }
    return shares;
}

SampledDirection BrightDiscs::sample(const Shares& shares, UnitSquare u) const noexcept
{
    if (!(shares.total > 0))
        return {};
    const double wanted = u.u * shares.total;
    const auto end = shares.summed.begin() + static_cast<std::ptrdiff_t>(discs_.size());
    const auto found = std::upper_bound(shares.summed.begin(), end - 1, wanted);
    const auto at = static_cast<std::size_t>(found - shares.summed.begin());
    const double before = at == 0 ? 0 : shares.summed[at - 1], part = shares.summed[at] - before;
    if (!(part > 0))
        return {};
    const double left = std::clamp((wanted - before) / part, 0.0, 0x1.fffffffffffffp-1);
    const Lit& disc = discs_[at];
    const DiscPoint point = uniform_disc({left, u.v});
    const Frame frame = frame_about(disc.normal);
    const Vec3 way = disc.centre + (frame.x * point.x + frame.y * point.y) * disc.radius_m - shares.from;
    const Direction direction = normalized(way);
    return {direction, density_per_sr(shares, direction)};
}

double BrightDiscs::density_per_sr(const Shares& shares, const Direction& direction) const noexcept
{
    if (!(shares.total > 0))
        return 0;
    double density = 0;
    for (std::size_t i = 0; i < discs_.size(); ++i) {
        const double share = shares.summed[i] - (i == 0 ? 0 : shares.summed[i - 1]);
        const Lit& disc = discs_[i];
        const double cosine = -dot(disc.normal, direction);
        if (!(share > 0 && cosine > 0))
            continue;
        const Vec3 to_centre = disc.centre - shares.from;
        const double distance = -dot(disc.normal, to_centre) / cosine;
        const Vec3 off = direction * distance - to_centre;
        if (dot(off, off) <= disc.radius_m * disc.radius_m)
            density += share * distance * distance / (area_m2(disc) * cosine);
    }
    return density / shares.total;
}

} // namespace lightwell
