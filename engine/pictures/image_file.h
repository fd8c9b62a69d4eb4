#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lightwell {

/// An 8-bit picture as a camera or a painting program stores it, row 0 at the top.
struct ImageFile {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba; ///< colour as stored (usually sRGB-coded), opacity 255 is opaque
};

/// Reads PNG or JPEG, told apart by content. Grey and paletted pictures become colour; 16 bits become 8; a JPEG of more
/// than 33 million pixels is read at a half, a quarter or an eighth of its size, unless its file is large too.
/// @param bytes  the whole file, in memory
/// @param place  for messages
/// @throws InputError for another format, damaged or truncated data, a size beyond the bounds of limits.h
ImageFile read_image(std::string_view bytes, const std::string& place);

} // namespace lightwell
