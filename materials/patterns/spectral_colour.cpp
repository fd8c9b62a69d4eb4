#include "materials/patterns/spectral_colour.h"

#include "engine/base/xyz_colour.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

double lobe(double nm, double peak, double below, double above) noexcept
{
    const double t = (nm - peak) / (nm < peak ? below : above);
    return std::exp(-0.5 * t * t);
}

Vec3 colour_matching(double nm) noexcept
{
    return {1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) -
                0.065 * lobe(nm, 501.1, 20.4, 26.2),
            0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1),
            1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8)};
}

} // namespace

const std::vector<SpectralWeight>& spectral_weights()
{
    static const std::vector<SpectralWeight> weights = [] {
        constexpr double first_nm = 380, last_nm = 780, step_nm = 5;
        std::vector<SpectralWeight> all;
        Spectrum total;
        for (double nm = first_nm; nm <= last_nm; nm += step_nm) {
            all.push_back({nm, colour_of_xyz(colour_matching(nm))});
            total += all.back().weight;
        }
        for (SpectralWeight& w : all)
            w.weight = {w.weight.r / total.r, w.weight.g / total.g, w.weight.b / total.b};
        return all;
    }();
    return weights;
}

Spectrum within_primaries(const Spectrum& colour) noexcept
{
    const double least = std::min({colour.r, colour.g, colour.b});
    if (least >= 0)
        return colour;
    const double brightness = photopic(colour);
    if (!(brightness > 0))
        return {};
    const double kept = brightness / (brightness - least);
    const auto mixed = [&](double channel) { return std::fmax(brightness + (channel - brightness) * kept, 0); };
    return {mixed(colour.r), mixed(colour.g), mixed(colour.b)};
}

} // namespace lightwell
