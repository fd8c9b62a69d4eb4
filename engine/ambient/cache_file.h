#pragma once

#include "engine/ambient/cache_block.h"
#include "engine/ambient/cache_identity.h"
#include "engine/base/report.h"

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace lightwell {

/// A cache of light on disk that grows only at its end and that any number of processes read and write at once.
///
/// A header says whose light it is; blocks follow, each with a checksum, each written whole under an exclusive lock
/// (flock). What a killed writer left unfinished is removed by the next writer; nothing else is ever changed.
/// Nothing is forced to the disk except by sync(): a killed process loses at most the block it was writing, a power
/// failure what the system had not written yet, which the checksums tell.
/// Portable: the same bytes on every machine. Threads may share one object; a forked child opens the file anew.
class CacheFile {
public:
    /// Opens the file, or makes it when there is none or an empty one.
    /// @throws InputError naming the file when it is no cache, damaged at its beginning, unreadable, or belongs to
    ///         another scene or other settings: then with what changed
    CacheFile(const std::filesystem::path& file, const CacheIdentity& identity);
    ~CacheFile();
    CacheFile(const CacheFile&) = delete;
    CacheFile& operator=(const CacheFile&) = delete;

    /// Blocks that were added since the last call (the first: all), in the order of the file, without those that
    /// this object added itself. Damaged blocks are left out and counted in report().
    /// @throws InputError when the file cannot be read or has become shorter
    std::vector<CacheBlock> read_new();
    /// Adds one block behind those of all processes.
    /// @param numbers  at most most_numbers_in_block
    /// @throws InputError when it cannot be written (disk full); the file is then as it was
    void append(std::uint64_t kind, std::uint64_t key, std::span<const double> numbers);
    /// Forces to the disk what was added.
    void sync();
    /// Blocks found damaged, unfinished blocks removed.
    Report report() const;

private:
    /// What stands at a place of the file.
    struct Found {
        enum class What { block, unfinished, end } what;
        std::uint64_t at = 0;
        BlockHeader header = {};
    };
    void check_or_make_header();
    std::uint64_t size() const;
    void read_bytes(char* bytes, std::size_t count, std::uint64_t at) const;
    void write_bytes(const std::vector<char>& bytes, std::uint64_t old_size);
    Found next_block(std::uint64_t from, std::uint64_t end);
    std::uint64_t next_marker(std::uint64_t from, std::uint64_t end) const;
    void remove_unfinished();
    [[noreturn]] void fail(const std::string& what, const std::string& way_out) const;

    std::filesystem::path file_;
    CacheIdentity identity_;
    std::uint64_t owner_; ///< fingerprint of the identity
    int descriptor_ = -1;
    std::uint64_t checked_ = 0;     ///< up to here blocks follow one another without a gap at the end
    std::uint64_t read_ = 0;        ///< up to here they were returned
    std::uint64_t counted_gap_ = 0; ///< damage before this place stands in the report
    std::set<std::uint64_t> own_;   ///< where blocks of this object begin that read_new() has not passed
    Report report_;
    mutable std::mutex mutex_;
};

} // namespace lightwell
