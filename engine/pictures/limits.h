#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace lightwell {

/// 16384 x 16384 pixels: beyond any view that is rendered, small enough that sizes in bytes never overflow.
inline constexpr std::int64_t most_pixels = std::int64_t{1} << 28;

/// Checks a size found in a file before anything is allocated for it.
///
/// A file of a few bytes may claim any size: what a picture takes in memory must stay below 256 MiB or below what the
/// file could hold when it is packed as densely as its kind of packing allows on real pictures (4096 : 1).
/// @param width, height  as claimed by the file
/// @param channels       how many float channels are to be kept
/// @param file_bytes     size of the file
/// @throws InputError naming the size and the bound
void check_picture_size(const std::string& place, std::int64_t width, std::int64_t height, std::int64_t channels,
                        std::size_t file_bytes);

struct Picture;
/// @throws InputError when a picture of this size cannot be written
void check_layout_size(const std::string& place, int width, int height);
/// Checks a picture that is to be written: at least one pixel and one channel, each channel complete, names usable.
/// @throws InputError naming the channel
void check_picture(const std::string& place, const Picture& picture);

} // namespace lightwell
