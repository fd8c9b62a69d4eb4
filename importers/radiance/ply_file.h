#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lightwell::scene_text {

/// One property of all entries of an element, as numbers whatever type the file has.
struct PlyColumn {
    std::string name;
    bool list = false;
    std::vector<std::uint32_t> sizes; ///< of a list: how many values each entry has
    std::vector<double> values;       ///< entry after entry
};

struct PlyElement {
    std::string name;
    std::size_t count = 0;
    std::vector<PlyColumn> columns;

    /// Null when there is no such property.
    const PlyColumn* find(std::string_view property) const noexcept;
};

/// A binary little endian PLY file: its comments, and its elements as columns.
struct PlyFile {
    std::vector<std::string> comments; ///< without the word `comment`
    std::vector<PlyElement> elements;

    const PlyElement* find(std::string_view element) const noexcept;
};

/// @param name  of the file, for messages
/// @throws InputError with line or entry: another format, unknown types, counts that the file is too short for, bytes
///         left over
PlyFile read_ply(std::string_view bytes, const std::string& name);

} // namespace lightwell::scene_text
