#include "importers/dxf/read_tags.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace lightwell::dxf {
namespace {

constexpr std::string_view sentinel{"AutoCAD Binary DXF\r\n\x1a\0", 22};
constexpr std::string_view byte_order_mark{"\xEF\xBB\xBF"};
/// Beyond the width of the universe in any unit: a damaged number, and its square must not overflow.
constexpr double largest_number = 1e40;
constexpr int largest_group_code = 1071;

/// How a binary file stores the value of a group.
/// Source  Autodesk DXF reference, group code value types
enum class Stored { text, real, int8, int16, int32, int64, chunk };

struct CodeRange {
    int last; ///< ranges follow each other
    Stored stored;
};

constexpr CodeRange stored_as[] = {
    {9, Stored::text},     {59, Stored::real},    {79, Stored::int16},   {89, Stored::text},   {99, Stored::int32},
    {109, Stored::text},   {149, Stored::real},   {159, Stored::text},   {169, Stored::int64}, {179, Stored::int16},
    {209, Stored::text},   {239, Stored::real},   {269, Stored::text},   {289, Stored::int16}, {299, Stored::int8},
    {309, Stored::text},   {319, Stored::chunk},  {369, Stored::text},   {389, Stored::int16}, {399, Stored::text},
    {409, Stored::int16},  {419, Stored::text},   {429, Stored::int32},  {439, Stored::text},  {459, Stored::int32},
    {469, Stored::real},   {1003, Stored::text},  {1004, Stored::chunk}, {1009, Stored::text}, {1059, Stored::real},
    {1070, Stored::int16}, {1071, Stored::int32},
};

Stored stored_type(int code)
{
    for (const CodeRange& range : stored_as)
        if (code <= range.last)
            return range.stored;
    return Stored::text;
}

/// Control characters and blanks, as old programs pad the end of a file with them (Ctrl-Z).
bool is_padding(std::string_view rest) noexcept
{
    return std::all_of(rest.begin(), rest.end(), [](char c) { return static_cast<unsigned char>(c) <= 0x20; });
}

/// The few characters of a value that fit in a message.
std::string excerpt(std::string_view value)
{
    constexpr std::size_t shown = 40;
    std::string text = "\"";
    for (const char c : value.substr(0, shown))
        text += static_cast<unsigned char>(c) < 0x20 ? '.' : c;
    return to_utf8(text) + (value.size() > shown ? "...\"" : "\"");
}

} // namespace

TagReader::TagReader(std::string_view bytes, std::string file) : bytes_(bytes), file_(std::move(file))
{
    if (bytes_.starts_with(sentinel)) {
        binary_ = true;
        at_ = sentinel.size();
        // The first tag is (0, SECTION): 00 53 with one-byte codes, 00 00 53 with two; 255 leads in a long code.
        const std::string_view head = bytes_.substr(at_, 2);
        wide_codes_ = head.size() == 2 && head[0] != '\xFF' && (head[0] != 0 || head[1] == 0);
    } else if (bytes_.starts_with(byte_order_mark)) {
        at_ = byte_order_mark.size();
    }
}

bool TagReader::next(Tag& tag)
{
    return binary_ ? next_binary(tag) : next_text(tag);
}

std::string TagReader::place(std::uint64_t place) const
{
    return file_ + (binary_ ? ": byte " : ":") + std::to_string(place);
}

std::optional<double> TagReader::finite_number(const Tag& tag)
{
    const auto value = tag.is_number ? tag.number : parse_double(trimmed(tag.text));
    return value && std::fabs(*value) <= largest_number ? value : std::nullopt;
}

std::optional<int> TagReader::whole_number(const Tag& tag)
{
    const auto value = finite_number(tag);
    if (!value || *value != std::floor(*value) || std::fabs(*value) > std::numeric_limits<int>::max())
        return std::nullopt;
    return static_cast<int>(*value);
}

double TagReader::reject(const Tag& tag, const std::string& expected, const std::string& subject) const
{
    throw InputError{place(tag.place) + (subject.empty() ? "" : ": " + subject),
                     "group " + std::to_string(tag.code) + " is " +
                         (tag.is_number ? shortest(tag.number) : excerpt(tag.text)) + ", expected " + expected,
                     "save the drawing again or correct the value"};
}

