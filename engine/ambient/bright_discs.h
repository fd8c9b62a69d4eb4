#pragma once

#include "engine/base/spectrum.h"
#include "engine/sampling/warps.h"

#include <array>
#include <vector>

namespace lightwell {

/// Places on surfaces that lamps or the sun light far more than the rest: where scattered rays are worth aiming, since
/// most ambient light of the room comes from there.
/// Error: none; it only says where rays go
class BrightDiscs {
public:
    /// A piece of surface about a point.
    struct Lit {
        Point centre;
        Direction normal;
        double radius_m = 0;
        double irradiance = 0; ///< photopic, W/m^2
        double visits = 0;     ///< of rays that went out by the cosine: how much of what is seen it takes up
    };
    BrightDiscs() = default;
    /// Keeps the brightest pieces when they are few and give most of the light, neighbours taken together if need be;
    /// else none.
    explicit BrightDiscs(std::vector<Lit> pieces);

    static constexpr std::size_t most_discs = 48;
    bool empty() const noexcept { return discs_.empty(); }
    std::size_t size() const noexcept { return discs_.size(); }

    /// A choice among the discs for one receiver.
    struct Shares {
        Point from;
        std::array<double, most_discs> summed; ///< up to and including each; the first size() count
        double total = 0;
    };
    Shares shares(const Point& from, const Direction& normal) const noexcept;
    SampledDirection sample(const Shares& shares, UnitSquare u) const noexcept;
    double density_per_sr(const Shares& shares, const Direction& direction) const noexcept;

private:
    /// @param pieces  brightest first   @return  whether there are too many to have most of the light in few discs
    bool keep_brightest(const std::vector<Lit>& pieces, double light, double visits);
    std::vector<Lit> discs_;
};

} // namespace lightwell
