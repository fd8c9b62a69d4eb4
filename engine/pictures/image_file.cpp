#include "engine/pictures/image_file.h"

#include "engine/base/errors.h"
#include "engine/pictures/jpeg.h"
#include "engine/pictures/limits.h"

#include <algorithm>
#include <png.h>

namespace lightwell {
namespace {

constexpr std::size_t channels = 4;
/// A picture of a material may take this much memory, or three times its file, whichever is more: 5800 x 5800 pixels.
constexpr std::size_t least_bound_bytes = std::size_t{1} << 27;

std::size_t bound_bytes(std::size_t file_bytes)
{
    return std::max(least_bound_bytes, 3 * file_bytes);
}

[[noreturn]] void refuse(const std::string& place, const char* format, const std::string& why)
{
    throw InputError(place, std::string("cannot be read as ") + format + ": " + why, "give a complete file");
}

ImageFile read_png_image(std::string_view bytes, const std::string& place)
{
    struct Handle {
        png_image png{};
        Handle() { png.version = PNG_IMAGE_VERSION; }
        ~Handle() { png_image_free(&png); }
        Handle(const Handle&) = delete;
        Handle& operator=(const Handle&) = delete;
    } handle;
    if (png_image_begin_read_from_memory(&handle.png, bytes.data(), bytes.size()) == 0)
        refuse(place, "PNG", handle.png.message);
    check_picture_size(place, handle.png.width, handle.png.height, channels, bytes.size());
    if (std::size_t{handle.png.width} * handle.png.height * channels > bound_bytes(bytes.size()))
        throw InputError(place,
                         "has " + std::to_string(handle.png.width) + " x " + std::to_string(handle.png.height) +
                             " pixels, more than is taken into memory for so small a file",
                         "scale it down");
    handle.png.format = PNG_FORMAT_RGBA;
    ImageFile image{static_cast<int>(handle.png.width), static_cast<int>(handle.png.height), {}};
    image.rgba.resize(PNG_IMAGE_SIZE(handle.png));
    if (png_image_finish_read(&handle.png, nullptr, image.rgba.data(), 0, nullptr) == 0)
        refuse(place, "PNG", handle.png.message);
    return image;
}

ImageFile read_jpeg_image(std::string_view bytes, const std::string& place)
{
    const DisplayPicture picture = read_jpeg(bytes, place, bound_bytes(bytes.size()) / channels);
    ImageFile image{picture.width, picture.height, {}};
    image.rgba.reserve(picture.rgb.size() / 3 * channels);
    for (std::size_t i = 0; i + 2 < picture.rgb.size(); i += 3)
        image.rgba.insert(image.rgba.end(), {picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2], 255});
    return image;
}

} // namespace

ImageFile read_image(std::string_view bytes, const std::string& place)
{
    if (bytes.substr(0, 4) == "\x89PNG")
        return read_png_image(bytes, place);
    if (bytes.substr(0, 3) == "\xff\xd8\xff")
        return read_jpeg_image(bytes, place);
    throw InputError(place, "is neither PNG nor JPEG", "convert it to PNG");
}

} // namespace lightwell
