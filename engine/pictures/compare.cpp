#include "engine/pictures/compare.h"

#include "engine/base/errors.h"
#include "engine/base/spectrum.h"
#include "engine/pictures/limits.h"

#include <cmath>
#include <cstring>

namespace lightwell {

namespace {

/// Both not a number, or infinite with the same sign, agree; anything else that is not finite does not.
bool same_kind(double a, double b) noexcept
{
    return (std::isnan(a) && std::isnan(b)) || a == b || (std::isfinite(a) && std::isfinite(b));
}

template <class Value, class Reference>
Difference difference(int width, std::size_t count, const Value& value, const Reference& reference)
{
    Difference result;
    double squares = 0, reference_squares = 0, sum = 0, reference_sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double a = value(i), b = reference(i);
        if (!same_kind(a, b))
            ++result.mismatched;
        if (!std::isfinite(a) || !std::isfinite(b))
            continue;
        ++result.compared;
        squares += (a - b) * (a - b);
        reference_squares += b * b;
        sum += a;
        reference_sum += b;
        if (std::fabs(a - b) > result.worst) {
            result.worst = std::fabs(a - b);
            result.worst_x = static_cast<int>(i % static_cast<std::size_t>(width));
            result.worst_y = static_cast<int>(i / static_cast<std::size_t>(width));
        }
    }
    result.relative_rms = squares > 0 ? std::sqrt(squares / reference_squares) : 0;
    result.mean_ratio = sum == reference_sum ? 1 : sum / reference_sum;
    return result;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) noexcept
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

bool has_colour(const Picture& p)
{
    return p.channels.contains("R") && p.channels.contains("G") && p.channels.contains("B");
}

auto luminance_in(const Picture& p)
{
    return [&r = p.channels.at("R"), &g = p.channels.at("G"), &b = p.channels.at("B")](std::size_t i) {
        return luminance_of({r[i], g[i], b[i]}).value;
    };
}

} // namespace

Comparison compare(const Picture& picture, const Picture& reference)
{
    check_picture("comparison", picture);
    check_picture("comparison: reference", reference);
    if (picture.width != reference.width || picture.height != reference.height)
        throw InputError{"comparison",
                         "sizes are " + std::to_string(picture.width) + " x " + std::to_string(picture.height) +
                             " and " + std::to_string(reference.width) + " x " + std::to_string(reference.height),
                         "render both at the same size"};
    Comparison result;
    result.identical = picture.channels.size() == reference.channels.size();
    const std::size_t count = reference.channels.begin()->second.size();
    for (const auto& [name, expected] : reference.channels) {
        const auto found = picture.channels.find(name);
        if (found == picture.channels.end()) {
            result.missing.push_back(name);
            result.identical = false;
            continue;
        }
        const std::vector<float>& values = found->second;
        result.identical = result.identical && same_bits(values, expected);
        result.channels[name] = difference(
            picture.width, count, [&](std::size_t i) { return static_cast<double>(values[i]); },
            [&, &wanted = expected](std::size_t i) { return static_cast<double>(wanted[i]); });
    }
    for (const auto& [name, values] : picture.channels)
        if (!reference.channels.contains(name))
            result.additional.push_back(name);
    if (has_colour(picture) && has_colour(reference))
        result.luminance = difference(picture.width, count, luminance_in(picture), luminance_in(reference));
    return result;
}

} // namespace lightwell
