#include "engine/base/errors.h"
#include "engine/base/spectrum.h"
#include "engine/pictures/limits.h"
#include "engine/pictures/png.h"

#include <algorithm>
#include <cmath>

namespace lightwell {

namespace {

/// The grey that an average scene is shown at, before the curve: Reinhard et al. 2002.
constexpr double middle_grey = 0.18;
/// The darkest and brightest twentieths do not vote: black corners, lamps and the sun are not what one looks at.
constexpr double trimmed_share = 0.05;
/// All but a thousandth of the pixels end below white; the sun and lamps may burn out.
constexpr double white_percentile = 0.999;
/// White at least this far above grey, so that an even picture is not stretched to pure white.
constexpr double least_white = 2.0;

struct Exposure {
    double factor = 1;
    double white = least_white; ///< exposed luminance shown as white
};

/// Photopic radiance of the pixels that have any, sorted.
std::vector<double> visible_luminances(const Picture& picture, const std::vector<float>& r, const std::vector<float>& g,
                                       const std::vector<float>& b)
{
    std::vector<double> found;
    found.reserve(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
    for (std::size_t i = 0; i < r.size(); ++i) {
        const double y = photopic({r[i], g[i], b[i]});
        if (y > 0 && std::isfinite(y))
            found.push_back(y);
    }
    std::sort(found.begin(), found.end());
    return found;
}

Exposure choose_exposure(const std::vector<double>& sorted, double wanted)
{
    Exposure result;
    if (sorted.empty())
        return result;
    const auto count = static_cast<double>(sorted.size());
    const auto trimmed = static_cast<std::size_t>(count * trimmed_share);
    double log_sum = 0;
    for (std::size_t i = trimmed; i < sorted.size() - trimmed; ++i)
        log_sum += std::log(sorted[i]);
    const double average = std::exp(log_sum / static_cast<double>(sorted.size() - 2 * trimmed));
    result.factor = wanted > 0 ? wanted : middle_grey / average;
    const double high = sorted[static_cast<std::size_t>((count - 1) * white_percentile)];
    result.white = std::max(least_white, high * result.factor);
    return result;
}

/// Colours outside the display's range move towards grey of the same luminance until they fit, instead of being cut
/// channel by channel, which would change their hue. Towards white they begin to move early, so that a light that
/// grows brighter fades to white without an edge.
Spectrum into_display_range(Spectrum colour, double luminance) noexcept
{
    constexpr double softness = 6; // a colour at half the range keeps 99.7 % of its saturation
    const double grey = std::clamp(luminance, 0.0, 1.0);
    double above = 0, keep = 1;
    for (const double c : {colour.r, colour.g, colour.b}) {
        if (c > grey)
            above += std::pow((c - grey) / (1 - grey), softness);
        else if (c < 0)
            keep = std::min(keep, grey / (grey - c));
    }
    keep = std::min(keep, std::pow(1 + above, -1 / softness));
    return Spectrum::grey(grey) + (colour - Spectrum::grey(grey)) * keep;
}

/// Extended curve of Reinhard et al. 2002, Eq. (4), on luminance: linear below, 1 at `white`, never a jump.
Spectrum displayed(Spectrum radiance, const Exposure& exposure) noexcept
{
    const double y = photopic(radiance) * exposure.factor;
    if (!(y > 0))
        return {};
    if (!std::isfinite(y))
        return Spectrum::grey(1);
    const double shown = y * (1 + y / (exposure.white * exposure.white)) / (1 + y);
    if (!(shown < 1))
        return Spectrum::grey(1);
    return into_display_range(to_rec709(radiance * (exposure.factor * shown / y)), shown);
}

} // namespace

DisplayPicture tone_mapped(const Picture& picture, double exposure)
{
    constexpr const char* place = "tone mapping";
    check_picture(place, picture);
    for (const char* name : {"R", "G", "B"})
        if (!picture.channels.contains(name))
            throw InputError{place, std::string("picture has no channel ") + name, "give a picture with R, G and B"};
    if (!(exposure >= 0 && std::isfinite(exposure)))
        throw InputError{place, "exposure is " + std::to_string(exposure), "expected a factor > 0, or 0 to choose"};
    const std::vector<float>&r = picture.channels.at("R"), &g = picture.channels.at("G"), &b = picture.channels.at("B");
    const Exposure chosen = choose_exposure(visible_luminances(picture, r, g, b), exposure);
    DisplayPicture result{picture.width, picture.height, std::vector<std::uint8_t>(3 * r.size())};
    for (std::size_t i = 0; i < r.size(); ++i) {
        const Spectrum shown = displayed({r[i], g[i], b[i]}, chosen);
        for (int c = 0; c < 3; ++c)
            result.rgb[3 * i + static_cast<std::size_t>(c)] =
                static_cast<std::uint8_t>(std::lround(255 * linear_to_srgb(std::clamp(shown[c], 0.0, 1.0))));
    }
    return result;
}

} // namespace lightwell
