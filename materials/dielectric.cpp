#include "materials/dielectric.h"

#include <algorithm>
#include <cmath>

namespace lightwell {

Fresnel fresnel(double cosine, double relative_index) noexcept
{
    const double c = std::clamp(cosine, 0.0, 1.0);
    // Written so that equal indices lose no digits at grazing angles: there t is c itself.
    const double scaled = (relative_index - 1) * (relative_index + 1) + c * c;
    if (!(scaled > 0))
        return {};
    const double t = std::sqrt(scaled) / relative_index;
    const double s = (c - relative_index * t) / (c + relative_index * t);
    const double p = (relative_index * c - t) / (relative_index * c + t);
    return {s * s, p * p, t, false};
}

double DielectricBoundary::radiance_transmittance(double cos_viewer) const noexcept
{
    return (1 - reflectance(cos_viewer)) / (relative_index_ * relative_index_);
}

Direction DielectricBoundary::refracted(Direction to_viewer) const noexcept
{
    if (straight())
        return -to_viewer;
    const double t = fresnel(to_viewer.z, relative_index_).cos_refracted;
    return normalized(Vec3{-to_viewer.x / relative_index_, -to_viewer.y / relative_index_, -t});
}

} // namespace lightwell
