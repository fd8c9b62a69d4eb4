#include "importers/layered_materials.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

constexpr double coat_reflectance = 0.04; ///< ((1.5 - 1) / (1.5 + 1))^2

/// Hemispherical reflectance of white fibres under diffuse light at roughness 0, 0.2, ... 1.
constexpr double sheen_reflectances[] = {0.026, 0.075, 0.144, 0.192, 0.223, 0.242};

double sheen_reflectance(double perceptual) noexcept
{
    constexpr int last = static_cast<int>(std::size(sheen_reflectances)) - 1;
    const double at = std::clamp(perceptual, 0.0, 1.0) * last;
    const int below = std::min(static_cast<int>(at), last - 1);
    return std::lerp(sheen_reflectances[below], sheen_reflectances[below + 1], at - below);
}

Spectrum within_unit(const Spectrum& s) noexcept
{
    return {std::clamp(s.r, 0.0, 1.0), std::clamp(s.g, 0.0, 1.0), std::clamp(s.b, 0.0, 1.0)};
}

} // namespace

Trans partly_open(const Plastic& covered, double opacity) noexcept
{
    const double specularity = opacity * covered.specularity;
    const double rest = 1 - specularity;
    if (!(rest > 0))
        return {{}, 1, covered.roughness, 0, 0};
    const Spectrum diffuse = covered.colour * (opacity * (1 - covered.specularity));
    const double open = 1 - opacity;
    const Spectrum colour = within_unit((diffuse + Spectrum::grey(open)) / rest);
    const double mean = photopic(colour);
    const double transmission = mean > 0 ? std::clamp(open / rest / mean, 0.0, 1.0) : 0;
    return {colour, specularity, covered.roughness, transmission, 1};
}

Plastic with_coat(const Plastic& below, double coverage, double roughness) noexcept
{
    const double coat = coat_reflectance * std::clamp(coverage, 0.0, 1.0);
    if (coat <= 0)
        return below;
    const double specularity = coat + (1 - coat) * below.specularity;
    const double slope = (coat * roughness + below.specularity * below.roughness) / (coat + below.specularity);
    return {below.colour, specularity, std::clamp(slope, 0.0, 1.0)};
}

Plastic with_sheen(const Plastic& below, const Spectrum& sheen, double perceptual) noexcept
{
    const double reflectance = sheen_reflectance(perceptual);
    const double dimmed = 1 - reflectance * sheen.max();
    return {within_unit(below.colour * dimmed + sheen * reflectance), below.specularity, below.roughness};
}

} // namespace lightwell
