#include "engine/pictures/legend.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace lightwell {

namespace {

/// Round numbers for the upper end; each is divided evenly by some step of the legend.
constexpr std::array round_ends{1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0};
constexpr std::array round_steps{1.0, 2.0, 2.5, 5.0};
constexpr double shown_share = 0.99; ///< the brightest hundredth does not set the scale
constexpr double default_decades = 3;
/// Two numbers this close are one; covers the rounding of sums of steps.
constexpr double rounding = 1e-9;

/// mantissa * 10^exponent as the nearest double, so that it prints as it was meant.
double decimal(double mantissa, int exponent) noexcept
{
    return exponent < 0 ? mantissa / std::pow(10.0, -exponent) : mantissa * std::pow(10.0, exponent);
}

double round_above(double value) noexcept
{
    const int exponent = static_cast<int>(std::floor(std::log10(value)));
    for (const double end : round_ends)
        if (decimal(end, exponent) >= value * (1 - rounding))
            return decimal(end, exponent);
    return decimal(10, exponent);
}

/// The value that at least the given share of the finite values do not exceed; 0 when there is none.
double percentile(const std::vector<float>& values, double share)
{
    std::vector<float> finite;
    std::copy_if(values.begin(), values.end(), std::back_inserter(finite), [](float v) { return std::isfinite(v); });
    if (finite.empty())
        return 0;
    const auto at =
        finite.begin() + static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(finite.size() - 1)));
    std::nth_element(finite.begin(), at, finite.end());
    return static_cast<double>(*at);
}

std::vector<double> even_numbers(const Scale& scale, int most)
{
    const double range = scale.high - scale.low;
    for (int exponent = static_cast<int>(std::floor(std::log10(range))) - 2;; ++exponent)
        for (const double mantissa : round_steps) {
            const double step = decimal(mantissa, exponent);
            const double first = std::ceil(scale.low / step - rounding),
                         last = std::floor(scale.high / step + rounding);
            if (last - first + 1 > most)
                continue;
            std::vector<double> numbers;
            for (double k = first; k <= last; ++k)
                numbers.push_back(k == 0 ? 0 : decimal(k * mantissa, exponent));
            return numbers;
        }
}

/// 1, 2, 5 of each decade, or when there are too many only each `stride`-th decade.
std::vector<double> decade_numbers(const Scale& scale, int most)
{
    const int first = static_cast<int>(std::floor(std::log10(scale.low))),
              last = static_cast<int>(std::ceil(std::log10(scale.high)));
    for (int stride = 0;; ++stride) {
        std::vector<double> numbers;
        for (int exponent = first; exponent <= last; exponent += std::max(stride, 1))
            for (const double mantissa : {1.0, 2.0, 5.0}) {
                const double number = decimal(mantissa, exponent);
                if ((stride == 0 || mantissa == 1.0) && number >= scale.low * (1 - rounding) &&
                    number <= scale.high * (1 + rounding))
                    numbers.push_back(number);
            }
        if (static_cast<int>(numbers.size()) <= most)
            return numbers;
    }
}

} // namespace

double Scale::place(double value) const noexcept
{
    if (!logarithmic)
        return (value - low) / (high - low);
    return value > 0 ? std::log(value / low) / std::log(high / low) : -1;
}

Scale choose_scale(const std::vector<float>& values, const FalseColour& options)
{
    Scale scale{options.low, options.high, options.logarithmic};
    if (scale.high == 0 && !(scale.low < 0)) {
        const double shown = percentile(values, shown_share);
        scale.high = shown > scale.low && shown > 0 ? round_above(shown)
                     : scale.low > 0                ? round_above(2 * scale.low)
                                                    : 1;
    }
    if (scale.logarithmic && scale.low == 0)
        scale.low = scale.high / std::pow(10.0, default_decades);
    const bool ordered = std::isfinite(scale.low) && std::isfinite(scale.high) && scale.high - scale.low > 0 &&
                         std::isfinite(scale.high - scale.low) && (!scale.logarithmic || scale.low > 0);
    if (!ordered)
        throw InputError{"false colour", "the scale goes from " + shortest(scale.low) + " to " + shortest(scale.high),
                         std::string("expected low < high") +
                             (scale.logarithmic ? ", both above 0 for a logarithmic scale" : "")};
    for (const float value : values) {
        scale.has_none = scale.has_none || std::isnan(value);
        scale.has_more = scale.has_more || static_cast<double>(value) > scale.high * (1 + rounding);
        scale.has_less = scale.has_less || static_cast<double>(value) < scale.low;
    }
    return scale;
}

std::vector<double> legend_numbers(const Scale& scale, int most)
{
    constexpr double narrow = 5; // within less than this ratio 1, 2, 5 leave too few numbers
    return scale.logarithmic && scale.high / scale.low >= narrow ? decade_numbers(scale, most)
                                                                 : even_numbers(scale, most);
}

std::string number_text(double value)
{
    constexpr double plain_from = 1e-4, plain_to = 1e7;
    std::array<char, 64> text{};
    const double size = std::fabs(value);
    const auto format =
        size == 0 || (size >= plain_from && size < plain_to) ? std::chars_format::fixed : std::chars_format::scientific;
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value, format).ptr;
    std::string result(text.data(), end);
    if (const std::size_t sign = result.find("e+"); sign != std::string::npos)
        result.erase(sign + 1, result[sign + 2] == '0' ? 2 : 1); // 2e+09 is written 2e9
    return result;
}

} // namespace lightwell
