#pragma once

#include "engine/sources/portals.h"
#include "engine/sources/sky_source.h"

#include <memory>
#include <vector>

namespace lightwell {

struct SunSource;

/// Where light comes from, place by place: which panes show the sky, which show anything bright outside (sunlit
/// ground), and where the sun falls on surfaces inside. Learned by
/// a few rays from within each cell of a lattice when it is first asked for. It only says where samples should go:
/// whatever it misses is found by the other techniques, at more noise.
/// Error: none (tests/analytic compares results with closed forms that do not know of it)
class Guide {
public:
    Guide(const Scene& scene, const RayQueries& rays, const SkySource& sky, const std::vector<SunSource>& suns);
    ~Guide();

    static constexpr std::size_t most_entries = 32;
    struct Entry {
        std::uint32_t index; ///< of the portal or the patch
        float share;         ///< of the cell's light that comes this way, before the receiver's cosine
    };
    struct Cell {
        Entry portals[most_entries];  ///< by the sky seen through them: for shadow rays
        Entry outlooks[most_entries]; ///< the same portals by all that is seen through them: for scattered rays
        Entry patches[most_entries];
        std::size_t portal_count = 0, outlook_count = 0, patch_count = 0;
        double portal_share = 0; ///< of the sky's rays
    };
    /// Thread-safe; the same cell for the same place, whoever asks first.
    const Cell& cell(const Point& at) const;

    /// A choice among a cell's entries for one receiver.
    struct Shares {
        const Entry* entries = nullptr;
        double portal_share = 0; ///< of the sky's rays
        double summed[most_entries];
        std::size_t count = 0;
        double total() const noexcept { return count == 0 ? 0 : summed[count - 1]; }
        double share(std::size_t i) const noexcept { return summed[i] - (i == 0 ? 0 : summed[i - 1]); }
    };
    Shares portal_shares(const Point& at, const Direction& normal, bool transmits) const;
    Shares outlook_shares(const Point& at, const Direction& normal) const;
    SampledDirection sample_portal(const Shares& shares, const Point& from, UnitSquare u) const noexcept;
    double portal_density_per_sr(const Shares& shares, const Point& from, const Direction& direction) const noexcept;

    Shares patch_shares(const Point& at, const Direction& normal) const;
    SampledDirection sample_patch(const Shares& shares, const Point& from, UnitSquare u) const noexcept;
    double patch_density_per_sr(const Shares& shares, const Point& from, const Direction& direction) const noexcept;

private:
    struct Lattice;
    /// A ball around sunlit points.
    struct Patch {
        Point centre;
        double radius_m;
        double flux; ///< relative
    };
    void find_patches(const std::vector<SunSource>& suns);
    void learn(const Point& low, const Vec3& size, std::uint64_t key, Cell& cell) const;
    Shares shares_of(const Entry* entries, std::size_t count, const Point& at, const Direction& normal,
                     bool transmits) const;
    Spectrum seen_outside(const Point& beyond, const Direction& direction) const;
    void learn_portals(const Point& low, const Vec3& size, std::uint64_t key, Cell& cell) const;
    void learn_patches(const Point& low, const Vec3& size, std::uint64_t key, Cell& cell) const;

    const RayQueries& rays_;
    const SkySource& sky_;
    const std::vector<SunSource>& suns_;
    std::vector<const Material*> materials_; ///< by modifier
    std::vector<Portal> portals_;
    std::vector<Patch> patches_;
    std::unique_ptr<Lattice> lattice_;
};

} // namespace lightwell
