#pragma once

#include <string>
#include <string_view>

namespace lightwell {

/// The two parts of a glTF file, as views into its bytes.
struct GltfContainer {
    std::string_view json;
    std::string_view binary; ///< the BIN chunk of a GLB; empty otherwise
    bool is_binary = false;
};

/// Takes a GLB apart; a text is its own JSON.
/// @throws InputError for a wrong version, a length or a chunk that does not fit the file
GltfContainer open_container(std::string_view bytes, const std::string& name);

/// Stops texts that would exhaust the stack of a recursive reader.
/// @throws InputError with the line where brackets nest deeper than 128
void check_json_depth(std::string_view json, const std::string& name);

/// @return line of this byte, from 1
std::size_t line_of(std::string_view text, std::size_t byte) noexcept;

} // namespace lightwell
