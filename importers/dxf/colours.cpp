#include "importers/dxf/colours.h"

#include <array>
#include <cmath>

namespace lightwell::dxf {
namespace {

constexpr std::array<std::int32_t, 10> first_colours{0xFFFFFF, 0xFF0000, 0xFFFF00, 0x00FF00, 0x00FFFF,
                                                     0x0000FF, 0xFF00FF, 0xFFFFFF, 0x808080, 0xC0C0C0};
constexpr std::array<std::int32_t, 6> greys{0x333333, 0x505050, 0x696969, 0x828282, 0xBEBEBE, 0xFFFFFF};
constexpr int first_hue = 10, first_grey = 250;

/// Brightness of one primary, 0 to 1, at a hue; the others are the same curve a third of the circle away.
double primary(double hue_deg)
{
    const double distance = std::fabs(std::remainder(hue_deg, 360));
    return distance <= 60 ? 1 : distance >= 120 ? 0 : (120 - distance) / 60;
}

/// Colours 10 to 249: 24 hues of 15 degrees, five shades each, full and half saturated.
std::int32_t hue_colour(int index)
{
    constexpr double shades[] = {1, 0.65, 0.5, 0.3, 0.15};
    const double hue_deg = 15.0 * (index / 10 - 1), shade = shades[index % 10 / 2];
    const double white = index % 2 == 1 ? 0.5 : 0;
    std::int32_t rgb = 0;
    for (const double offset : {0.0, 120.0, 240.0}) {
        const double level = shade * (white + (1 - white) * primary(hue_deg - offset));
        rgb = rgb * 256 + static_cast<std::int32_t>(255 * level);
    }
    return rgb;
}

} // namespace

Spectrum palette_colour(int index)
{
    if (index < 1 || index > 255)
        return true_colour(first_colours[colour_white]);
    if (index < first_hue)
        return true_colour(first_colours[static_cast<std::size_t>(index)]);
    return true_colour(index < first_grey ? hue_colour(index) : greys[static_cast<std::size_t>(index - first_grey)]);
}

Spectrum true_colour(std::int32_t rgb)
{
    const auto channel = [rgb](int shift) { return srgb_to_linear(((rgb >> shift) & 0xFF) / 255.0); };
    return {channel(16), channel(8), channel(0)};
}

} // namespace lightwell::dxf
