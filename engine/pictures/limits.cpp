#include "engine/pictures/limits.h"

#include "engine/base/errors.h"
#include "engine/pictures/picture.h"

#include <algorithm>

namespace lightwell {

namespace {

/// A picture this small in memory is allowed whatever the size of its file.
constexpr double harmless_bytes = 256.0 * 1024 * 1024;
/// Deflate, the densest packing in common use, ends at 1032 : 1; the rest is a margin for half floats and wavelets.
constexpr double densest_packing = 4096;

std::string size_text(std::int64_t width, std::int64_t height)
{
    return std::to_string(width) + " x " + std::to_string(height);
}

} // namespace

void check_picture_size(const std::string& place, std::int64_t width, std::int64_t height, std::int64_t channels,
                        std::size_t file_bytes)
{
    if (!(width >= 1 && height >= 1 && width <= most_pixels && height <= most_pixels && width * height <= most_pixels))
        throw InputError{place,
                         "size is " + size_text(width, height) + " pixels, expected 1 to " +
                             std::to_string(most_pixels) + " pixels in all",
                         "the header is damaged, or the picture must be cut into parts"};
    const double memory =
        static_cast<double>(width * height) * 4 * static_cast<double>(std::max<std::int64_t>(channels, 1));
    if (memory > std::max(harmless_bytes, densest_packing * static_cast<double>(file_bytes)))
        throw InputError{place,
                         "size is " + size_text(width, height) + " pixels with " + std::to_string(channels) +
                             " channels, which a file of " + std::to_string(file_bytes) + " bytes cannot hold",
                         "the file is truncated or its header damaged; write it again"};
}

void check_layout_size(const std::string& place, int width, int height)
{
    if (!(width >= 1 && height >= 1 && std::int64_t{width} * height <= most_pixels))
        throw InputError{place, "picture to be written is " + size_text(width, height) + " pixels, expected 1 to " +
                                    std::to_string(most_pixels) + " in all"};
}

void check_picture(const std::string& place, const Picture& picture)
{
    check_layout_size(place, picture.width, picture.height);
    if (picture.channels.empty())
        throw InputError{place, "picture to be written has no channel", "add at least one"};
    const std::size_t pixels = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
    for (const auto& [name, values] : picture.channels)
        if (values.size() != pixels)
            throw InputError{place, "channel \"" + name + "\" has " + std::to_string(values.size()) +
                                        " values, expected " + std::to_string(pixels)};
}

} // namespace lightwell