std::string_view TagReader::take_line()
{
    const char* const begin = bytes_.data() + at_;
    const std::size_t left = bytes_.size() - at_;
    const void* const newline = std::memchr(begin, '\n', left);
    std::size_t size = newline ? static_cast<std::size_t>(static_cast<const char*>(newline) - begin) : left;
    at_ += newline ? size + 1 : size;
    ++line_;
    if (size > 0 && begin[size - 1] == '\r')
        --size;
    return {begin, size};
}

bool TagReader::next_text(Tag& tag)
{
    tag.place = line_;
    if (at_ >= bytes_.size())
        return false;
    const std::size_t start = at_;
    const std::string_view line = take_line();
    int code = 0;
    bool negative = false;
    std::size_t i = 0;
    while (i < line.size() && (line[i] == ' ' || line[i] == '\t'))
        ++i;
    if (i < line.size() && line[i] == '-') {
        negative = true;
        ++i;
    }
    const std::size_t digits = i;
    while (i < line.size() && line[i] >= '0' && line[i] <= '9' && code <= largest_group_code)
        code = code * 10 + (line[i++] - '0');
    if (i == digits || code > largest_group_code || !trimmed(line.substr(i)).empty()) {
        if (is_padding(bytes_.substr(start)))
            return false;
        throw InputError{place(tag.place), "group code is " + excerpt(line) + ", expected a whole number up to 1071",
                         "a line is missing or too many, or this is no DXF file"};
    }
    if (at_ >= bytes_.size())
        throw InputError{place(tag.place), "the file ends after a group code",
                         "it is cut short: copy or save it again"};
    tag.code = negative ? -code : code;
    tag.is_number = false;
    tag.text = take_line();
    return true;
}

std::string_view TagReader::take_bytes(std::size_t count)
{
    if (bytes_.size() - at_ < count)
        throw InputError{place(at_), "the file ends inside a value", "it is cut short: copy or save it again"};
    at_ += count;
    return bytes_.substr(at_ - count, count);
}

template <class Number>
double TagReader::take_number()
{
    Number number;
    std::memcpy(&number, take_bytes(sizeof number).data(), sizeof number); // little-endian, as this processor
    return static_cast<double>(number);
}

bool TagReader::next_binary(Tag& tag)
{
    tag.place = at_;
    if (at_ >= bytes_.size())
        return false;
    int code = static_cast<unsigned char>(bytes_[at_]);
    if (wide_codes_) {
        if (bytes_.size() - at_ < 2 && is_padding(bytes_.substr(at_)))
            return false;
        code = static_cast<int>(take_number<std::int16_t>());
    } else {
        ++at_;
        if (code == 255)
            code = static_cast<int>(take_number<std::int16_t>());
    }
    if (code > largest_group_code)
        throw InputError{place(tag.place), "group code is " + std::to_string(code) + ", expected at most 1071",
                         "the file is damaged: copy or save it again"};
    tag.code = code;
    tag.text = {};
    tag.is_number = true;
    switch (stored_type(code)) {
    case Stored::real:
        tag.number = take_number<double>();
        return true;
    case Stored::int8:
        tag.number = take_number<std::int8_t>();
        return true;
    case Stored::int16:
        tag.number = take_number<std::int16_t>();
        return true;
    case Stored::int32:
        tag.number = take_number<std::int32_t>();
        return true;
    case Stored::int64:
        tag.number = take_number<std::int64_t>();
        return true;
    case Stored::chunk:
        tag.text = take_bytes(static_cast<std::size_t>(take_number<std::uint8_t>()));
        break;
    case Stored::text: {
        const std::size_t end = bytes_.find('\0', at_);
        if (end == std::string_view::npos)
            throw InputError{place(tag.place), "the file ends inside a text", "it is cut short: copy or save it again"};
        tag.text = bytes_.substr(at_, end - at_);
        at_ = end + 1;
        break;
    }
    }
    tag.is_number = false;
    return true;
}

bool looks_like_dxf(std::string_view bytes) noexcept
{
    if (bytes.starts_with(sentinel))
        return true;
    try {
        TagReader reader{bytes, {}};
        constexpr int comment = 999, comments_at_most = 1000;
        Tag tag;
        for (int i = 0; i < comments_at_most && reader.next(tag); ++i)
            if (tag.code != comment)
                return tag.code == 0 && (trimmed(tag.text) == "SECTION" || trimmed(tag.text) == "EOF");
    } catch (const InputError&) {
        return false; // the question is only whether it looks like one
    }
    return false;
}

} // namespace lightwell::dxf
