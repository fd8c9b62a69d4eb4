#pragma once

#include "engine/sources/portals.h"
#include "engine/sources/sky_source.h"

#include <memory>
#include <vector>

namespace lightwell {

/// Which panes show the sky, place by place. Learned by a few rays from within each cell of a lattice when it is first
/// asked for. It only says where shadow rays to the sky should go: whatever it misses is found by the other techniques,
/// at more noise.
/// Error: none (tests/analytic compares results with closed forms that do not know of it)
class Guide {
public:
    Guide(const Scene& scene, const RayQueries& rays, const SkySource& sky);
    ~Guide();

    static constexpr std::size_t most_entries = 32;
    struct Entry {
        std::uint32_t index; ///< of the portal
        float share;         ///< of the sky's light that comes this way, before the receiver's cosine
    };
    struct Cell {
        Entry portals[most_entries];
        std::size_t portal_count = 0;
        double portal_share = 0; ///< of the sky's rays
    };
    /// Panes that are known; 0: rays to the sky are not aimed at any.
    std::size_t openings() const noexcept { return portals_.size(); }
    /// Thread-safe; the same cell for the same place, whoever asks first.
    const Cell& cell(const Point& at) const;

    /// A choice among a cell's portals for one receiver.
    struct Shares {
        const Entry* entries = nullptr;
        double portal_share = 0; ///< of the sky's rays
        double summed[most_entries];
        std::size_t count = 0;
        double total() const noexcept { return count == 0 ? 0 : summed[count - 1]; }
        double share(std::size_t i) const noexcept { return summed[i] - (i == 0 ? 0 : summed[i - 1]); }
    };
    Shares shares(const Point& at, const Direction& normal, bool transmits) const;
    SampledDirection sample(const Shares& shares, const Point& from, UnitSquare u) const noexcept;
    double density_per_sr(const Shares& shares, const Point& from, const Direction& direction) const noexcept;

private:
    struct Lattice;
    void learn(const Point& low, double size_m, std::uint64_t key, Cell& cell) const;

    const RayQueries& rays_;
    const SkySource& sky_;
    std::vector<Portal> portals_;
    std::unique_ptr<Lattice> lattice_;
};

} // namespace lightwell
