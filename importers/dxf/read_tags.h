#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lightwell::dxf {

/// A group: its code says what the value means. Text files give the value as text, binary ones numbers as numbers.
struct Tag {
    int code = 0;
    bool is_number = false;
    std::string_view text; ///< the bytes of the value, in the file's code page; empty when is_number
    double number = 0;
    std::uint64_t place = 0; ///< line of the group code (text), offset in bytes (binary)
};

/// Splits the bytes of a DXF file into tags; finds out itself whether they are text or binary (one-byte group codes
/// up to release 12, two-byte ones since).
class TagReader {
public:
    /// @param bytes  must outlive the reader and its tags
    /// @param file   name for messages
    TagReader(std::string_view bytes, std::string file);

    /// @return false at the end of the bytes
    /// @throws InputError with the place: a group code that is no whole number, a value that is missing
    bool next(Tag& tag);

    bool is_binary() const noexcept { return binary_; }
    /// `room.dxf:214`, or `room.dxf: byte 214` for a binary file.
    std::string place(std::uint64_t place) const;
    /// The value as a finite number, or as a whole number that fits an int.
    /// @param subject  what the tag belongs to, for the message: `3DFACE on layer "A-WALL"`; called only for that
    /// @throws InputError with place, subject, group code and value
    template <class Subject>
    double number(const Tag& tag, Subject subject) const
    {
        const auto value = finite_number(tag);
        return value ? *value : reject(tag, "a finite number within +-1e40", subject());
    }
    template <class Subject>
    int integer(const Tag& tag, Subject subject) const
    {
        const auto value = whole_number(tag);
        return value ? *value : static_cast<int>(reject(tag, "a whole number", subject()));
    }

private:
    static std::optional<double> finite_number(const Tag& tag);
    static std::optional<int> whole_number(const Tag& tag);
    [[noreturn]] double reject(const Tag& tag, const std::string& expected, const std::string& subject) const;
    bool next_text(Tag& tag);
    bool next_binary(Tag& tag);
    std::string_view take_line();
    std::string_view take_bytes(std::size_t count);
    template <class Number>
    double take_number();

    std::string_view bytes_;
    std::string file_;
    std::size_t at_ = 0;
    std::uint64_t line_ = 1;
    bool binary_ = false;
    bool wide_codes_ = false;
};

/// True when the bytes begin like a DXF file: the binary sentinel, or a first section after any comments.
bool looks_like_dxf(std::string_view bytes) noexcept;

} // namespace lightwell::dxf
