#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lightwell {

/// A whole number token as a double. Accepts a leading '+'; values beyond the range of double become +-infinity or
/// 0, as in IEEE 754 rounding, for the caller's range check to name. Locale never matters.
/// @return nothing when the token is not a number from its first to its last character
std::optional<double> parse_double(std::string_view token) noexcept;
/// @return nothing when the token is not a decimal integer that fits
std::optional<long long> parse_integer(std::string_view token) noexcept;
/// The shortest text that reads back to the same double.
std::string shortest(double value);

/// Shell-style pattern, case-insensitive in ASCII: `*` any run, `?` one character, `[a-z]` a set, `A..B` a
/// lexicographic range (both ends included, the upper end as a prefix).
bool matches(std::string_view pattern, std::string_view text) noexcept;

/// Blanks, control characters, '%' and '#' as %XX, so that a layer's name is one word in scene text; empty is "%00".
std::string percent_encoded(std::string_view name);
std::string percent_decoded(std::string_view word);

std::string lowercase_ascii(std::string_view text);
std::string_view trimmed(std::string_view text) noexcept;
/// Split at any run of the given characters; no empty pieces.
std::vector<std::string_view> split(std::string_view text, std::string_view at = " \t");
/// True when the bytes are well-formed UTF-8.
bool is_utf8(std::string_view bytes) noexcept;
/// The bytes themselves when they are UTF-8, else read as Windows-1252, the usual code page of CAD files.
std::string to_utf8(std::string_view bytes);
/// UTF-8 of one code point; U+FFFD for what is none.
std::string utf8_of(char32_t code_point);

} // namespace lightwell
