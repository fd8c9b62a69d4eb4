#include "engine/ambient/cache_file.h"
#include "engine/base/random.h"
#include "tests/unit/ambient_file/cache_test_files.h"

#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <sys/mman.h>
#include <sys/wait.h>

namespace lightwell {
namespace {

constexpr int writers = 8, killed = 3, blocks_each = 60;
/// Up to 240 kB, so that a write takes many pages and a kill often falls into one.
constexpr double most_numbers = 30000;

CacheIdentity identity()
{
    CacheIdentity identity;
    identity.add_fingerprint("geometry", 42);
    return identity;
}

/// What writer w adds as its k-th block.
std::vector<double> numbers_of(std::uint64_t w, std::uint64_t k)
{
    RandomStream random(5, w, k);
    std::vector<double> numbers(1 + static_cast<std::size_t>(most_numbers * random.next()));
    for (double& number : numbers)
        number = random.next();
    return numbers;
}

/// Blocks whose append() has returned, by writer; shared between the processes.
class SharedCounts {
public:
    SharedCounts()
        : counts_(static_cast<std::atomic<int>*>(
              mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)))
    {
    }
    ~SharedCounts() { munmap(counts_, 4096); }
    SharedCounts(const SharedCounts&) = delete;
    SharedCounts& operator=(const SharedCounts&) = delete;
    std::atomic<int>& operator[](int writer) const { return counts_[writer]; }

private:
    std::atomic<int>* counts_;
};

[[noreturn]] void write_all(const std::filesystem::path& file, int writer, const SharedCounts& done)
{
    try {
        CacheFile cache(file, identity());
        for (int k = 0; k < blocks_each; ++k) {
            const auto w = static_cast<std::uint64_t>(writer), key = static_cast<std::uint64_t>(k);
            cache.append(w, key, numbers_of(w, key));
            done[writer] = k + 1;
            if (k % 16 == 0)
                cache.read_new();
        }
    } catch (const std::exception& error) {
        std::fprintf(stderr, "writer %d: %s\n", writer, error.what());
        _exit(1);
    }
    _exit(0);
}

/// Starts the writers, kills the first few each at a moment of its own, waits for the others.
void run_writers(const std::filesystem::path& file, const SharedCounts& done, std::uint64_t round)
{
    pid_t pids[writers];
    for (int w = 0; w < writers; ++w) {
        pids[w] = fork();
        ASSERT_GE(pids[w], 0);
        if (pids[w] == 0)
            write_all(file, w, done);
    }
    RandomStream random(17, round, 0);
    for (int w = 0; w < killed; ++w) {
        const int at = static_cast<int>(random.next() * blocks_each / 2);
        for (int waited_ms = 0; done[w] < at && waited_ms < 60000; ++waited_ms)
            usleep(1000);
        usleep(static_cast<useconds_t>(3000 * random.next()));
        kill(pids[w], SIGKILL);
    }
    for (int w = 0; w < writers; ++w) {
        int status = 0;
        ASSERT_EQ(waitpid(pids[w], &status, 0), pids[w]);
        const bool finished = WIFEXITED(status) && WEXITSTATUS(status) == 0;
        // A kill may come after the last block and before the end of the process, or too late.
        EXPECT_TRUE(finished || (w < killed && WIFSIGNALED(status))) << w;
        if (finished) {
            EXPECT_EQ(done[w], blocks_each) << w;
        }
    }
}

/// Every block of a writer is there in its order, and of a killed one all but at most the one it was writing.
void expect_all_blocks(const std::vector<CacheBlock>& blocks, const SharedCounts& done)
{
    std::vector<int> found(writers, 0);
    for (const CacheBlock& block : blocks) {
        ASSERT_LT(block.kind, static_cast<std::uint64_t>(writers));
        ASSERT_EQ(block.key, static_cast<std::uint64_t>(found[block.kind]++));
        ASSERT_EQ(block.numbers, numbers_of(block.kind, block.key));
    }
    for (int w = 0; w < writers; ++w) {
        EXPECT_GE(found[w], done[w]) << "writer " << w;
        EXPECT_LE(found[w], done[w] + (w < killed ? 1 : 0)) << "writer " << w;
    }
}

TEST(CacheWriters, EightAtOnceWithThreeKilledLeaveAValidFileWithEveryFinishedBlock)
{
    for (std::uint64_t round = 0; round < 6; ++round) {
        SCOPED_TRACE(round);
        const ScratchFile file("writers");
        const SharedCounts done;
        run_writers(file.path, done, round);
        {
            CacheFile repairing(file.path, identity());
            repairing.append(writers, 0, {});
        }
        CacheFile cache(file.path, identity());
        std::vector<CacheBlock> blocks = cache.read_new();
        EXPECT_TRUE(cache.report().notes().empty()) << "nothing damaged or unfinished is left";
        ASSERT_FALSE(blocks.empty());
        EXPECT_EQ(blocks.back().kind, static_cast<std::uint64_t>(writers));
        blocks.pop_back();
        expect_all_blocks(blocks, done);
    }
}

TEST(CacheWriters, AllWritersKilledAtOnceLoseOnlyTheirUnwrittenBlocks)
{
    const ScratchFile file("all_killed");
    const SharedCounts done;
    pid_t pids[writers];
    for (int w = 0; w < writers; ++w)
        if ((pids[w] = fork()) == 0)
            write_all(file.path, w, done);
    for (int waited_ms = 0; done[0] < 5 && waited_ms < 60000; ++waited_ms)
        usleep(1000);
    for (const pid_t pid : pids)
        kill(pid, SIGKILL);
    for (const pid_t pid : pids)
        waitpid(pid, nullptr, 0);
    std::vector<int> found(writers, 0);
    CacheFile cache(file.path, identity());
    for (const CacheBlock& block : cache.read_new())
        ASSERT_EQ(block.key, static_cast<std::uint64_t>(found[block.kind]++));
    for (int w = 0; w < writers; ++w)
        EXPECT_TRUE(found[w] == done[w] || found[w] == done[w] + 1) << w << ": " << found[w] << " of " << done[w];
}

/// Kills a writer of one large block while its file has grown to more than nothing and less than all of it.
/// @return true when the block was indeed left unfinished
bool kill_within_a_write(const std::filesystem::path& file, std::uintmax_t header_bytes)
{
    constexpr std::size_t large = 3'000'000;
    const pid_t pid = fork();
    if (pid == 0) {
        CacheFile(file, identity()).append(1, 1, std::vector<double>(large, 0.5));
        _exit(0);
    }
    const auto all = header_bytes + block_header_bytes + 8 * large;
    for (int polls = 0; polls < 10'000'000 && std::filesystem::file_size(file) == header_bytes; ++polls) {
    }
    kill(pid, SIGKILL);
    waitpid(pid, nullptr, 0);
    const auto size = std::filesystem::file_size(file);
    return size > header_bytes && size < all;
}

TEST(CacheWriters, ABlockTornByAKillIsRemovedByTheNextWriterAndNothingElse)
{
    const ScratchFile file("torn");
    bool torn = false;
    for (int attempt = 0; attempt < 20 && !torn; ++attempt) {
        std::filesystem::remove(file.path);
        CacheFile(file.path, identity());
        const auto header_bytes = std::filesystem::file_size(file.path);
        torn = kill_within_a_write(file.path, header_bytes);
    }
    if (!torn)
        GTEST_SKIP() << "this system finishes every write before a process ends";
    CacheFile reader(file.path, identity()), next(file.path, identity());
    EXPECT_TRUE(reader.read_new().empty());
    next.append(2, 2, std::vector<double>{2});
    EXPECT_TRUE(next.report().has(Finding::repaired));
    EXPECT_EQ(reader.read_new(), (std::vector<CacheBlock>{{2, 2, {2}}}));
}

} // namespace
} // namespace lightwell
