#pragma once

#include <string>
#include <string_view>

namespace lightwell {

/// Checks the header of a PLY file before a reader sees it that walks on for ever on damaged ones.
/// @throws InputError with the line: no format, no end_header, unknown words, counts and types that are none
/// Source  Turk 1994, "The PLY Polygon File Format"
void check_ply_header(std::string_view bytes, const std::string& place);

} // namespace lightwell
