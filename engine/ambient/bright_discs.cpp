#include "engine/ambient/bright_discs.h"

#include "engine/base/frame.h"

#include <algorithm>

namespace lightwell {
namespace {

/// The brightest pieces that give this share of the reflected light are worth aiming at when they are no more than that
/// share of the area.
constexpr double share_of_light = 0.8, most_of_area = 0.2;
/// Pieces that are joined are covered by discs that reach beyond them: so much they may cover together.
constexpr double most_of_area_joined = 2 * most_of_area;
/// Pieces of one disc face the same way, about.
constexpr double same_facing = 0.9;
/// A disc seen edge-on or from behind by a little may still show a part: no smaller cosine in a potential.
constexpr double least_cosine = 0.05;

double area_m2(const BrightDiscs::Lit& piece)
{
    return pi * piece.radius_m * piece.radius_m;
}

double area_of(const std::vector<BrightDiscs::Lit>& pieces)
{
    double area = 0;
    for (const BrightDiscs::Lit& piece : pieces)
        area += area_m2(piece);
    return area;
}

double light_of(const std::vector<BrightDiscs::Lit>& pieces)
{
    double light = 0;
    for (const BrightDiscs::Lit& piece : pieces)
        light += piece.irradiance * area_m2(piece);
    return light;
}

/// One disc with the light of all pieces, that covers them.
/// @param pieces  the first is the brightest
BrightDiscs::Lit covering(const std::vector<BrightDiscs::Lit>& pieces)
{
    const double light = light_of(pieces);
    BrightDiscs::Lit disc{{}, pieces[0].normal, 0, 0};
    for (const BrightDiscs::Lit& piece : pieces)
        disc.centre += piece.centre * (piece.irradiance * area_m2(piece) / light);
    for (const BrightDiscs::Lit& piece : pieces)
        disc.radius_m = std::max(disc.radius_m, length(piece.centre - disc.centre) + piece.radius_m);
    disc.irradiance = light / area_m2(disc);
    return disc;
}

/// The brightest piece takes in those within reach that face as it does, then the brightest of the others, and so on.
std::vector<BrightDiscs::Lit> joined(std::vector<BrightDiscs::Lit> left, double reach_m)
{
    std::vector<BrightDiscs::Lit> discs;
    while (!left.empty()) {
        const BrightDiscs::Lit middle = left[0];
        const auto others = std::stable_partition(left.begin(), left.end(), [&](const BrightDiscs::Lit& piece) {
            return length(piece.centre - middle.centre) <= reach_m && dot(piece.normal, middle.normal) > same_facing;
        });
        discs.push_back(covering({left.begin(), others}));
        left.erase(left.begin(), others);
    }
    return discs;
}

/// The finer the sites, the more pieces a bright patch falls into: joined until they are few.
/// @param pieces  the brightest first
std::vector<BrightDiscs::Lit> few(const std::vector<BrightDiscs::Lit>& pieces)
{
    constexpr double further = 1.4;
    constexpr int most_steps = 40; // to a millionfold reach
    std::vector<BrightDiscs::Lit> discs = pieces;
    double reach_m = pieces.empty() ? 0 : 2 * pieces[0].radius_m;
    for (int step = 0; step < most_steps && discs.size() > BrightDiscs::most_discs; ++step, reach_m *= further)
        discs = joined(pieces, reach_m);
    if (discs.size() > BrightDiscs::most_discs)
        discs.clear();
    return discs;
}

} // namespace

BrightDiscs::BrightDiscs(std::vector<Lit> pieces)
{
    std::sort(pieces.begin(), pieces.end(), [](const Lit& a, const Lit& b) { return a.irradiance > b.irradiance; });
    const double light = light_of(pieces), area = area_of(pieces);
    double kept_light = 0;
    std::size_t kept = 0;
    while (kept < pieces.size() && kept_light < share_of_light * light) {
        kept_light += pieces[kept].irradiance * area_m2(pieces[kept]);
        ++kept;
    }
    pieces.resize(kept);
    if (!(light > 0) || area_of(pieces) > most_of_area * area)
        return;
    discs_ = few(pieces);
    if (area_of(discs_) > most_of_area_joined * area)
        discs_.clear();
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
