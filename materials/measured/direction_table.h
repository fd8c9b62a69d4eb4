#pragma once

#include "engine/base/vector.h"
#include "engine/sampling/warps.h"

#include <memory>

namespace lightwell {

/// What one side of a sheet sends back, or lets through, by two directions.
///
/// Directions are told by their projection on the sheet: of the incident one reversed (the way the light travels), of
/// the outgoing one as it is, so that equal points are the straight passage, or the reflection back along the meridian.
class DirectionTable {
public:
    virtual ~DirectionTable() = default;
    virtual double value_per_sr(const DiscPoint& in, const DiscPoint& out) const noexcept = 0;
    /// Integral of the values times the cosine over all outgoing directions.
    virtual double hemispherical(const DiscPoint& in) const noexcept = 0;
    /// An outgoing direction, and its density per projected solid angle: about as the values.
    virtual DiscPoint sample(const DiscPoint& in, double choice, UnitSquare u) const noexcept = 0;
    virtual double density(const DiscPoint& in, const DiscPoint& out) const noexcept = 0;
    /// The same with incident and outgoing directions exchanged.
    virtual std::shared_ptr<const DirectionTable> reversed() const = 0;
    /// The smallest value: what is the same in all directions.
    virtual double least_per_sr() const noexcept = 0;
    /// The largest hemispherical().
    virtual double most_hemispherical() const noexcept = 0;
    /// A sharp peak about the straight passage.
    struct Peak {
        double share = 0;         ///< of the light that passes in it alone; 0: there is none
        double around_per_sr = 0; ///< the value about it
    };
    virtual Peak peak(const DiscPoint& in) const noexcept = 0;
    /// Whether an outgoing direction lies in that peak.
    virtual bool within_peak(const DiscPoint& in, const DiscPoint& out) const noexcept = 0;
    /// A peak stands out when it is this much higher than what lies around it; below, it is part of a smooth lobe.
    static constexpr double least_peak = 1.5;

protected:
    /// Mean value on a circle about the straight passage.
    double around(const DiscPoint& in, double radius) const noexcept;
};

/// CIE X and Z beside luminous values, which are Y, relative to equal-energy white; null: grey.
struct ColourTables {
    std::shared_ptr<const DirectionTable> x, z;
};

} // namespace lightwell
