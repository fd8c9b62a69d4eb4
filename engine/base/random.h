#pragma once

#include "engine/base/vector.h"

#include <cstdint>

namespace lightwell {

/// A well-mixed 64-bit value from any 64-bit value.
/// Source  Steele, Lea, Flood 2014 (SplitMix64 finaliser, variant 13 of Stafford)
constexpr std::uint64_t mix_bits(std::uint64_t x) noexcept
{
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

constexpr std::uint64_t mix_bits(std::uint64_t a, std::uint64_t b) noexcept
{
    return mix_bits(mix_bits(a) ^ b);
}

/// [0, 1) from the top 53 bits.
constexpr double unit_from_bits(std::uint64_t bits) noexcept
{
    return static_cast<double>(bits >> 11) * 0x1p-53;
}

/// Counter-based random numbers: a pure function of (key, count), so that a result does not depend on which
/// thread draws it, nor on what was drawn before for another pixel or sensor.
class RandomStream {
public:
    explicit constexpr RandomStream(std::uint64_t key) noexcept : key_(mix_bits(key)) {}
    constexpr RandomStream(std::uint64_t seed, std::uint64_t item, std::uint64_t sample) noexcept
        : key_(mix_bits(mix_bits(mix_bits(seed), item), sample))
    {
    }
    constexpr std::uint64_t bits() noexcept { return mix_bits(key_, ++count_); }
    constexpr double next() noexcept { return unit_from_bits(bits()); }
    constexpr UnitSquare square() noexcept
    {
        const double u = next();
        return {u, next()};
    }

private:
    std::uint64_t key_;
    std::uint64_t count_ = 0;
};

} // namespace lightwell
