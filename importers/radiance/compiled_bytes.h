#pragma once

#include "engine/base/errors.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <ostream>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

/// \file Bytes of a compiled scene, written and read in order.
namespace lightwell::scene_text {

static_assert(std::endian::native == std::endian::little, "arrays are kept as they lie in memory, little-endian");

inline constexpr std::string_view compiled_mark = "LWscene\n";
inline constexpr std::string_view compiled_end = "LWend..\n";
inline constexpr std::uint32_t compiled_version = 2;

/// A checksum over bytes that come in pieces; the sum depends on their order.
class ByteSum {
public:
    void add(const void* data, std::size_t size) noexcept
    {
        const auto* bytes = static_cast<const unsigned char*>(data);
        for (; filled_ != 0 && size > 0; --size)
            put(*bytes++);
        for (; size >= sizeof(std::uint64_t); size -= sizeof(std::uint64_t), bytes += sizeof(std::uint64_t)) {
            std::uint64_t word;
            std::memcpy(&word, bytes, sizeof word);
            mix(word);
        }
        for (; size > 0; --size)
            put(*bytes++);
    }
    std::uint64_t sum() const noexcept { return (state_ ^ partial_ ^ (state_ >> 29)) * 0x9e3779b97f4a7c15u + filled_; }

private:
    void put(unsigned char byte) noexcept
    {
        partial_ |= static_cast<std::uint64_t>(byte) << (8 * filled_);
        if (++filled_ == sizeof partial_) {
            mix(partial_);
            partial_ = 0;
            filled_ = 0;
        }
    }
    void mix(std::uint64_t word) noexcept { state_ = std::rotl((state_ ^ word) * 0xff51afd7ed558ccdu, 31); }

    std::uint64_t state_ = 0x6c77656c6c, partial_ = 0;
    unsigned filled_ = 0;
};

class ByteWriter {
public:
    explicit ByteWriter(std::ostream& out) : out_(out) {}
    void bytes(const void* data, std::size_t size)
    {
        out_.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
        sum_.add(data, size);
        size_ += size;
    }
    template <class T>
    void value(const T& value)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        bytes(&value, sizeof value);
    }
    template <class T>
    void array(const std::vector<T>& values)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        value(static_cast<std::uint64_t>(values.size()));
        bytes(values.data(), values.size() * sizeof(T));
    }
    void text(std::string_view text)
    {
        value(static_cast<std::uint64_t>(text.size()));
        bytes(text.data(), text.size());
    }
    std::uint64_t sum() const noexcept { return sum_.sum(); }
    std::uint64_t size() const noexcept { return size_; }

private:
    std::ostream& out_;
    ByteSum sum_;
    std::uint64_t size_ = 0;
};

class ByteReader {
public:
    ByteReader(std::string_view bytes, const std::string& place) : rest_(bytes), place_(place) {}
    std::string_view bytes(std::uint64_t size)
    {
        if (size > rest_.size())
            throw InputError{place_, "the compiled scene is cut off or damaged", "compile it again with oconv"};
        const std::string_view piece = rest_.substr(0, size);
        rest_.remove_prefix(size);
        return piece;
    }
    template <class T>
    T value()
    {
        T value;
        std::memcpy(&value, bytes(sizeof value).data(), sizeof value);
        return value;
    }
    template <class T>
    std::vector<T> array()
    {
        const auto count = value<std::uint64_t>();
        if (count > rest_.size() / sizeof(T))
            bytes(rest_.size() + 1); // refuses
        const std::string_view piece = bytes(count * sizeof(T));
        std::vector<T> values(count);
        if (count > 0) // an empty list has no place to copy to
            std::memcpy(static_cast<void*>(values.data()), piece.data(), piece.size());
        return values;
    }
    std::string_view text() { return bytes(value<std::uint64_t>()); }

private:
    std::string_view rest_;
    std::string place_;
};

} // namespace lightwell::scene_text
