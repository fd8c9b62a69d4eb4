#pragma once

#include <cstddef>
#include <functional>

namespace lightwell {

/// Calls body(i) for every i in [0, count), on `threads` threads (0: all processors), in any order.
/// Subnormal numbers count as zero while it runs, on every thread alike, so that results do not depend on the
/// thread. Rays that the calls follow count for the calling thread (tally.h). The first exception that a call throws is
/// thrown here, after the running calls have ended.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body);

} // namespace lightwell
