#include "engine/ambient/cache_block.h"

#include "engine/base/random.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace lightwell {
namespace {

/// No text, no plausible double (about -1.4e-91), both ends odd: never in a payload by chance.
constexpr std::uint64_t marker_word = 0xAD1B0C4B1EE1C0DFu;

enum HeaderWord { at_marker, at_kind, at_key, at_count, at_payload, at_header };
constexpr std::size_t checked_bytes = 8 * at_header;

std::uint64_t header_word(std::span<const char, block_header_bytes> bytes, HeaderWord word) noexcept
{
    return get_word(bytes.data() + 8 * word);
}

} // namespace

void put_word(char* bytes, std::uint64_t word) noexcept
{
    for (int i = 0; i < 8; ++i)
        bytes[i] = static_cast<char>(word >> (8 * i) & 0xFF);
}

std::uint64_t get_word(const char* bytes) noexcept
{
    std::uint64_t word = 0;
    for (int i = 0; i < 8; ++i)
        word |= std::uint64_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
    return word;
}

std::uint64_t checksum(const char* bytes, std::size_t size, std::uint64_t seed) noexcept
{
    std::uint64_t state = mix_bits(seed, size);
    for (; size >= 8; bytes += 8, size -= 8)
        state = mix_bits(state, get_word(bytes));
    if (size > 0) {
        char last[8] = {};
        std::copy_n(bytes, size, last);
        state = mix_bits(state, get_word(last));
    }
    return state;
}

std::vector<char> encode_block(std::uint64_t kind, std::uint64_t key, std::span<const double> numbers,
                               std::uint64_t owner)
{
    assert(numbers.size() <= most_numbers_in_block);
    std::vector<char> bytes(block_header_bytes + 8 * numbers.size());
    char* const payload = bytes.data() + block_header_bytes;
    for (std::size_t i = 0; i < numbers.size(); ++i)
        put_word(payload + 8 * i, std::bit_cast<std::uint64_t>(numbers[i]));
    const auto set = [&](HeaderWord word, std::uint64_t value) { put_word(bytes.data() + 8 * word, value); };
    set(at_marker, marker_word);
    set(at_kind, kind);
    set(at_key, key);
    set(at_count, numbers.size());
    set(at_payload, checksum(payload, 8 * numbers.size(), owner));
    set(at_header, checksum(bytes.data(), checked_bytes, owner));
    return bytes;
}

std::optional<BlockHeader> decode_block_header(std::span<const char, block_header_bytes> bytes, std::uint64_t owner)
{
    if (header_word(bytes, at_marker) != marker_word ||
        header_word(bytes, at_header) != checksum(bytes.data(), checked_bytes, owner) ||
        header_word(bytes, at_count) > most_numbers_in_block)
        return std::nullopt;
    return BlockHeader{header_word(bytes, at_kind), header_word(bytes, at_key),
                       static_cast<std::size_t>(header_word(bytes, at_count)), header_word(bytes, at_payload)};
}

std::optional<CacheBlock> decode_block(const BlockHeader& header, std::span<const char> payload, std::uint64_t owner)
{
    assert(payload.size() == header.payload_bytes());
    if (checksum(payload.data(), payload.size(), owner) != header.payload_checksum)
        return std::nullopt;
    CacheBlock block{header.kind, header.key, std::vector<double>(header.count)};
    for (std::size_t i = 0; i < header.count; ++i)
        block.numbers[i] = std::bit_cast<double>(get_word(payload.data() + 8 * i));
    return block;
}

std::array<char, 8> block_marker() noexcept
{
    std::array<char, 8> bytes{};
    put_word(bytes.data(), marker_word);
    return bytes;
}

} // namespace lightwell
