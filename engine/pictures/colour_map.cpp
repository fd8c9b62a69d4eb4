#include "engine/pictures/colour_map.h"

#include "engine/base/spectrum.h"
#include "engine/base/vector.h"

namespace lightwell {

namespace {

// CIE L*a*b* with the white of sRGB. Source  CIE 15:2004; IEC 61966-2-1
constexpr double white_x = 0.95047, white_z = 1.08883;
constexpr double linear_limit = 6.0 / 29;

double lab_to_linear(double f) noexcept
{
    return f > linear_limit ? f * f * f : 3 * linear_limit * linear_limit * (f - 4.0 / 29);
}

Spectrum linear_srgb(double lightness, double a, double b) noexcept
{
    const double f = (lightness + 16) / 116;
    const double x = white_x * lab_to_linear(f + a / 500);
    const double y = lab_to_linear(f);
    const double z = white_z * lab_to_linear(f - b / 200);
    return {3.2404542 * x - 1.5371385 * y - 0.4985314 * z, -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
            0.0556434 * x - 0.2040259 * y + 1.0572252 * z};
}

struct Knot {
    double place, hue_deg, chroma;
};
/// Hue turns from violet through blue, green and yellow. Chroma stays just inside what sRGB can show at that lightness,
/// because a colour that had to be cut would leave a visible edge in the map where the values have none.
constexpr std::array<Knot, 8> knots{{{0.00, 315, 34},
                                     {0.14, 303, 52},
                                     {0.28, 288, 48},
                                     {0.42, 246, 31},
                                     {0.56, 186, 33},
                                     {0.70, 144, 50},
                                     {0.84, 112, 70},
                                     {1.00, 96, 31}}};
constexpr double darkest = 14, lightest = 94;

/// Smooth curve through numbers given at the knots: cubic Hermite, slopes from the neighbours.
double through_knots(const std::array<double, knots.size()>& at, double place) noexcept
{
    std::size_t i = 0;
    while (i + 2 < knots.size() && place > knots[i + 1].place)
        ++i;
    const auto slope = [&](std::size_t k) {
        const std::size_t before = k > 0 ? k - 1 : k, after = std::min(k + 1, knots.size() - 1);
        return (at[after] - at[before]) / (knots[after].place - knots[before].place);
    };
    const double step = knots[i + 1].place - knots[i].place, t = (place - knots[i].place) / step;
    const double rise = t * t * (3 - 2 * t);
    return at[i] * (1 - rise) + at[i + 1] * rise + step * t * (1 - t) * ((1 - t) * slope(i) - t * slope(i + 1));
}

std::array<std::uint8_t, 3> computed_colour(double place) noexcept
{
    std::array<double, knots.size()> a{}, b{};
    for (std::size_t k = 0; k < knots.size(); ++k) {
        a[k] = knots[k].chroma * std::cos(knots[k].hue_deg * radians_per_degree);
        b[k] = knots[k].chroma * std::sin(knots[k].hue_deg * radians_per_degree);
    }
    const double lightness = darkest + (lightest - darkest) * place;
    const Spectrum linear = linear_srgb(lightness, through_knots(a, place), through_knots(b, place));
    std::array<std::uint8_t, 3> colour{};
    for (int c = 0; c < 3; ++c)
        colour[static_cast<std::size_t>(c)] =
            static_cast<std::uint8_t>(std::lround(255 * linear_to_srgb(std::clamp(linear[c], 0.0, 1.0))));
    return colour;
}

constexpr std::size_t table_size = 512; // finer than 8 bits show

std::array<std::array<std::uint8_t, 3>, table_size> computed_table() noexcept
{
    std::array<std::array<std::uint8_t, 3>, table_size> table{};
    for (std::size_t i = 0; i < table_size; ++i)
        table[i] = computed_colour(static_cast<double>(i) / (table_size - 1));
    return table;
}

} // namespace

std::array<std::uint8_t, 3> map_colour(double place) noexcept
{
    static const auto table = computed_table();
    const double inside = place > 0 ? std::min(place, 1.0) : 0; // not a number goes to the low end
    return table[static_cast<std::size_t>(std::lround(inside * (table_size - 1)))];
}

double lightness_of(std::array<std::uint8_t, 3> srgb) noexcept
{
    const double y = 0.2126729 * srgb_to_linear(srgb[0] / 255.0) + 0.7151522 * srgb_to_linear(srgb[1] / 255.0) +
                     0.0721750 * srgb_to_linear(srgb[2] / 255.0);
    const double cube = linear_limit * linear_limit * linear_limit;
    return y > cube ? 116 * std::cbrt(y) - 16 : y * 116 / (3 * linear_limit * linear_limit);
}

} // namespace lightwell
