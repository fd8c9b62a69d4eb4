#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace lightwell {

/// Records that were added together. What kind and key mean, and how many numbers a record takes, is the writer's.
struct CacheBlock {
    std::uint64_t kind = 0;
    std::uint64_t key = 0;
    std::vector<double> numbers; ///< bit patterns are kept, also of NaN

    bool operator==(const CacheBlock&) const = default;
};

/// Upper bound of the numbers in one block (32 MiB): what a file says beyond that is damage.
inline constexpr std::size_t most_numbers_in_block = std::size_t{1} << 22;

/// Words of eight bytes, little-endian, in front of the numbers of each block.
inline constexpr std::size_t block_header_bytes = 48;

/// A 64-bit checksum; bytes beyond the last whole word count as a word filled up with zeros, and the length counts.
/// Any change within one aligned word of eight bytes changes it.
std::uint64_t checksum(const char* bytes, std::size_t size, std::uint64_t seed) noexcept;

/// What the header of a block says, after its own checksum has been found right.
struct BlockHeader {
    std::uint64_t kind = 0, key = 0;
    std::size_t count = 0; ///< numbers that follow, at most most_numbers_in_block
    std::uint64_t payload_checksum = 0;

    std::size_t payload_bytes() const noexcept { return 8 * count; }
    std::size_t block_bytes() const noexcept { return block_header_bytes + payload_bytes(); }
};

/// Blocks as bytes that are the same on every machine: little-endian words, IEEE doubles.
/// @param owner  fingerprint of the file's identity: blocks of another file are not taken for this one's
std::vector<char> encode_block(std::uint64_t kind, std::uint64_t key, std::span<const double> numbers,
                               std::uint64_t owner);
/// @return nothing unless the bytes begin with an undamaged header of a block of this owner
std::optional<BlockHeader> decode_block_header(std::span<const char, block_header_bytes> bytes, std::uint64_t owner);
/// @param payload  as many bytes as the header says
/// @return nothing when the checksum differs
std::optional<CacheBlock> decode_block(const BlockHeader& header, std::span<const char> payload, std::uint64_t owner);
/// The bytes with which every block begins, for finding the next one after a damaged place.
std::array<char, 8> block_marker() noexcept;

/// A word as eight bytes, least significant first, whatever the machine's order.
void put_word(char* bytes, std::uint64_t word) noexcept;
std::uint64_t get_word(const char* bytes) noexcept;

} // namespace lightwell
