#include "engine/ambient/site_grid.h"

#include "engine/base/random.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

std::uint64_t cell_key(std::int64_t x, std::int64_t y, std::int64_t z, int exponent) noexcept
{
    const auto bits = [](std::int64_t v) { return static_cast<std::uint64_t>(v); };
    // One multiplication a coordinate: lookups happen at every scattered ray.
    std::uint64_t h = bits(x) * 0x9e3779b97f4a7c15u;
    h = (h ^ (h >> 32) ^ bits(y)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 32) ^ bits(z)) * 0x94d049bb133111ebu;
    h = (h ^ (h >> 32) ^ bits(exponent)) * 0x9e3779b97f4a7c15u;
    return h ^ (h >> 32);
}

std::int64_t cell(double offset, double cells_per_m) noexcept
{
    // Far outside, all places share the last cell: they are too far from any site to matter.
    return static_cast<std::int64_t>(std::floor(std::fmin(std::fmax(offset * cells_per_m, -4e18), 4e18)));
}

} // namespace

std::uint64_t SiteGrid::key_of(const Vec3& offset, const CellSize& size) noexcept
{
    return cell_key(cell(offset.x, size.cells_per_m), cell(offset.y, size.cells_per_m),
                    cell(offset.z, size.cells_per_m), size.exponent);
}

const SiteGrid::Slot* SiteGrid::find(std::uint64_t key) const noexcept
{
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t i = key & mask;; i = (i + 1) & mask) {
        const Slot& slot = slots_[i];
        if (slot.first == slot.last)
            return nullptr;
        if (slot.key == key)
            return &slot;
    }
}

void SiteGrid::add_one(const AmbientSite& site, std::uint32_t index)
{
    const double reach = std::max(site.reach_m[0], site.reach_m[1]);
    const int exponent = std::ilogb(reach) + 1; // a cell is at least as wide as the reach
    const CellSize size{exponent, std::ldexp(1.0, -exponent)};
    if (std::none_of(sizes_.begin(), sizes_.end(), [&](const CellSize& s) { return s.exponent == exponent; }))
        sizes_.push_back(size);
    // The ellipse lies in the plane across the normal, so it reaches less far along the normal's axes.
    const Vec3 n = site.normal;
    constexpr double slack = 0.15; // of the reach, for places a little off the plane
    const auto extent = [&](double c) { return reach * (std::sqrt(std::fmax(0, 1 - c * c)) + slack); };
    const Vec3 half{extent(n.x), extent(n.y), extent(n.z)};
    const Vec3 low = site.position - centre_ - half, high = site.position - centre_ + half;
    for (std::int64_t x = cell(low.x, size.cells_per_m); x <= cell(high.x, size.cells_per_m); ++x)
        for (std::int64_t y = cell(low.y, size.cells_per_m); y <= cell(high.y, size.cells_per_m); ++y)
            for (std::int64_t z = cell(low.z, size.cells_per_m); z <= cell(high.z, size.cells_per_m); ++z)
                entries_.push_back({cell_key(x, y, z, exponent), index});
}

void SiteGrid::index_entries()
{
    std::sort(entries_.begin(), entries_.end(),
              [](const Entry& a, const Entry& b) { return a.key != b.key ? a.key < b.key : a.site < b.site; });
    std::size_t size = 16;
    while (size < 2 * entries_.size())
        size *= 2;
    slots_.assign(size, {});
    for (std::size_t i = 0; i < entries_.size();) {
        std::size_t end = i;
        while (end < entries_.size() && entries_[end].key == entries_[i].key)
            ++end;
        std::size_t slot = entries_[i].key & (size - 1);
        while (slots_[slot].first != slots_[slot].last)
            slot = (slot + 1) & (size - 1);
        slots_[slot] = {entries_[i].key, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(end)};
        i = end;
    }
}

void SiteGrid::add(const std::vector<AmbientSite>& sites, std::size_t first)
{
    for (std::size_t i = first; i < sites.size(); ++i)
        add_one(sites[i], static_cast<std::uint32_t>(i));
    std::sort(sizes_.begin(), sizes_.end(),
              [](const CellSize& a, const CellSize& b) { return a.exponent < b.exponent; });
    index_entries();
}

} // namespace lightwell
