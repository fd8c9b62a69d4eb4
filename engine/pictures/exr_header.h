#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lightwell {

/// Checks the header of an OpenEXR file byte by byte before the library sees it, because a damaged one can make the
/// library allocate without bound or abort: every attribute inside the file and named once, sizes, windows, channels,
/// tiles and the table of chunks possible for a file of this length.
/// @throws InputError: not OpenEXR, several parts, deep data, truncated, absurd
void check_exr_header(std::string_view bytes, const std::string& place);

/// True for attributes that OpenEXR or this program gives a meaning and a type of their own, so that no header entry
/// may carry their name.
bool is_reserved_exr_name(std::string_view name) noexcept;

} // namespace lightwell
