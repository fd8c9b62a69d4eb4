#pragma once

#include "engine/ambient/bright_discs.h"
#include "engine/sources/secondary_sources.h"

namespace lightwell {

/// Where a ray that leaves a receiver is worth aiming, beside the cosine: at the places that are lit most and at
/// openings that much light comes through.
class Aim {
public:
    /// @param discs, openings  null: none
    Aim(const BrightDiscs* discs, const SecondarySources* openings, const Point& from, const Direction& normal);

    explicit operator bool() const noexcept { return total_ > 0; }
    SampledDirection sample(UnitSquare u) const noexcept;
    double density_per_sr(const Direction& direction) const noexcept;

private:
    const BrightDiscs* discs_;
    const SecondarySources* openings_;
    BrightDiscs::Shares to_discs_;
    SecondarySources::Shares to_openings_;
    double total_ = 0, disc_share_ = 0;
};

} // namespace lightwell
