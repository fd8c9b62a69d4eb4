#pragma once

#include "engine/sources/local_source.h"

#include <vector>

namespace lightwell {

/// Glazed openings through which the sky is seen: directions to aim at from inside a room.
/// They change where samples go, never what is added up.
class Portals {
public:
    Portals() = default;
    explicit Portals(const Scene& scene);
    bool empty() const noexcept { return portals_.empty(); }

    /// Shares of the portals for a point: proportional to how large they look, times the receiver's cosine.
    struct Shares {
        static constexpr std::size_t most = 128;
        double summed[most];
        double total() const noexcept { return count == 0 ? 0 : summed[count - 1]; }
        std::size_t count = 0;
    };
    Shares shares(const Point& at, const Direction& normal, bool transmits) const noexcept;
    /// A direction towards a point of a portal; density 0 when there is none.
    SampledDirection sample(const Shares& shares, const Point& from, UnitSquare u) const noexcept;
    /// Density with which sample() finds the direction, over all portals that it passes.
    double density_per_sr(const Shares& shares, const Point& from, const Direction& direction) const noexcept;

private:
    struct Portal {
        Point corner;
        Vec3 edge_x, edge_y; ///< a parallelogram around the pane, in its plane
        Point centre;
        Direction normal;
        double area_m2;
        double radius_m;
    };
    std::vector<Portal> portals_;
};

} // namespace lightwell
