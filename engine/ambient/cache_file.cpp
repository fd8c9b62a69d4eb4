#include "engine/ambient/cache_file.h"

#include "engine/base/errors.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace lightwell {
namespace {

constexpr std::string_view magic = "LWCACHE\n";
constexpr std::uint64_t format_version = 1;
/// Magic, version, length of the text.
constexpr std::size_t header_start_bytes = 24;
/// A scene of a million materials; more is damage.
constexpr std::uint64_t most_header_text = std::uint64_t{1} << 27;
constexpr const char* delete_or_choose = "delete the file, or give another name";

constexpr std::uint64_t padded(std::uint64_t bytes)
{
    return (bytes + 7) / 8 * 8;
}

/// The lock on the file for as long as it lives; waits for other processes.
class FileLock {
public:
    FileLock(int descriptor, int kind, const std::filesystem::path& file) : descriptor_(descriptor)
    {
        while (flock(descriptor_, kind) != 0)
            if (errno != EINTR)
                throw InputError(file.string(), std::string("cannot be locked: ") + std::strerror(errno),
                                 "keep the cache on a local disk");
    }
    ~FileLock() { flock(descriptor_, LOCK_UN); }
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;

private:
    int descriptor_;
};

std::vector<char> header_bytes(const CacheIdentity& identity)
{
    const std::string text = to_text(identity);
    std::vector<char> bytes(header_start_bytes + padded(text.size()) + 8);
    std::copy(magic.begin(), magic.end(), bytes.begin());
    put_word(bytes.data() + 8, format_version);
    put_word(bytes.data() + 16, text.size());
    std::copy(text.begin(), text.end(), bytes.begin() + header_start_bytes);
    put_word(bytes.data() + bytes.size() - 8, checksum(bytes.data(), bytes.size() - 8, 0));
    return bytes;
}

int open_descriptor(const std::filesystem::path& file)
{
    const int descriptor = open(file.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NONBLOCK, 0666);
    if (descriptor < 0)
        throw InputError(file.string(), std::string("cannot be opened as a cache: ") + std::strerror(errno),
                         "check folder and rights");
    struct stat status {};
    if (fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) {
        close(descriptor);
        throw InputError(file.string(), "is not a regular file", "give the name of a file for the cache");
    }
    return descriptor;
}

} // namespace

CacheFile::CacheFile(const std::filesystem::path& file, const CacheIdentity& identity)
    : file_(file), identity_(identity), owner_(fingerprint(identity)), descriptor_(open_descriptor(file))
{
    try {
        const FileLock lock(descriptor_, LOCK_EX, file_);
        check_or_make_header();
    } catch (...) {
        close(descriptor_);
        throw;
    }
}

CacheFile::~CacheFile()
{
    close(descriptor_);
}

void CacheFile::fail(const std::string& what, const std::string& way_out) const
{
    throw InputError(file_.string(), what, way_out);
}

std::uint64_t CacheFile::size() const
{
    struct stat status {};
    if (fstat(descriptor_, &status) != 0)
        fail(std::string("cannot be read: ") + std::strerror(errno), {});
    const auto bytes = static_cast<std::uint64_t>(status.st_size);
    if (bytes < checked_)
        fail("has become shorter while in use",
             "do not change it while programs run; " + std::string(delete_or_choose));
    return bytes;
}

void CacheFile::read_bytes(char* bytes, std::size_t count, std::uint64_t at) const
{
    for (std::size_t done = 0; done < count;) {
        const ssize_t now = pread(descriptor_, bytes + done, count - done, static_cast<off_t>(at + done));
        if (now < 0 && errno == EINTR)
            continue;
        if (now <= 0)
            fail(std::string("cannot be read: ") + (now < 0 ? std::strerror(errno) : "it has become shorter"), {});
        done += static_cast<std::size_t>(now);
    }
}

/// All or nothing as far as this process lives; the caller holds the exclusive lock.
void CacheFile::write_bytes(const std::vector<char>& bytes, std::uint64_t old_size)
{
    for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t now = write(descriptor_, bytes.data() + done, bytes.size() - done);
        if (now < 0 && errno == EINTR)
            continue;
        if (now <= 0) {
            const std::string why = std::strerror(errno);
            const bool restored = ftruncate(descriptor_, static_cast<off_t>(old_size)) == 0;
            fail("cannot be written: " + why, restored ? "make room; what it held is kept" : "make room");
        }
        done += static_cast<std::size_t>(now);
    }
}

