#pragma once

#include "engine/sampling/warps.h"
#include "materials/bsdf_sample.h"
#include "materials/material.h"

#include <optional>

namespace lightwell {

class DirectionTable;
struct ColourTables; // materials/measured/direction_table.h

/// Scattering from a file: what is the same in all directions counts as diffuse, the rest as a lobe; for aBSDF the peak
/// of what passes straight is taken out and seen sharply.
/// Frame   local, z = normal on the viewer's side, y upwards
/// Source  the viewer's direction is the file's incident one, as in other programs: measured data are reciprocal only
///         as far as the instrument is
class MeasuredScattering {
public:
    /// @param material  in place (materials/placed.h)
    MeasuredScattering(const Measured& material, bool from_front) noexcept;

    Spectrum value_per_sr(Direction to_viewer, Direction to_light, LobeSet set) const noexcept;
    double density_per_sr(Direction to_viewer, Direction to_light, LobeSet set) const noexcept;
    std::optional<BsdfSample> sample(Direction to_viewer, double choice, UnitSquare u, LobeSet set) const noexcept;
    Spectrum straight_transmittance(Direction to_viewer) const noexcept;
    Lobes lobes() const noexcept;

private:
    /// Probabilities of the parts; they sum to 1 or to 0.
    struct Shares {
        double straight = 0, reflected = 0, transmitted = 0, diffuse_reflection = 0, diffuse_transmission = 0;
    };
    /// The peak of a viewer's direction.
    struct Peak {
        double transmittance = 0; ///< of the peak alone
        double around_per_sr = 0; ///< value that stands in for it
    };
    Peak peak(const Direction& to_viewer) const noexcept;
    /// As tables are asked: the projection, reversed.
    DiscPoint incident(const Direction& to_viewer) const noexcept;
    Shares shares(const Direction& to_viewer, const Peak& peak, LobeSet set) const noexcept;
    Spectrum lobe_value(const Direction& to_viewer, const Direction& to_light, const Peak& peak) const noexcept;
    double density(const Shares& shares, const Direction& to_viewer, const Direction& to_light) const noexcept;

    /// The colour of a value of a table along two directions: that value, in colour.
    Spectrum coloured(const DirectionTable& table, const ColourTables& beside, const DiscPoint& in,
                      const DiscPoint& out) const noexcept;
    /// Of the peak, which has the colour of what passes straight.
    Spectrum straight(const Peak& peak, const Direction& to_viewer) const noexcept;

    const DirectionTable* reflection_ = nullptr;
    const DirectionTable* transmission_ = nullptr;
    const ColourTables *reflection_beside_ = nullptr, *transmission_beside_ = nullptr;
    Spectrum least_reflection_per_sr_, least_transmission_per_sr_; ///< what counts as diffuse
    double scale_ = 1, saturation_ = 1, side_ = 1;                 ///< side: sign of x in the frame of the file
    Spectrum diffuse_reflectance_, diffuse_transmittance_;
    bool passes_straight_ = false;
};

} // namespace lightwell
