#include "engine/base/text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

namespace lightwell {
namespace {

char lower(char c) noexcept
{
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// One pattern element against one character; returns the length of the element, or 0 when it does not match.
std::size_t match_one(std::string_view pattern, char c) noexcept
{
    if (pattern[0] == '?')
        return 1;
    if (pattern[0] != '[')
        return lower(pattern[0]) == lower(c) ? 1 : 0;
    const std::size_t close = pattern.find(']', 2);
    if (close == std::string_view::npos)
        return c == '[' ? 1 : 0;
    const bool negated = pattern[1] == '!' || pattern[1] == '^';
    bool found = false;
    for (std::size_t i = negated ? 2 : 1; i < close; ++i) {
        if (i + 2 < close && pattern[i + 1] == '-') {
            found |= lower(pattern[i]) <= lower(c) && lower(c) <= lower(pattern[i + 2]);
            i += 2;
        } else {
            found |= lower(pattern[i]) == lower(c);
        }
    }
    return found != negated ? close + 1 : 0;
}

bool glob(std::string_view pattern, std::string_view text) noexcept
{
    // Iterative with one point of return (the last star): linear memory, quadratic time at worst.
    std::size_t p = 0, t = 0, star = std::string_view::npos, mark = 0;
    while (t < text.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            mark = t;
            continue;
        }
        const std::size_t used = p < pattern.size() ? match_one(pattern.substr(p), text[t]) : 0;
        if (used > 0) {
            p += used;
            ++t;
        } else if (star != std::string_view::npos) {
            p = star + 1;
            t = ++mark;
        } else {
            return false;
        }
    }
    while (p < pattern.size() && pattern[p] == '*')
        ++p;
    return p == pattern.size();
}

constexpr std::array<std::uint16_t, 32> windows_1252_high{
    0x20AC, 0x81,   0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
    0x2039, 0x0152, 0x8D,   0x017D, 0x8F,   0x90,   0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
    0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0x9D,   0x017E, 0x0178};

} // namespace

std::optional<double> parse_double(std::string_view token) noexcept
{
    const bool negative = !token.empty() && token[0] == '-';
    if (!token.empty() && (token[0] == '+' || negative))
        token.remove_prefix(1);
    if (token.empty() || token[0] == '+' || token[0] == '-')
        return std::nullopt;
    double value = 0;
    const auto [end, code] = std::from_chars(token.data(), token.data() + token.size(), value);
    if (end != token.data() + token.size() || code == std::errc::invalid_argument)
        return std::nullopt;
    if (code == std::errc::result_out_of_range) {
        // from_chars does not say which way; a negative exponent can only be too small.
        const std::size_t e = token.find_first_of("eE");
        const bool tiny = e == std::string_view::npos ? token[0] == '0' || token[0] == '.'
                                                      : e + 1 < token.size() && token[e + 1] == '-';
        value = tiny ? 0 : std::numeric_limits<double>::infinity();
    }
    return negative ? -value : value;
}

std::optional<long long> parse_integer(std::string_view token) noexcept
{
    if (!token.empty() && token[0] == '+')
        token.remove_prefix(1);
    long long value = 0;
    const auto [end, code] = std::from_chars(token.data(), token.data() + token.size(), value);
    if (token.empty() || code != std::errc{} || end != token.data() + token.size())
        return std::nullopt;
    return value;
}

std::string shortest(double value)
{
    std::array<char, 32> buffer;
    const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    return {buffer.data(), result.ptr};
}

bool matches(std::string_view pattern, std::string_view text) noexcept
{
    const std::size_t dots = pattern.find("..");
    if (dots == std::string_view::npos || dots == 0 || dots + 2 >= pattern.size())
        return glob(pattern, text);
    const std::string low = lowercase_ascii(pattern.substr(0, dots)), high = lowercase_ascii(pattern.substr(dots + 2));
    const std::string value = lowercase_ascii(text);
    return low <= value && std::string_view(value).substr(0, high.size()) <= high;
}

std::string percent_encoded(std::string_view name)
{
    if (name.empty())
        return "%00";
    constexpr char digits[] = "0123456789ABCDEF";
    std::string word;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte <= 0x20 || byte == 0x7F || c == '%' || c == '#')
            word += {'%', digits[byte >> 4], digits[byte & 15]};
        else
            word += c;
    }
    return word;
}

std::string percent_decoded(std::string_view word)
{
    std::string name;
    for (std::size_t i = 0; i < word.size(); ++i) {
        unsigned value = 0;
        if (word[i] == '%' && i + 2 < word.size() + 0 &&
            std::from_chars(word.data() + i + 1, word.data() + i + 3, value, 16).ptr == word.data() + i + 3) {
            if (value != 0)
                name += static_cast<char>(value);
            i += 2;
        } else {
            name += word[i];
        }
    }
    return name;
}

std::string lowercase_ascii(std::string_view text)
{
    std::string result(text);
    for (char& c : result)
        c = lower(c);
    return result;
}

std::string_view trimmed(std::string_view text) noexcept
{
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos)
        return {};
    return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

std::vector<std::string_view> split(std::string_view text, std::string_view at)
{
    std::vector<std::string_view> pieces;
    for (std::size_t begin = text.find_first_not_of(at); begin != std::string_view::npos;) {
        const std::size_t end = std::min(text.find_first_of(at, begin), text.size());
        pieces.push_back(text.substr(begin, end - begin));
        begin = text.find_first_not_of(at, end);
    }
    return pieces;
}

bool is_utf8(std::string_view bytes) noexcept
{
    for (std::size_t i = 0; i < bytes.size();) {
        const auto lead = static_cast<unsigned char>(bytes[i]);
        const int extra = lead < 0x80                   ? 0
                          : lead >= 0xC2 && lead < 0xE0 ? 1
                          : (lead & 0xF0) == 0xE0       ? 2
                          : lead >= 0xF0 && lead < 0xF5 ? 3
                                                        : -1;
        if (extra < 0 || i + static_cast<std::size_t>(extra) >= bytes.size() + (extra == 0 ? 1 : 0))
            return false;
        for (int k = 1; k <= extra; ++k)
            if ((static_cast<unsigned char>(bytes[i + static_cast<std::size_t>(k)]) & 0xC0) != 0x80)
                return false;
        i += static_cast<std::size_t>(extra) + 1;
    }
    return true;
}

std::string utf8_of(char32_t c)
{
    if (c > 0x10FFFF || (c >= 0xD800 && c < 0xE000))
        c = 0xFFFD;
    std::string s;
    const auto byte = [&](char32_t value) { s += static_cast<char>(static_cast<unsigned char>(value)); };
    if (c < 0x80) {
        byte(c);
    } else if (c < 0x800) {
        byte(0xC0 | (c >> 6));
        byte(0x80 | (c & 0x3F));
    } else if (c < 0x10000) {
        byte(0xE0 | (c >> 12));
        byte(0x80 | ((c >> 6) & 0x3F));
        byte(0x80 | (c & 0x3F));
    } else {
        byte(0xF0 | (c >> 18));
        byte(0x80 | ((c >> 12) & 0x3F));
        byte(0x80 | ((c >> 6) & 0x3F));
        byte(0x80 | (c & 0x3F));
    }
    return s;
}

std::string to_utf8(std::string_view bytes)
{
    if (is_utf8(bytes))
        return std::string(bytes);
    std::string text;
    for (const char c : bytes) {
        const auto byte = static_cast<unsigned char>(c);
        text += utf8_of(byte >= 0x80 && byte < 0xA0 ? windows_1252_high[byte - 0x80u] : byte);
    }
    return text;
}

} // namespace lightwell