/// The caller holds the exclusive lock, so that one of several new users makes the header.
void CacheFile::check_or_make_header()
{
    const std::vector<char> wanted = header_bytes(identity_);
    const std::uint64_t bytes = size();
    std::vector<char> found(static_cast<std::size_t>(std::min<std::uint64_t>(bytes, wanted.size())));
    read_bytes(found.data(), found.size(), 0);
    if (found == wanted) {
        checked_ = read_ = counted_gap_ = wanted.size();
        return;
    }
    const bool made_by_killed = bytes < wanted.size() && std::equal(found.begin(), found.end(), wanted.begin());
    if (made_by_killed) { // or empty
        if (ftruncate(descriptor_, 0) != 0)
            fail(std::string("cannot be written: ") + std::strerror(errno), {});
        write_bytes(wanted, 0);
        checked_ = read_ = counted_gap_ = wanted.size();
        return;
    }
    if (found.size() < header_start_bytes || !std::equal(magic.begin(), magic.end(), found.begin()))
        fail("is not a cache of light", delete_or_choose);
    if (get_word(found.data() + 8) != format_version)
        fail("is a cache of format " + std::to_string(get_word(found.data() + 8)) + ", expected " +
                 std::to_string(format_version),
             delete_or_choose);
    const std::uint64_t text_size = get_word(found.data() + 16);
    if (text_size > most_header_text || header_start_bytes + padded(text_size) + 8 > bytes)
        fail("is damaged or unfinished: its header ends early", delete_or_choose);
    found.resize(static_cast<std::size_t>(header_start_bytes + padded(text_size) + 8));
    read_bytes(found.data(), found.size(), 0);
    if (get_word(found.data() + found.size() - 8) != checksum(found.data(), found.size() - 8, 0))
        fail("is damaged: the checksum of its header differs", delete_or_choose);
    const auto text = found.begin() + header_start_bytes;
    const CacheIdentity stored = parse_cache_identity({text, text + static_cast<std::ptrdiff_t>(text_size)});
    fail("holds light of another scene or other settings: " + differences(stored, identity_), delete_or_choose);
}

/// Where the next marker begins at or after `from`; `end` when there is none.
std::uint64_t CacheFile::next_marker(std::uint64_t from, std::uint64_t end) const
{
    const auto marker = block_marker();
    std::vector<char> window(std::size_t{1} << 16);
    while (from + marker.size() <= end) {
        const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(window.size(), end - from));
        read_bytes(window.data(), count, from);
        const auto last = window.begin() + static_cast<std::ptrdiff_t>(count);
        const auto found = std::search(window.begin(), last, marker.begin(), marker.end());
        if (found != last)
            return from + static_cast<std::uint64_t>(found - window.begin());
        from += count - (marker.size() - 1);
    }
    return end;
}

/// The first whole block at or after `from`, past damaged places; else whether bytes of an unfinished one remain.
CacheFile::Found CacheFile::next_block(std::uint64_t from, std::uint64_t end)
{
    std::uint64_t at = from;
    while (at + block_header_bytes <= end) {
        char bytes[block_header_bytes];
        read_bytes(bytes, sizeof bytes, at);
        const auto header = decode_block_header(std::span<const char, block_header_bytes>(bytes), owner_);
        if (header && at + header->block_bytes() <= end) {
            if (at > from && at > counted_gap_) {
                report_.add(Finding::ignored, file_.string(), "a damaged place between blocks was passed over");
                counted_gap_ = at;
            }
            return {Found::What::block, at, *header};
        }
        at = next_marker(at + 1, end);
    }
    return {from < end ? Found::What::unfinished : Found::What::end, from, {}};
}

std::vector<CacheBlock> CacheFile::read_new()
{
    const std::lock_guard guard(mutex_);
    const FileLock lock(descriptor_, LOCK_SH, file_);
    const std::uint64_t end = size();
    std::vector<CacheBlock> blocks;
    std::vector<char> payload;
    for (Found found = next_block(read_, end); found.what == Found::What::block; found = next_block(read_, end)) {
        read_ = found.at + found.header.block_bytes();
        checked_ = std::max(checked_, read_);
        if (own_.erase(found.at) > 0)
            continue;
        payload.resize(found.header.payload_bytes());
        read_bytes(payload.data(), payload.size(), found.at + block_header_bytes);
        std::optional<CacheBlock> block = decode_block(found.header, payload, owner_);
        if (block)
            blocks.push_back(std::move(*block));
        else
            report_.add(Finding::ignored, file_.string(), "a block whose checksum differs was left out");
    }
    return blocks;
}

/// Brings the end of the file to the end of its last whole block; the caller holds the exclusive lock.
void CacheFile::remove_unfinished()
{
    const std::uint64_t end = size();
    Found found = next_block(checked_, end);
    for (; found.what == Found::What::block; found = next_block(checked_, end))
        checked_ = found.at + found.header.block_bytes();
    if (found.what == Found::What::end)
        return;
    if (ftruncate(descriptor_, static_cast<off_t>(found.at)) != 0)
        fail(std::string("cannot be repaired: ") + std::strerror(errno), delete_or_choose);
    report_.add(Finding::repaired, file_.string(), "an unfinished block of an interrupted writer was removed");
}

void CacheFile::append(std::uint64_t kind, std::uint64_t key, std::span<const double> numbers)
{
    const std::vector<char> bytes = encode_block(kind, key, numbers, owner_);
    const std::lock_guard guard(mutex_);
    const FileLock lock(descriptor_, LOCK_EX, file_);
    remove_unfinished();
    write_bytes(bytes, checked_);
    own_.insert(checked_);
    checked_ += bytes.size();
}

void CacheFile::sync()
{
    if (fsync(descriptor_) != 0)
        fail(std::string("cannot be forced to the disk: ") + std::strerror(errno), {});
}

Report CacheFile::report() const
{
    const std::lock_guard guard(mutex_);
    return report_;
}

} // namespace lightwell
