#pragma once

#include "engine/ambient/site.h"

#include <cstdint>
#include <vector>

namespace lightwell {

/// Finds the sites near a place: cells of a lattice for each power of two of reach.
/// Sites are visited in the order of their indices within each size, whatever thread asks.
class SiteGrid {
public:
    /// @param centre  near the sites, so that cells far from the origin keep their digits
    explicit SiteGrid(const Point& centre = {}) : centre_(centre) {}

    /// Adds sites[first..]; earlier ones stay.
    void add(const std::vector<AmbientSite>& sites, std::size_t first);

    /// Calls visit(index) for every site whose reach may cover the place, and more.
    template <class Visit>
    void near(const Point& at, const Visit& visit) const
    {
        const Vec3 offset = at - centre_;
        for (const CellSize& size : sizes_) {
            if (const Slot* slot = find(key_of(offset, size)))
                for (std::uint32_t i = slot->first; i != slot->last; ++i)
                    visit(entries_[i].site);
        }
    }

private:
    struct CellSize {
        int exponent; ///< 2^exponent m
        double cells_per_m;
    };
    struct Entry {
        std::uint64_t key;
        std::uint32_t site;
    };
    struct Slot {
        std::uint64_t key = 0;
        std::uint32_t first = 0, last = 0; ///< equal: empty
    };
    static std::uint64_t key_of(const Vec3& offset, const CellSize& size) noexcept;
    const Slot* find(std::uint64_t key) const noexcept;
    void add_one(const AmbientSite& site, std::uint32_t index);
    void index_entries();

    Point centre_;
    std::vector<CellSize> sizes_; ///< in use, smallest first
    std::vector<Entry> entries_;  ///< sorted by key, then site
    std::vector<Slot> slots_;     ///< open addressing, a power of two
};

} // namespace lightwell
