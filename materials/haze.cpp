#include "materials/haze.h"

#include <algorithm>
#include <cmath>

namespace lightwell {

double HazeScattering::phase_per_sr(double cosine) const noexcept
{
    const double g = eccentricity_, spread = 1 + g * g - 2 * g * cosine;
    return (1 - g * g) / (4 * pi * spread * std::sqrt(spread));
}

double HazeScattering::sample_cosine(double u) const noexcept
{
    const double g = eccentricity_;
    constexpr double even = 1e-4;
    if (std::fabs(g) < even)
        return 1 - 2 * u;
    const double s = (1 - g * g) / (1 - g + 2 * g * u);
    return std::clamp((1 + g * g - s * s) / (2 * g), -1.0, 1.0);
}

Spectrum HazeScattering::value_per_sr(Direction to_viewer, Direction to_light, LobeSet set) const noexcept
{
    if (set == LobeSet::diffuse || to_light.z == 0)
        return {};
    return Spectrum::grey(phase_per_sr(-dot(to_viewer, to_light)) / std::fabs(to_light.z));
}

Lobes HazeScattering::lobes() const noexcept
{
    Lobes lobes;
    lobes.glossy = true; // light from all sides counts
    lobes.glossy_width_rad = 1;
    return lobes;
}

} // namespace lightwell
