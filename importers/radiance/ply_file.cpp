#include "importers/radiance/ply_file.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"

#include <cstring>
#include <fmt/format.h>
#include <optional>

namespace lightwell::scene_text {
namespace {

enum class NumberType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

constexpr std::size_t bytes_of[] = {1, 1, 2, 2, 4, 4, 4, 8};

std::optional<NumberType> type_named(std::string_view word)
{
    constexpr std::pair<std::string_view, NumberType> names[] = {
        {"char", NumberType::int8},      {"int8", NumberType::int8},       {"uchar", NumberType::uint8},
        {"uint8", NumberType::uint8},    {"short", NumberType::int16},     {"int16", NumberType::int16},
        {"ushort", NumberType::uint16},  {"uint16", NumberType::uint16},   {"int", NumberType::int32},
        {"int32", NumberType::int32},    {"uint", NumberType::uint32},     {"uint32", NumberType::uint32},
        {"float", NumberType::float32},  {"float32", NumberType::float32}, {"double", NumberType::float64},
        {"float64", NumberType::float64}};
    for (const auto& [name, type] : names)
        if (name == word)
            return type;
    return std::nullopt;
}

template <class T>
double number_at(const char* bytes) noexcept
{
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
}

double number_of(NumberType type, const char* bytes) noexcept
{
    switch (type) {
    case NumberType::int8:
        return number_at<std::int8_t>(bytes);
    case NumberType::uint8:
        return number_at<std::uint8_t>(bytes);
    case NumberType::int16:
        return number_at<std::int16_t>(bytes);
    case NumberType::uint16:
        return number_at<std::uint16_t>(bytes);
    case NumberType::int32:
        return number_at<std::int32_t>(bytes);
    case NumberType::uint32:
        return number_at<std::uint32_t>(bytes);
    case NumberType::float32:
        return number_at<float>(bytes);
    case NumberType::float64:
        break;
    }
    return number_at<double>(bytes);
}

struct ColumnType {
    NumberType value;
    std::optional<NumberType> size; ///< of a list
};

class PlyReader {
public:
    PlyReader(std::string_view bytes, const std::string& name) : rest_(bytes), name_(name) {}

    PlyFile read()
    {
        read_header();
        for (std::size_t i = 0; i < file_.elements.size(); ++i)
            read_element(file_.elements[i], types_[i]);
        if (!rest_.empty())
            throw InputError{name_, fmt::format("{} bytes are left over behind the last element", rest_.size()),
                             "the counts of the header are wrong: export it again"};
        return std::move(file_);
    }

private:
    [[noreturn]] void reject(const std::string& what, const std::string& hint = {}) const
    {
        throw InputError{fmt::format("{}:{}", name_, line_), what, hint};
    }

    std::string_view next_line()
    {
        ++line_;
        const std::size_t end = rest_.find('\n');
        if (end == std::string_view::npos)
            reject("the header ends without `end_header`", "the file is cut off or no PLY: export it again");
        const std::string_view line = trimmed(rest_.substr(0, end));
        rest_.remove_prefix(end + 1);
        return line;
    }

    void read_header()
    {
        if (!rest_.starts_with("ply"))
            throw InputError{name_, "does not begin with `ply`", "a mesh part is a PLY file"};
        next_line();
        bool known_format = false;
        for (;;) {
            const std::string_view line = next_line();
            const std::vector<std::string_view> words = split(line);
            if (words.empty() || words[0] == "obj_info")
                continue;
            if (words[0] == "end_header")
                break;
            if (words[0] == "comment")
                file_.comments.emplace_back(trimmed(line.substr(words[0].size())));
            else if (words[0] == "format")
                known_format = check_format(words);
            else if (words[0] == "element")
                add_element(words);
            else if (words[0] == "property")
                add_property(words);
            else
                reject(fmt::format("\"{}\" is no word of a PLY header", words[0].substr(0, 40)));
        }
        if (!known_format)
            throw InputError{name_, "the header has no `format`", "write `format binary_little_endian 1.0`"};
    }

    bool check_format(const std::vector<std::string_view>& words) const
    {
        if (words.size() != 3 || words[1] != "binary_little_endian" || words[2] != "1.0")
            reject(fmt::format("format is \"{}\", expected binary_little_endian 1.0",
                               words.size() > 1 ? words[1].substr(0, 40) : ""),
                   "export it as binary little endian");
        return true;
    }

