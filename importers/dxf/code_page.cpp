#include "importers/dxf/code_page.h"

#include "engine/base/text.h"

#include <algorithm>
#include <charconv>
#include <iconv.h>
#include <memory>
#include <optional>

namespace lightwell::dxf {
namespace {

/// iconv's name for a value of $DWGCODEPAGE.
std::string iconv_name(std::string_view code_page)
{
    const std::string word = lowercase_ascii(trimmed(code_page));
    if (word.starts_with("ansi_"))
        return "CP" + word.substr(5);
    if (word.starts_with("dos"))
        return "CP" + word.substr(3);
    if (word.starts_with("iso8859-"))
        return "ISO-8859-" + word.substr(8);
    return word;
}

/// @return nothing when the conversion is unknown or the bytes do not fit it
std::optional<std::string> converted(std::string_view bytes, const std::string& from)
{
    const iconv_t conversion = iconv_open("UTF-8", from.c_str());
    if (conversion == reinterpret_cast<iconv_t>(-1))
        return std::nullopt;
    const std::unique_ptr<void, int (*)(iconv_t)> guard{conversion, iconv_close};
    constexpr std::size_t most_utf8_bytes_per_byte = 4;
    std::string in{bytes}, out(bytes.size() * most_utf8_bytes_per_byte, '\0');
    char *from_at = in.data(), *to_at = out.data();
    std::size_t left = in.size(), room = out.size();
    if (iconv(conversion, &from_at, &left, &to_at, &room) == static_cast<std::size_t>(-1) || left > 0)
        return std::nullopt;
    out.resize(out.size() - room);
    return out;
}

/// \U+00E4 becomes the character; anything else stays.
std::string without_escapes(std::string text)
{
    constexpr std::string_view mark = "\\U+";
    constexpr std::size_t digits = 4;
    for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + 1)) {
        const char* const begin = text.data() + at + mark.size();
        const char* const end = begin + std::min(digits, text.size() - at - mark.size());
        std::uint32_t code_point = 0;
        const auto [stop, error] = std::from_chars(begin, end, code_point, 16);
        if (error == std::errc{} && stop == begin + digits)
            text.replace(at, mark.size() + digits, utf8_of(static_cast<char32_t>(code_point)));
    }
    return text;
}

} // namespace

CodePage::CodePage(std::string_view name)
{
    const std::string wanted = iconv_name(name);
    if (wanted == "CP1252")
        return;
    known_ = converted("A", wanted).has_value();
    if (known_)
        name_ = wanted;
}

std::string CodePage::decoded(std::string_view bytes) const
{
    if (!name_.empty() && !is_utf8(bytes))
        if (auto text = converted(bytes, name_))
            return without_escapes(std::move(*text));
    return without_escapes(to_utf8(bytes));
}

} // namespace lightwell::dxf
