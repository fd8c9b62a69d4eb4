#include "engine/ambient/site_tree.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

/// A leaf with no more sites is not split, nor one whose children would hold this many times as many in all.
constexpr std::size_t few_sites = 6;
constexpr double most_repetition = 4;
constexpr int deepest = 24;
/// Nor one of less than this share of the size of all that reach into it: sites that lie on one another have a common
/// outline, which no splitting resolves.
constexpr double smallest_node = 0.2;

/// Half the size of the box that holds a site's ellipse, and places a little off its plane.
Vec3 half_extent(const AmbientSite& site)
{
    constexpr double slack = 0.15; // of the reach
    const double reach = std::max(site.reach_m[0], site.reach_m[1]);
    const auto extent = [&](double c) { return reach * (std::sqrt(std::fmax(0, 1 - c * c)) + slack); };
    return {extent(site.normal.x), extent(site.normal.y), extent(site.normal.z)};
}

} // namespace

void SiteTree::build(const std::vector<AmbientSite>& sites)
{
    nodes_.assign(1, {});
    entries_.clear();
    if (sites.empty())
        return;
    Vec3 low = sites[0].position, high = low;
    for (const AmbientSite& site : sites) {
        const Vec3 half = half_extent(site);
        low = min(low, site.position - half);
        high = max(high, site.position + half);
    }
    centre_ = low + (high - low) * 0.5;
    half_m_ = 0.5 * max_abs(high - low) * (1 + 1e-9);
    std::vector<Reaching> all;
    for (std::uint32_t i = 0; i < sites.size(); ++i) {
        const Vec3 half = half_extent(sites[i]), offset = sites[i].position - centre_;
        all.push_back({i, offset - half, offset + half});
    }
    split(0, {0, 0, 0}, half_m_, all, 0);
}

void SiteTree::split(std::uint32_t node, const Vec3& middle, double half, const std::vector<Reaching>& reaching,
                     int depth)
{
    std::vector<Reaching> parts[8];
    std::size_t total = 0;
    double smallest = infinity;
    for (const Reaching& r : reaching)
        smallest = std::min(smallest, max_abs(r.high - r.low));
    const bool may_split = reaching.size() > few_sites && depth < deepest && 2 * half > smallest_node * smallest;
    for (std::uint32_t k = 0; may_split && k < 8; ++k) {
        const Vec3 low{k & 1 ? middle.x : middle.x - half, k & 2 ? middle.y : middle.y - half,
                       k & 4 ? middle.z : middle.z - half};
        for (const Reaching& r : reaching)
            if (r.low.x <= low.x + half && r.high.x >= low.x && r.low.y <= low.y + half && r.high.y >= low.y &&
                r.low.z <= low.z + half && r.high.z >= low.z)
                parts[k].push_back(r);
        total += parts[k].size();
    }
    if (!may_split || static_cast<double>(total) > most_repetition * static_cast<double>(reaching.size())) {
        nodes_[node].first = static_cast<std::uint32_t>(entries_.size());
        nodes_[node].count = static_cast<std::uint32_t>(reaching.size());
        for (const Reaching& r : reaching)
            entries_.push_back(r.site);
        return;
    }
    const auto child = static_cast<std::uint32_t>(nodes_.size());
    nodes_[node].child = child;
    nodes_.resize(nodes_.size() + 8);
    const double quarter = 0.5 * half;
    for (std::uint32_t k = 0; k < 8; ++k)
        split(child + k,
              middle + Vec3{k & 1 ? quarter : -quarter, k & 2 ? quarter : -quarter, k & 4 ? quarter : -quarter},
              quarter, parts[k], depth + 1);
}

} // namespace lightwell
