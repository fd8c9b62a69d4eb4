#include "importers/assimp/foreign_format.h"

#include "engine/base/text.h"

#include <array>
#include <cstdint>
#include <cstring>

namespace lightwell {
namespace {

using namespace std::string_view_literals;

/// Marks stand within this many bytes; comments may come before them.
constexpr std::size_t head_size = 4096;
constexpr std::size_t stl_header = 80, stl_triangle = 50;

constexpr ForeignFormat fbx{"fbx", "FBX", nullptr}, collada{"dae", "Collada", nullptr}, studio{"3ds", "3DS", nullptr},
    ply{"ply", "PLY", nullptr}, stl{"stl", "STL", nullptr}, x3d{"x3d", "X3D", nullptr}, off{"off", "OFF", nullptr},
    ifc{"ifc", "IFC 2x3", nullptr},
    newer_ifc{"ifc", "IFC", "it is IFC of another version than 2x3; export it as IFC 2x3 (IFC2X3)"},
    step{"stp", "STEP", "STEP is not read; export it as IFC 2x3, glTF, OBJ or DXF"},
    iges{"igs", "IGES", "IGES is not read; export it as glTF, OBJ or DXF"},
    usd{"usd", "USD", "USD is not read; export it as glTF, OBJ or DXF"},
    vrml{"wrl", "VRML", "VRML is not read; save it as X3D, glTF or OBJ"};

template <class Integer>
Integer little_endian(std::string_view bytes, std::size_t at)
{
    Integer value = 0;
    if (at + sizeof value <= bytes.size())
        std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

bool starts(std::string_view text, std::string_view mark)
{
    return text.substr(0, mark.size()) == mark;
}

bool has(std::string_view text, std::string_view mark)
{
    return text.find(mark) != std::string_view::npos;
}

/// The main chunk, whose length is that of the file or near it.
bool is_3ds(std::string_view bytes, std::size_t size)
{
    constexpr std::uint16_t main_chunk = 0x4d4d;
    constexpr std::size_t chunk_header = 6;
    return size > chunk_header && little_endian<std::uint16_t>(bytes, 0) == main_chunk &&
           little_endian<std::uint32_t>(bytes, 2) <= size;
}

bool is_stl(std::string_view head, std::size_t size)
{
    if (starts(trimmed(head), "solid") && has(head, "facet"))
        return true;
    const auto triangles = std::uint64_t{little_endian<std::uint32_t>(head, stl_header)};
    return triangles > 0 && size == stl_header + 4 + stl_triangle * triangles;
}

/// `OFF`, with letters for colours, normals and texture places before it.
bool is_off(std::string_view head)
{
    std::string_view word = trimmed(head.substr(0, head.find_first_of("\r\n")));
    word = word.substr(0, word.find_first_of(" \t#"));
    for (const std::string_view letter : {"ST"sv, "C"sv, "N"sv})
        if (starts(word, letter))
            word.remove_prefix(letter.size());
    return word == "OFF"sv;
}

/// The first line ends in column 73 with the letter of the start section and its number 1.
bool is_iges(std::string_view head)
{
    constexpr std::size_t column = 72, digits = 7;
    return head.size() > column + digits && head[column] == 'S' && head[column + digits] == '1' &&
           head.substr(column + 1, digits - 1).find_first_not_of(" 0") == std::string_view::npos;
}

const ForeignFormat* of_step_text(std::string_view bytes)
{
    const std::size_t at = bytes.find("FILE_SCHEMA");
    const std::string_view schema = bytes.substr(std::min(at, bytes.size()), 200);
    if (has(schema, "IFC2X3"))
        return &ifc;
    return has(schema, "IFC") ? &newer_ifc : &step;
}

} // namespace

const ForeignFormat* foreign_format_of(std::string_view bytes, std::size_t size)
{
    std::string_view head = bytes.substr(0, head_size);
    if (starts(head, "\xef\xbb\xbf"))
        head.remove_prefix(3);
    if (starts(head, "Kaydara FBX Binary") || (starts(head, ";") && has(head, "FBX")) ||
        has(head, "FBXHeaderExtension"))
        return &fbx;
    if (starts(head, "ply") && has(head.substr(3, 1), "\r") + has(head.substr(3, 1), "\n") > 0)
        return &ply;
    if (starts(trimmed(head), "ISO-10303-21"))
        return of_step_text(bytes);
    if (starts(head, "#usda") || starts(head, "PXR-USDC"))
        return &usd;
    if (starts(head, "#VRML"))
        return &vrml;
    if (starts(trimmed(head), "<")) {
        if (has(head, "<COLLADA"))
            return &collada;
        if (has(head, "<X3D"))
            return &x3d;
    }
    if (is_off(head))
        return &off;
    if (is_stl(head, size))
        return &stl;
    if (is_3ds(head, size))
        return &studio;
    if (is_iges(head))
        return &iges;
    return nullptr;
}

} // namespace lightwell
