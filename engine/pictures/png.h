#pragma once

#include "engine/pictures/picture.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace lightwell {

/// 8-bit sRGB, three bytes a pixel, row 0 at the top.
struct DisplayPicture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;
};
void write_png(const DisplayPicture& picture, const std::filesystem::path& file);
DisplayPicture read_png(const std::filesystem::path& file);

/// For looking at: exposure from the log-average luminance (exposure 0 chooses), global tone curve that keeps
/// highlights, sRGB encoding from the engine's primaries.
/// @param exposure  factor on radiance, or 0 to choose
DisplayPicture tone_mapped(const Picture& picture, double exposure = 0);

} // namespace lightwell
