#pragma once

#include "engine/pictures/png.h"

#include <string>
#include <string_view>

namespace lightwell {

/// A JPEG file, grey or in colour, as sRGB.
/// @throws InputError: missing, not a JPEG, damaged beyond reading, absurd size; what is cut off is refused too
DisplayPicture read_jpeg(const std::filesystem::path& file);
/// The same from memory; a picture of more than `pixel_bound` is read at a half, a quarter or an eighth of its size.
DisplayPicture read_jpeg(std::string_view bytes, const std::string& place, std::size_t pixel_bound);

} // namespace lightwell
