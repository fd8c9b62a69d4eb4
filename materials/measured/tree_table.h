#pragma once

#include "materials/measured/direction_table.h"

#include <cstdint>
#include <vector>

namespace lightwell {

/// Values over a square of directions for each incident one, in cells that are halved where the values change.
///
/// Three coordinates, where only the angle between the planes of incidence and of the outgoing direction counts: the
/// incident radius, from 0.5 at the normal to 0 at the horizon, then the outgoing square in the plane of incidence.
/// Four: the incident square, then the outgoing one. Halves are 0 or 1 in bit i of a branch for coordinate i; in grids
/// of values the first coordinate runs slowest.
struct ValueTree {
    struct Node {
        int grid_bits = -1;      ///< of each coordinate of a grid of values; -1: branches
        std::uint32_t first = 0; ///< of its values, or of its branches
    };
    int coordinates = 4;
    std::vector<Node> nodes; ///< branches of a node stand together
    std::vector<double> values;
    int depth = 0; ///< of the finest cells, in halvings

    double at(const double* position) const noexcept;
};

class TreeTable : public DirectionTable {
public:
    /// @param exchanged  incident and outgoing directions are looked up in each other's place
    explicit TreeTable(std::shared_ptr<const ValueTree> tree, bool exchanged = false);

    double value_per_sr(const DiscPoint& in, const DiscPoint& out) const noexcept override;
    double hemispherical(const DiscPoint& in) const noexcept override;
    DiscPoint sample(const DiscPoint& in, double choice, UnitSquare u) const noexcept override;
    double density(const DiscPoint& in, const DiscPoint& out) const noexcept override;
    std::shared_ptr<const DirectionTable> reversed() const override;
    double least_per_sr() const noexcept override { return least_; }
    Peak peak(const DiscPoint& in) const noexcept override;
    bool within_peak(const DiscPoint& in, const DiscPoint& out) const noexcept override;
    double most_hemispherical() const noexcept override { return most_; }

private:
    bool isotropic() const noexcept { return tree_->coordinates == 3; }
    std::size_t incident_cell(const DiscPoint& in) const noexcept;
    DiscPoint incident_centre(std::size_t cell) const noexcept;
    double peak_radius() const noexcept;
    void sum_cells(std::size_t incident);

    std::shared_ptr<const ValueTree> tree_;
    bool exchanged_;
    std::size_t incident_side_, outgoing_side_; ///< cells along a coordinate
    std::vector<float> summed_;                 ///< [incident cell][outgoing cell], running sums
    double least_ = 0, most_ = 0;
};

} // namespace lightwell
