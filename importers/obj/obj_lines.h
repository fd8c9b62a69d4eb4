#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lightwell {

/// Walks over the lines of an OBJ or MTL text; a line that ends in `\` goes on in the next one.
class ObjLines {
public:
    explicit ObjLines(std::string_view text) : text_(text) {}
    /// @param line  valid until the next call
    /// @return      false after the last line
    bool next(std::string_view& line);
    /// Number of the first physical line of the current one, from 1.
    std::size_t number() const { return number_; }

private:
    bool next_physical(std::string_view& line);
    std::string_view text_;
    std::size_t at_ = 0, physical_ = 0, number_ = 0;
    std::string joined_;
};

/// Takes the next word off the front of `rest`; empty at the end of the line or at a comment.
std::string_view next_word(std::string_view& rest) noexcept;
/// The rest of a line as a name that may hold blanks: trimmed, without a comment (a `#` that stands alone).
std::string_view name_in(std::string_view rest) noexcept;

} // namespace lightwell
