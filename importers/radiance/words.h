#pragma once

#include "engine/base/errors.h"

#include <string>
#include <string_view>
#include <vector>

namespace lightwell::scene_text {

/// One entry of a scene description: `modifier type name`, then its words, integers and numbers, each counted.
/// The views point into the text that was read.
struct Primitive {
    std::string_view modifier, type, name;
    std::vector<std::string_view> words;
    std::vector<double> numbers;
    std::size_t offset = 0; ///< of the modifier, in the text
};

/// Walks through scene text: comments, commands and primitives. Keeps no copy; line numbers are counted only when
/// a message needs one.
class Words {
public:
    enum class Next { end, comment, command, primitive };

    Words(std::string_view text, std::string file_name);

    /// What comes next, blanks skipped.
    Next next() noexcept;
    /// The rest of the line, without its end; a command goes on after a backslash at the end of a line.
    std::string_view comment() noexcept;
    std::string command();
    /// @throws InputError when the text ends within the primitive, a count is no count or a number no finite number
    void read(Primitive& primitive);
    /// The one word that an alias has beside its three.
    std::string_view alias_target(const Primitive& primitive);

    /// `file:line` of an offset.
    std::string place(std::size_t offset) const;
    /// `file:line: type "name"`.
    std::string place(const Primitive& primitive) const;
    std::size_t offset() const noexcept { return at_; }

private:
    void skip_blanks() noexcept;
    void skip_blanks_and_comments() noexcept;
    std::string_view word() noexcept;
    std::size_t count(const Primitive& primitive, const char* of_what);
    double number(const Primitive& primitive);
    [[noreturn]] void truncated(const Primitive& primitive, const std::string& missing) const;

    std::string_view text_;
    std::string file_name_;
    std::size_t at_ = 0;
    mutable std::size_t counted_to_ = 0, lines_ = 1; ///< newlines before counted_to_, plus one
};

/// Words of a command line, quotes removed; `|`, `>`, `<`, `;`, `&`, `$` and backquotes outside quotes are refused.
/// @throws InputError that shows the character
std::vector<std::string> command_words(const std::string& command, const std::string& place);

/// A name as one word that no reader takes for a comment, a command, a quotation or a keyword.
std::string encoded_name(const std::string& name);
/// The name behind such a word, as UTF-8.
std::string decoded_name(std::string_view word);

} // namespace lightwell::scene_text
