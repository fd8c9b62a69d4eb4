#include "engine/base/threads.h"

#include "engine/base/tally.h"

#include <atomic>
#include <pmmintrin.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <xmmintrin.h>

namespace lightwell {
namespace {

class SubnormalsAreZero {
public:
    SubnormalsAreZero() : before_(_mm_getcsr())
    {
        _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
        _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
    }
    ~SubnormalsAreZero() { _mm_setcsr(before_); }
    SubnormalsAreZero(const SubnormalsAreZero&) = delete;
    SubnormalsAreZero& operator=(const SubnormalsAreZero&) = delete;

private:
    unsigned before_;
};

/// Adds up what single calls count, whichever thread makes them.
class SharedCounts {
public:
    void add(const RayCounts& counts) noexcept
    {
        followed_.fetch_add(counts.followed, std::memory_order_relaxed);
        shadow_.fetch_add(counts.shadow, std::memory_order_relaxed);
    }
    RayCounts sum() const noexcept { return {followed_, shadow_}; }

private:
    std::atomic<std::uint64_t> followed_{0}, shadow_{0};
};

} // namespace

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body)
{
    const RayCounts before = rays_of_thread;
    SharedCounts counts;
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    arena.execute([&] {
        tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
            const SubnormalsAreZero scope;
            const RayCounts start = rays_of_thread;
            body(i);
            counts.add(rays_of_thread - start);
        });
    });
    // The calling thread has made some of the calls itself: their rays are in the sum already.
    rays_of_thread = before;
    rays_of_thread += counts.sum();
}

} // namespace lightwell
