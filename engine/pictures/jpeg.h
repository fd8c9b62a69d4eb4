#pragma once

#include "engine/pictures/png.h"

namespace lightwell {

/// A JPEG file, grey or in colour, as sRGB.
/// @throws InputError: missing, not a JPEG, damaged beyond reading, absurd size; what is cut off is refused too
DisplayPicture read_jpeg(const std::filesystem::path& file);

} // namespace lightwell
