#include "materials/functions/library_functions.h"

#include "materials/functions/noise.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace lightwell {
namespace {

using Arguments = const double*;

template <double (*Function)(double)>
double of_one(Arguments a, std::uint32_t)
{
    return Function(a[0]);
}

/// Pseudo-random number in [0, 1) that depends on the argument alone.
/// Source  recorded values of `rand`; a fraction of a large number over a slowly changing one
double rand_of(Arguments a, std::uint32_t)
{
    constexpr double e = 2.71828182845904, quarter_pi = .785398163397447, large = 1e5;
    double x = a[0];
    x *= 1 / (1 + x * x) + e;
    x += quarter_pi - std::floor(x);
    x = large / x;
    return x - std::floor(x);
}

double least(Arguments a, std::uint32_t count)
{
    return *std::min_element(a, a + count);
}

double greatest(Arguments a, std::uint32_t count)
{
    return *std::max_element(a, a + count);
}

/// Cubic between two values with slopes given at both ends.
double hermite(Arguments a, std::uint32_t)
{
    const double t = a[4];
    return a[0] * ((2 * t - 3) * t * t + 1) + a[1] * (3 - 2 * t) * t * t + a[2] * (((t - 2) * t + 1) * t) +
           a[3] * ((t - 1) * t * t);
}

template <int Component>
double gradient_noise(Arguments a, std::uint32_t)
{
    const NoiseValue n = gradient_noise_at({a[0], a[1], a[2]});
    return Component < 0 ? n.value : n.gradient[Component];
}

constexpr LibraryFunction functions[] = {
    {"acos", 1, of_one<std::acos>},
    {"asin", 1, of_one<std::asin>},
    {"atan", 1, of_one<std::atan>},
    {"atan2", 2, [](Arguments a, std::uint32_t) { return std::atan2(a[0], a[1]); }},
    {"ceil", 1, of_one<std::ceil>},
    {"cos", 1, of_one<std::cos>},
    {"erf", 1, of_one<std::erf>},
    {"erfc", 1, of_one<std::erfc>},
    {"exp", 1, of_one<std::exp>},
    {"floor", 1, of_one<std::floor>},
    {"fnoise3", 3,
     [](Arguments a, std::uint32_t) {
         return fractal_noise_at({a[0], a[1], a[2]});
     }},
    {"hermite", 5, hermite},
    {"log", 1, of_one<std::log>},
    {"log10", 1, of_one<std::log10>},
    {"max", 1, greatest, true},
    {"min", 1, least, true},
    {"noise3", 3, gradient_noise<-1>},
    {"noise3x", 3, gradient_noise<0>},
    {"noise3y", 3, gradient_noise<1>},
    {"noise3z", 3, gradient_noise<2>},
    {"rand", 1, rand_of},
    {"sin", 1, of_one<std::sin>},
    {"sqrt", 1, of_one<std::sqrt>},
    {"tan", 1, of_one<std::tan>},
};

} // namespace

int find_library_function(std::string_view name) noexcept
{
    for (std::size_t i = 0; i < std::size(functions); ++i)
        if (functions[i].name == name)
            return static_cast<int>(i);
    return -1;
}

const LibraryFunction& library_function(std::uint32_t index) noexcept
{
    return functions[index];
}

} // namespace lightwell
