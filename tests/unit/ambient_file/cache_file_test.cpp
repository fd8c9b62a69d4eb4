#include "engine/ambient/cache_file.h"
#include "engine/base/errors.h"
#include "tests/unit/ambient_file/cache_test_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <thread>

namespace lightwell {
namespace {

CacheIdentity identity_of(const std::string& accuracy = "0.1")
{
    CacheIdentity identity;
    identity.add_fingerprint("geometry", 42);
    identity.add_setting("ambient accuracy", accuracy);
    return identity;
}

std::string refusal(const std::filesystem::path& file, const CacheIdentity& identity)
{
    try {
        CacheFile cache(file, identity);
    } catch (const InputError& error) {
        return error.what();
    }
    return "opened";
}

/// Three blocks: 4, 0 and 2 numbers.
std::vector<CacheBlock> three_blocks()
{
    return {{1, 10, {1, -0.0, 3e300, 5e-324}}, {2, 11, {}}, {1, 12, {std::numeric_limits<double>::infinity(), 2}}};
}

/// A file with the three blocks; the sizes at which header and each block end.
std::vector<std::size_t> write_three(const ScratchFile& file)
{
    std::vector<std::size_t> ends;
    CacheFile cache(file.path, identity_of());
    ends.push_back(std::filesystem::file_size(file.path));
    for (const CacheBlock& block : three_blocks()) {
        cache.append(block.kind, block.key, block.numbers);
        ends.push_back(std::filesystem::file_size(file.path));
    }
    return ends;
}

std::vector<CacheBlock> first(std::size_t count)
{
    std::vector<CacheBlock> blocks = three_blocks();
    blocks.resize(count);
    return blocks;
}

TEST(CacheFile, WhatWasAddedIsReadBackByTheNextRun)
{
    const ScratchFile file("round");
    write_three(file);
    CacheFile cache(file.path, identity_of());
    EXPECT_EQ(cache.read_new(), three_blocks());
    EXPECT_TRUE(cache.read_new().empty());
    EXPECT_TRUE(cache.report().notes().empty());
}

TEST(CacheFile, TheBytesAreTheSameOnEveryMachine)
{
    const ScratchFile file("bytes");
    const std::vector<std::size_t> ends = write_three(file);
    const std::string bytes = file.bytes();
    EXPECT_EQ(bytes.substr(0, 16), std::string("LWCACHE\n\1\0\0\0\0\0\0\0", 16));
    EXPECT_NE(bytes.find("ambient%20accuracy 0.1\n"), std::string::npos) << "settings can be read in the file";
    // Words of the first block, least significant byte first: kind 1, key 10, 4 numbers, the first of them 1.0.
    EXPECT_EQ(bytes.substr(ends[0] + 8, 24), std::string("\1\0\0\0\0\0\0\0\n\0\0\0\0\0\0\0\4\0\0\0\0\0\0\0", 24));
    EXPECT_EQ(bytes.substr(ends[0] + 48, 8), std::string("\0\0\0\0\0\0\xF0\x3F", 8));
}

TEST(CacheFile, PatternsOfNaNAreKept)
{
    const ScratchFile file("nan");
    const double nan = std::nan("0x5ca1e");
    {
        CacheFile cache(file.path, identity_of());
        cache.append(1, 1, std::vector<double>{nan});
    }
    const std::vector<CacheBlock> read = CacheFile(file.path, identity_of()).read_new();
    ASSERT_EQ(read.size(), 1u);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(read[0].numbers[0]), std::bit_cast<std::uint64_t>(nan));
}

TEST(CacheFile, AWriterSeesOnlyWhatOthersAdd)
{
    const ScratchFile file("others");
    CacheFile mine(file.path, identity_of()), other(file.path, identity_of());
    mine.append(1, 1, std::vector<double>{1});
    other.append(1, 2, std::vector<double>{2});
    mine.append(1, 3, std::vector<double>{3});
    EXPECT_EQ(mine.read_new(), (std::vector<CacheBlock>{{1, 2, {2}}}));
    EXPECT_EQ(other.read_new(), (std::vector<CacheBlock>{{1, 1, {1}}, {1, 3, {3}}}));
    other.append(1, 4, std::vector<double>{4});
    EXPECT_EQ(mine.read_new(), (std::vector<CacheBlock>{{1, 4, {4}}}));
    EXPECT_TRUE(other.read_new().empty());
}

TEST(CacheFile, ThreadsOfOneProcessMayAddAtOnce)
{
    const ScratchFile file("threads");
    {
        CacheFile cache(file.path, identity_of());
        std::vector<std::thread> threads;
        for (std::uint64_t t = 0; t < 4; ++t)
            threads.emplace_back([&cache, t] {
                for (std::uint64_t i = 0; i < 100; ++i)
                    cache.append(t, i, std::vector<double>(i, static_cast<double>(t)));
            });
        for (std::thread& thread : threads)
            thread.join();
    }
    std::vector<std::uint64_t> next(4, 0);
    for (const CacheBlock& block : CacheFile(file.path, identity_of()).read_new()) {
        EXPECT_EQ(block.key, next.at(block.kind)++);
        EXPECT_EQ(block.numbers, std::vector<double>(block.key, static_cast<double>(block.kind)));
    }
    EXPECT_EQ(next, (std::vector<std::uint64_t>(4, 100)));
}

TEST(CacheFile, OneOfAnotherSceneOrOtherSettingsIsRefusedWithWhatChanged)
{
    const ScratchFile file("stale");
    write_three(file);
    CacheIdentity other = identity_of("0.05");
    EXPECT_EQ(refusal(file.path, other), file.path.string() +
                                             ": holds light of another scene or other settings: ambient accuracy was "
                                             "0.1, is 0.05; delete the file, or give another name");
    other.lines.clear();
    other.add_fingerprint("geometry", 43);
    other.add_setting("ambient accuracy", "0.1");
    EXPECT_NE(refusal(file.path, other).find("geometry changed;"), std::string::npos);
    EXPECT_EQ(CacheFile(file.path, identity_of()).read_new(), three_blocks()) << "a refusal must not touch the file";
}

TEST(CacheFile, WhatIsNoCacheIsRefusedAndLeftAsItWas)
{
    const ScratchFile file("foreign");
    for (const std::string& bytes : {std::string("x"), std::string("v 0 0 0\n"), std::string(100000, '\0'),
                                     std::string("LWCACHE\n\2\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 24),
                                     "LWCACHE\n" + std::string("\1\0\0\0\0\0\0\0", 8) + std::string(80, '\xFF')}) {
        file.put(bytes);
        EXPECT_EQ(refusal(file.path, identity_of()).find(file.path.string() + ": is "), 0u) << bytes.size();
        EXPECT_EQ(file.bytes(), bytes);
    }
    EXPECT_NE(refusal("/", identity_of()), "opened");
    EXPECT_NE(refusal("/dev/null", identity_of()), "opened");
    EXPECT_NE(refusal("/nowhere/at/all.amb", identity_of()), "opened");
}

TEST(CacheFile, CutAtAnyByteItKeepsEveryWholeBlockAndGoesOn)
{
    const ScratchFile whole("whole"), cut("cut");
    const std::vector<std::size_t> ends = write_three(whole);
    const std::string bytes = whole.bytes();
    for (std::size_t size = 0; size <= bytes.size(); ++size) {
        SCOPED_TRACE(size);
        cut.put(bytes.substr(0, size));
        std::size_t kept = 0;
        while (kept < 3 && ends[kept + 1] <= size)
            ++kept;
        std::vector<CacheBlock> expected = first(kept);
        CacheFile reader(cut.path, identity_of());
        EXPECT_EQ(reader.read_new(), expected);
        CacheFile writer(cut.path, identity_of());
        writer.append(9, 9, std::vector<double>{9});
        EXPECT_EQ(reader.read_new(), (std::vector<CacheBlock>{{9, 9, {9}}})) << "the reader goes on past the repair";
        expected.push_back({9, 9, {9}});
        CacheFile later(cut.path, identity_of());
        EXPECT_EQ(later.read_new(), expected);
        EXPECT_TRUE(later.report().notes().empty()) << "what was unfinished is gone";
        const bool torn = size > ends[0] && std::find(ends.begin(), ends.end(), size) == ends.end();
        EXPECT_EQ(writer.report().has(Finding::repaired), torn);
    }
}

TEST(CacheFile, AnyFlippedByteIsNoticedAndCostsOneBlockAtMost)
{
    const ScratchFile whole("intact"), bad("flipped");
    const std::vector<std::size_t> ends = write_three(whole);
    const std::string bytes = whole.bytes();
    for (std::size_t at = 0; at < bytes.size(); ++at) {
        for (const char flip : {'\x01', '\x80', '\xFF'}) {
            SCOPED_TRACE(at);
            std::string changed = bytes;
            changed[at] = static_cast<char>(changed[at] ^ flip);
            bad.put(changed);
            if (at < ends[0]) {
                EXPECT_NE(refusal(bad.path, identity_of()), "opened");
                continue;
            }
            const auto hit =
                static_cast<std::ptrdiff_t>(std::upper_bound(ends.begin(), ends.end(), at) - ends.begin()) - 1;
            std::vector<CacheBlock> expected = three_blocks();
            expected.erase(expected.begin() + hit);
            CacheFile cache(bad.path, identity_of());
            EXPECT_EQ(cache.read_new(), expected);
            cache.append(9, 9, std::vector<double>{9});
            EXPECT_FALSE(cache.report().notes().empty());
            expected.push_back({9, 9, {9}});
            EXPECT_EQ(CacheFile(bad.path, identity_of()).read_new(), expected);
        }
    }
}

TEST(CacheFile, AbsurdSizesAreNotTrusted)
{
    const ScratchFile file("absurd");
    write_three(file);
    // A header whose own checksum is right but which promises more than a file can hold.
    const CacheIdentity identity = identity_of();
    std::vector<char> header = encode_block(1, 1, {}, fingerprint(identity));
    for (const std::uint64_t count : {std::uint64_t{1} << 22, std::uint64_t{1} << 61, ~std::uint64_t{0}}) {
        put_word(header.data() + 24, count);
        put_word(header.data() + 40, checksum(header.data(), 40, fingerprint(identity)));
        const std::string before = file.bytes();
        file.put(before + std::string(header.begin(), header.end()) + "some");
        CacheFile cache(file.path, identity);
        EXPECT_EQ(cache.read_new(), three_blocks());
        file.put(before);
    }
}

TEST(CacheFile, BlocksOfAnotherCacheCopiedBehindAreNotTaken)
{
    const ScratchFile file("own"), foreign("foreign_blocks");
    write_three(file);
    {
        CacheFile other(foreign.path, identity_of("0.2"));
        other.append(1, 77, std::vector<double>{7});
    }
    file.put(file.bytes() + foreign.bytes());
    EXPECT_EQ(CacheFile(file.path, identity_of()).read_new(), three_blocks());
}

TEST(CacheFile, AFileThatShrinksInUseIsAnErrorNotACrash)
{
    const ScratchFile file("shrinks");
    write_three(file);
    CacheFile cache(file.path, identity_of());
    cache.read_new();
    std::filesystem::resize_file(file.path, 40);
    EXPECT_THROW(cache.read_new(), InputError);
    EXPECT_THROW(cache.append(1, 1, std::vector<double>{1}), InputError);
}

} // namespace
} // namespace lightwell
