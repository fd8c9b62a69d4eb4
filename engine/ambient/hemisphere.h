#pragma once

#include "engine/base/frame.h"
#include "engine/base/spectrum.h"

#include <vector>

namespace lightwell {

/// Rays over a hemisphere, one in each cell of equal projected solid angle: rows from the zenith to the horizon,
/// columns around. `at(row, column)` is what the cell's ray saw.
struct Hemisphere {
    Frame frame; ///< z = normal
    int rows = 0, columns = 0;
    std::vector<Spectrum> radiance;
    std::vector<double> closeness_per_m; ///< 1 / distance

    Hemisphere(const Frame& f, int m, int n)
        : frame(f), rows(m), columns(n), radiance(static_cast<std::size_t>(m * n)),
          closeness_per_m(static_cast<std::size_t>(m * n))
    {
    }
    std::size_t at(int row, int column) const noexcept { return static_cast<std::size_t>(row * columns + column); }
};

/// Direction with density cosine / pi; cell (floor(u * rows), floor(v * columns)) of the hemisphere.
Direction hemisphere_direction(const Frame& frame, UnitSquare u) noexcept;

/// How irradiance changes as the receiver moves in its plane and turns.
struct IrradianceGradient {
    Vec3 translation[3]; ///< of each channel, W/m^3, in the plane
    Vec3 rotation[3];    ///< of each channel: turning from N to N' adds (N x N') . rotation
};

/// Error: the limit of many cells is exact for radiance that is smooth within each cell, changes of visibility
///        included (tests/unit/ambient)
/// Source  Ward, Heckbert 1992; the sum over tan(theta) in its rotation gradient replaced by the exact mean over
///         each row, which converges faster
IrradianceGradient gradient_of(const Hemisphere& samples) noexcept;

/// Second derivative of photopic irradiance in the receiver's plane, in its principal directions.
struct IrradianceHessian {
    Direction axis;           ///< of the first value
    double value[2] = {0, 0}; ///< W/m^4, |value[0]| >= |value[1]|
};
/// The samples are joined to a faceted surface of which Lambert's formula gives the irradiance at any place; where near
/// and far samples meet, the facet between them stands for what comes into view.
/// Source  Schwarzhaupt, Jensen, Jarosz 2012 (occlusion-aware Hessian), by differences instead of derivatives
IrradianceHessian hessian_of(const Hemisphere& samples) noexcept;

/// Harmonic mean distance, cosine-weighted; infinity where nothing was met.
double harmonic_distance_m(const Hemisphere& samples) noexcept;

} // namespace lightwell