    void add_element(const std::vector<std::string_view>& words)
    {
        const auto count = words.size() == 3 ? parse_integer(words[2]) : std::nullopt;
        if (!count || *count < 0)
            reject("expected `element NAME COUNT`, the count >= 0");
        file_.elements.push_back({std::string(words[1]), static_cast<std::size_t>(*count), {}});
        types_.emplace_back();
    }

    void add_property(const std::vector<std::string_view>& words)
    {
        if (file_.elements.empty())
            reject("a property without an element before it");
        const bool list = words.size() == 5 && words[1] == "list";
        if (words.size() != 3 && !list)
            reject("expected `property TYPE NAME` or `property list TYPE TYPE NAME`");
        const auto value = type_named(words[words.size() - 2]), size = list ? type_named(words[2]) : std::nullopt;
        if (!value || (list && !size))
            reject(fmt::format("type \"{}\" is not known", words[!value ? words.size() - 2 : 2].substr(0, 40)),
                   "types are char uchar short ushort int uint float double");
        file_.elements.back().columns.push_back({std::string(words.back()), list, {}, {}});
        types_.back().push_back({*value, size});
    }

    void read_element(PlyElement& element, const std::vector<ColumnType>& types)
    {
        std::size_t least = 0;
        for (const ColumnType& type : types)
            least += bytes_of[static_cast<std::size_t>(type.size.value_or(type.value))];
        if (element.count > 0 && (least == 0 || element.count > rest_.size() / least))
            throw InputError{name_,
                             fmt::format("the header says {} of element {}, the file has room for {}", element.count,
                                         element.name, least == 0 ? 0 : rest_.size() / least),
                             "the file is cut off or its header is wrong: export it again"};
        for (PlyColumn& column : element.columns) {
            column.sizes.reserve(column.list ? element.count : 0);
            column.values.reserve(column.list ? 0 : element.count);
        }
        for (std::size_t entry = 0; entry < element.count; ++entry)
            for (std::size_t c = 0; c < types.size(); ++c)
                read_value(element, entry, element.columns[c], types[c]);
    }

    void read_value(const PlyElement& element, std::size_t entry, PlyColumn& column, const ColumnType& type)
    {
        std::size_t count = 1;
        if (type.size) {
            const double size = number_of(*type.size, take(element, entry, *type.size, 1));
            if (!(size >= 0 && size <= static_cast<double>(rest_.size())))
                cut_off(element, entry);
            count = static_cast<std::size_t>(size);
            column.sizes.push_back(static_cast<std::uint32_t>(count));
        }
        const char* bytes = take(element, entry, type.value, count);
        for (std::size_t i = 0; i < count; ++i)
            column.values.push_back(number_of(type.value, bytes + i * bytes_of[static_cast<std::size_t>(type.value)]));
    }

    const char* take(const PlyElement& element, std::size_t entry, NumberType type, std::size_t count)
    {
        const std::size_t size = bytes_of[static_cast<std::size_t>(type)];
        if (count > rest_.size() / size)
            cut_off(element, entry);
        const char* bytes = rest_.data();
        rest_.remove_prefix(count * size);
        return bytes;
    }

    [[noreturn]] void cut_off(const PlyElement& element, std::size_t entry) const
    {
        throw InputError{fmt::format("{}: {} {}", name_, element.name, entry),
                         fmt::format("the file ends here, {} were announced", element.count),
                         "the file is cut off or its header is wrong: export it again"};
    }

    std::string_view rest_;
    const std::string& name_;
    std::size_t line_ = 0;
    PlyFile file_;
    std::vector<std::vector<ColumnType>> types_; ///< by element and property
};

} // namespace

const PlyColumn* PlyElement::find(std::string_view property) const noexcept
{
    for (const PlyColumn& column : columns)
        if (column.name == property)
            return &column;
    return nullptr;
}

const PlyElement* PlyFile::find(std::string_view element) const noexcept
{
    for (const PlyElement& known : elements)
        if (known.name == element)
            return &known;
    return nullptr;
}

PlyFile read_ply(std::string_view bytes, const std::string& name)
{
    return PlyReader(bytes, name).read();
}

} // namespace lightwell::scene_text
