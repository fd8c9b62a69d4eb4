#pragma once

#include <cstdint>

namespace lightwell {

/// Rays that were followed: what work is counted in where it must be the same on every machine.
struct RayCounts {
    std::uint64_t followed = 0; ///< to the first surface that they meet
    std::uint64_t shadow = 0;   ///< to a source

    std::uint64_t total() const noexcept { return followed + shadow; }
    RayCounts& operator+=(const RayCounts& other) noexcept
    {
        followed += other.followed;
        shadow += other.shadow;
        return *this;
    }
    RayCounts operator-(const RayCounts& other) const noexcept
    {
        return {followed - other.followed, shadow - other.shadow};
    }
    bool operator==(const RayCounts&) const noexcept = default;
};

/// Rays of the calling thread since it began, and those that parallel_for() followed for it on other threads: the
/// difference of two readings is the work in between, the same for any number of threads.
constinit inline thread_local RayCounts rays_of_thread;

/// Rays of one stage of a run after the other, on the thread that runs it.
class RayLaps {
public:
    /// Those since the last call, or since this object was made.
    RayCounts next() noexcept
    {
        const RayCounts lap = rays_of_thread - last_;
        last_ = rays_of_thread;
        return lap;
    }

private:
    RayCounts last_ = rays_of_thread;
};

} // namespace lightwell
