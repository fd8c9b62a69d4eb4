#pragma once

#include "engine/sampling/sobol.h"

namespace lightwell {

/// The random numbers of one path, in the order in which they are asked for.
class PathRandom {
public:
    PathRandom(std::uint64_t seed, std::uint64_t item, std::uint32_t index) noexcept
        : sequence_(seed, item), index_(index)
    {
    }
    UnitSquare pair() noexcept { return sequence_.pair(index_, dimension_++); }
    double one() noexcept { return sequence_.one(index_, dimension_++); }
    /// Points for one purpose, stratified among themselves and, when their number is the same on every path, over the
    /// paths of the item.
    void pairs(int count, UnitSquare* points) noexcept
    {
        sequence_.pairs(index_ * static_cast<std::uint32_t>(count), count, dimension_, points);
        ++dimension_;
    }

private:
    SampleSequence sequence_;
    std::uint32_t index_;
    std::uint32_t dimension_ = 0;
};

} // namespace lightwell
