#include "materials/ashikhmin.h"

#include "materials/diffuse.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

double fifth_power(double x)
{
    const double square = x * x;
    return square * square * x;
}

/// Schlick's form: the reflectance rises to 1 at grazing angles.
Spectrum schlick(const Spectrum& along_normal, double cosine)
{
    return along_normal + (Spectrum::grey(1) - along_normal) * fifth_power(1 - std::clamp(cosine, 0.0, 1.0));
}

} // namespace

/// Density of facets per solid angle, times their cosine: integrates to 1 over the half vectors.
double AshikhminScattering::facet_density(const Direction& half) const noexcept
{
    const double sine2 = half.x * half.x + half.y * half.y;
    const double power = sine2 > 0 ? (s_.power_u * half.x * half.x + s_.power_v * half.y * half.y) / sine2 : s_.power_u;
    return std::sqrt((s_.power_u + 1) * (s_.power_v + 1)) / (2 * pi) * std::pow(half.z, power);
}

/// Probability with which the highlight is chosen.
double AshikhminScattering::highlight_share(double cos_viewer, LobeSet set) const noexcept
{
    if (set != LobeSet::all)
        return set == LobeSet::specular ? 1 : 0;
    const double highlight = photopic(schlick(s_.specular, cos_viewer));
    const double diffuse = photopic(s_.diffuse * (Spectrum::grey(1) - s_.specular));
    return highlight + diffuse > 0 ? highlight / (highlight + diffuse) : 0;
}

Spectrum AshikhminScattering::value_per_sr(Direction to_viewer, Direction to_light, LobeSet set) const noexcept
{
    if (!(to_viewer.z > 0 && to_light.z > 0))
        return {};
    Spectrum value;
    if (set != LobeSet::specular) {
        const double entering = 1 - fifth_power(1 - to_viewer.z / 2), leaving = 1 - fifth_power(1 - to_light.z / 2);
        value += s_.diffuse * (Spectrum::grey(1) - s_.specular) * (28 / (23 * pi) * entering * leaving);
    }
    if (set != LobeSet::diffuse) {
        const Direction half = normalized(to_viewer + to_light);
        const double met = dot(half, to_viewer);
        if (met > 0)
            value += schlick(s_.specular, met) * (facet_density(half) / (4 * met * std::fmax(to_viewer.z, to_light.z)));
    }
    return value;
}

double AshikhminScattering::density_per_sr(Direction to_viewer, Direction to_light, LobeSet set) const noexcept
{
    if (!(to_viewer.z > 0 && to_light.z > 0))
        return 0;
    const double share = highlight_share(to_viewer.z, set);
    const Direction half = normalized(to_viewer + to_light);
    const double met = dot(half, to_viewer);
    const double highlight = met > 0 ? facet_density(half) / (4 * met) : 0;
    return share * highlight + (1 - share) * Diffuse::density_per_sr(to_light.z);
}

std::optional<BsdfSample> AshikhminScattering::sample(Direction to_viewer, double choice, UnitSquare u,
                                                      LobeSet set) const noexcept
{
    if (!(to_viewer.z > 0))
        return {};
    Direction to_light;
    if (choice < highlight_share(to_viewer.z, set)) {
        // The azimuth of an ellipse by its circle, then the height of that azimuth's power.
        const double turn = 2 * pi * u.v;
        const Vec3 along =
            normalized(Vec3{std::cos(turn) * std::sqrt(s_.power_v + 1), std::sin(turn) * std::sqrt(s_.power_u + 1), 0});
        const double power = s_.power_u * along.x * along.x + s_.power_v * along.y * along.y;
        const double height = std::pow(1 - u.u, 1 / (power + 1));
        const double radius = std::sqrt(std::fmax(0, 1 - height * height));
        const Direction half{along.x * radius, along.y * radius, height};
        to_light = half * (2 * dot(to_viewer, half)) - to_viewer;
        if (!(to_light.z > 0 && dot(to_viewer, half) > 0))
            return {}; // lost below the surface
    } else {
        to_light = Diffuse::sample(u);
    }
    const double density = density_per_sr(to_viewer, to_light, set);
    if (!(density > 0))
        return {};
    const Spectrum weight = value_per_sr(to_viewer, to_light, set) * (to_light.z / density);
    if (!weight.is_finite() || !std::isfinite(density)) // so flat that cosines leave the range of numbers
        return {};
    return BsdfSample{to_light, weight, density, false, false};
}

Lobes AshikhminScattering::lobes() const noexcept
{
    Lobes lobes;
    // Mean of the diffuse part over all directions of viewer and light: 28 / 23 (2 (1/2 - 5/56))^2.
    constexpr double mean = 0.821429;
    lobes.diffuse_reflectance = s_.diffuse * (Spectrum::grey(1) - s_.specular) * mean;
    lobes.glossy = true;
    lobes.glossy_width_rad = std::sqrt(2 / (std::fmax(s_.power_u, s_.power_v) + 2));
    return lobes;
}

} // namespace lightwell
