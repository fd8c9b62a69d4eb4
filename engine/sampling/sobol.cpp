#include "engine/sampling/sobol.h"

#include <array>

namespace lightwell {
namespace {

constexpr int dimensions = 4;

/// A primitive polynomial and the first direction numbers of one dimension after the first.
struct Polynomial {
    int degree;
    std::uint32_t coefficients;
    std::array<std::uint32_t, 3> first;
};
constexpr std::array<Polynomial, 3> polynomials{{{1, 0, {1, 0, 0}}, {2, 1, {1, 3, 0}}, {3, 1, {1, 3, 1}}}};

using Columns = std::array<std::uint32_t, 32>;

constexpr Columns columns_of(int dimension)
{
    Columns v{};
    if (dimension == 0) {
        for (int i = 0; i < 32; ++i)
            v[i] = 1u << (31 - i);
        return v;
    }
    const Polynomial& p = polynomials[dimension - 1];
    for (int i = 0; i < p.degree; ++i)
        v[i] = p.first[i] << (31 - i);
    for (int i = p.degree; i < 32; ++i) {
        v[i] = v[i - p.degree] ^ (v[i - p.degree] >> p.degree);
        for (int k = 1; k < p.degree; ++k)
            v[i] ^= ((p.coefficients >> (p.degree - 1 - k)) & 1u) * v[i - k];
    }
    return v;
}

/// For each dimension and each byte of the index, the exclusive or of its columns: four look-ups instead of 32 steps.
using ByteTables = std::array<std::array<std::array<std::uint32_t, 256>, 4>, dimensions>;

constexpr ByteTables byte_tables()
{
    ByteTables tables{};
    for (int d = 0; d < dimensions; ++d) {
        const Columns columns = columns_of(d);
        for (int byte = 0; byte < 4; ++byte)
            for (int value = 1; value < 256; ++value) {
                int low = 0;
                while (!((value >> low) & 1))
                    ++low;
                // The value without its lowest bit has been filled before.
                tables[d][byte][value] = tables[d][byte][value & (value - 1)] ^ columns[8 * byte + low];
            }
    }
    return tables;
}

constexpr ByteTables tables = byte_tables();

constexpr std::uint32_t reversed(std::uint32_t x)
{
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    return __builtin_bswap32(x);
}

/// A hash in which each bit depends on lower bits only, which is what nested scrambling needs after reversal.
constexpr std::uint32_t low_to_high_hash(std::uint32_t x, std::uint32_t seed)
{
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

constexpr double fraction(std::uint32_t bits)
{
    return bits * 0x1p-32;
}

/// Keeps the keys of pair() and one() apart.
constexpr std::uint64_t single_dimensions = std::uint64_t{1} << 32;

} // namespace

std::uint32_t sobol_bits(std::uint32_t index, int dimension) noexcept
{
    const auto& t = tables[dimension];
    return t[0][index & 255] ^ t[1][(index >> 8) & 255] ^ t[2][(index >> 16) & 255] ^ t[3][index >> 24];
}

std::uint32_t owen_scrambled(std::uint32_t fraction, std::uint32_t seed) noexcept
{
    return reversed(low_to_high_hash(reversed(fraction), seed));
}

UnitSquare SampleSequence::pair(std::uint32_t sample_index, std::uint32_t dimension_pair) const noexcept
{
    UnitSquare point;
    pairs(sample_index, 1, dimension_pair, &point);
    return point;
}

void SampleSequence::pairs(std::uint32_t first_index, int count, std::uint32_t dimension_pair,
                           UnitSquare* points) const noexcept
{
    const std::uint64_t group = mix_bits(key_, dimension_pair / 2);
    const std::uint64_t own = mix_bits(group, dimension_pair % 2);
    const int first = dimension_pair % 2 ? 2 : 0;
    for (int i = 0; i < count; ++i) {
        // Scrambling the index shuffles the points, yet keeps every aligned power-of-two run together.
        const std::uint32_t index =
            owen_scrambled(first_index + static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(group));
        points[i] = {fraction(owen_scrambled(sobol_bits(index, first), static_cast<std::uint32_t>(own))),
                     fraction(owen_scrambled(sobol_bits(index, first + 1), static_cast<std::uint32_t>(own >> 32)))};
    }
}

double SampleSequence::one(std::uint32_t sample_index, std::uint32_t dimension) const noexcept
{
    const std::uint64_t own = mix_bits(key_, single_dimensions | dimension);
    const std::uint32_t index = owen_scrambled(sample_index, static_cast<std::uint32_t>(own));
    return fraction(owen_scrambled(sobol_bits(index, 0), static_cast<std::uint32_t>(own >> 32)));
}

} // namespace lightwell
