#pragma once

#include "engine/base/random.h"
#include "engine/base/vector.h"

#include <cstdint>

namespace lightwell {

/// Component of a point of the Sobol sequence, as a 32-bit fraction.
/// @param dimension  0 to 3
/// Source  Joe, Kuo 2008 (direction numbers)
std::uint32_t sobol_bits(std::uint32_t index, int dimension) noexcept;
/// Owen's nested uniform scrambling of a 32-bit fraction: each binary digit is flipped depending on those before it.
/// Source  Laine, Karras 2011; Burley 2020; the constants of the hash are Vegdahl's of 2021
std::uint32_t owen_scrambled(std::uint32_t fraction, std::uint32_t seed) noexcept;

/// The points used by one pixel or sensor: scrambled Sobol points, a pure function of (seed, item, index, dimension),
/// so that the order of calls and the number of threads do not matter.
/// Four dimensions are a Sobol sequence; further groups of four reuse it in an independently shuffled order.
/// Different seeds give independent scramblings, hence honest error bars over replicates.
/// Source  Burley 2020, "Practical Hash-based Owen Scrambling"
class SampleSequence {
public:
    SampleSequence(std::uint64_t seed, std::uint64_t item) noexcept : key_(mix_bits(mix_bits(seed), item)) {}

    /// Any power-of-two run of indices that starts at a multiple of its length is stratified.
    /// @param dimension_pair  any number; pairs 2n and 2n + 1 are stratified jointly
    UnitSquare pair(std::uint32_t sample_index, std::uint32_t dimension_pair) const noexcept;
    /// pair() of `count` indices from `first_index` on.
    void pairs(std::uint32_t first_index, int count, std::uint32_t dimension_pair, UnitSquare* points) const noexcept;
    /// One coordinate, unrelated to those of pair().
    double one(std::uint32_t sample_index, std::uint32_t dimension) const noexcept;

private:
    std::uint64_t key_;
};

} // namespace lightwell
