#pragma once

#include "materials/measured/angle_basis.h"
#include "materials/measured/direction_table.h"

namespace lightwell {

/// Values for each pair of patches of two bases.
class MatrixTable : public DirectionTable {
public:
    /// @param values  [outgoing][incident], 1/sr
    /// @param turned  directions are looked up on the opposite side of the disc (of an exchanged table)
    MatrixTable(AngleBasis incident, AngleBasis outgoing, std::vector<double> values, bool turned = false);

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
    std::size_t at(int incident, int outgoing) const noexcept;
    int incident_patch(const DiscPoint& in) const noexcept;
    int outgoing_patch(const DiscPoint& out) const noexcept;
    double total(int incident) const noexcept;

    AngleBasis incident_, outgoing_;
    std::vector<double> values_, summed_; ///< [incident][outgoing]; sums include the projected solid angle
    bool turned_;
    double least_ = 0, most_ = 0;
};

} // namespace lightwell
