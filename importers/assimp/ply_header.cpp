#include "importers/assimp/ply_header.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"

#include <algorithm>
#include <array>

namespace lightwell {
namespace {

constexpr std::array types{"char", "uchar", "short", "ushort", "int",   "uint",   "float",   "double",
                           "int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64"};

bool is_type(std::string_view word)
{
    return std::find(types.begin(), types.end(), word) != types.end();
}

/// What is wrong with one line; empty when nothing is.
std::string fault_of(const std::vector<std::string_view>& words, std::size_t file_bytes)
{
    const std::string_view first = words[0];
    if (first == "comment" || first == "obj_info" || first == "end_header")
        return {};
    if (first == "format")
        return words.size() == 3 &&
                       (words[1] == "ascii" || words[1] == "binary_little_endian" || words[1] == "binary_big_endian")
                   ? ""
                   : "expected: format ascii|binary_little_endian|binary_big_endian 1.0";
    if (first == "element") {
        const auto count = words.size() == 3 ? parse_integer(words[2]) : std::nullopt;
        if (!count)
            return "expected: element NAME COUNT";
        return *count >= 0 && static_cast<unsigned long long>(*count) <= file_bytes
                   ? ""
                   : "an element count that the file is too short for";
    }
    if (first == "property") {
        const bool list = words.size() == 5 && words[1] == "list" && is_type(words[2]) && is_type(words[3]);
        return list || (words.size() == 3 && is_type(words[1])) ? "" : "expected: property [list TYPE] TYPE NAME";
    }
    return "expected format, element, property, comment or end_header";
}

} // namespace

void check_ply_header(std::string_view bytes, const std::string& place)
{
    const char* const hint = "the file is damaged; export it again, or as glTF or OBJ";
    bool format = false;
    std::size_t line = 1;
    for (std::size_t at = 0; at < bytes.size(); ++line) {
        const std::size_t end = std::min(bytes.find_first_of("\r\n", at), bytes.size());
        const auto words = split(bytes.substr(at, end - at));
        at = end + (bytes.substr(end, 2) == "\r\n" ? 2 : 1);
        if (words.empty() || line == 1)
            continue;
        if (const std::string fault = fault_of(words, bytes.size()); !fault.empty())
            throw InputError(place + ":" + std::to_string(line), "\"" + to_utf8(words[0]) + "\": " + fault, hint);
        format = format || words[0] == "format";
        if (words[0] == "element" && !format)
            break;
        if (words[0] == "end_header" && format)
            return;
    }
    throw InputError(place + ":" + std::to_string(line),
                     format ? "the header has no end_header" : "the header states no format", hint);
}

} // namespace lightwell
