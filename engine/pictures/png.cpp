#include "engine/pictures/png.h"

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/pictures/limits.h"

#include <cstring>
#include <png.h>
#include <stdexcept>

namespace lightwell {

namespace {

/// libpng's handle, freed however the scope ends.
struct Image {
    png_image png{};
    Image() { png.version = PNG_IMAGE_VERSION; }
    ~Image() { png_image_free(&png); }
    Image(const Image&) = delete;
    Image& operator=(const Image&) = delete;
};

constexpr int channels = 3;

} // namespace

void write_png(const DisplayPicture& picture, const std::filesystem::path& file)
{
    check_layout_size(file.string(), picture.width, picture.height);
    const std::size_t expected =
        static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) * channels;
    if (picture.rgb.size() != expected)
        throw InputError{file.string(), "picture to be written has " + std::to_string(picture.rgb.size()) +
                                            " bytes, expected " + std::to_string(expected)};
    write_atomically(file, [&](const std::filesystem::path& temporary) {
        Image image;
        image.png.width = static_cast<png_uint_32>(picture.width);
        image.png.height = static_cast<png_uint_32>(picture.height);
        image.png.format = PNG_FORMAT_RGB;
        if (png_image_write_to_file(&image.png, temporary.c_str(), 0, picture.rgb.data(), 0, nullptr) == 0)
            throw std::runtime_error(image.png.message);
    });
}

DisplayPicture read_png(const std::filesystem::path& file)
{
    const MappedFile mapped(file);
    Image image;
    const auto refuse = [&] {
        throw InputError{file.string(), std::string("cannot be read as PNG: ") + image.png.message,
                         "give a complete .png file"};
    };
    if (png_image_begin_read_from_memory(&image.png, mapped.bytes().data(), mapped.bytes().size()) == 0)
        refuse();
    check_picture_size(file.string(), image.png.width, image.png.height, channels, mapped.bytes().size());
    image.png.format = PNG_FORMAT_RGB;
    DisplayPicture picture{static_cast<int>(image.png.width), static_cast<int>(image.png.height), {}};
    picture.rgb.resize(PNG_IMAGE_SIZE(image.png));
    const png_color white{255, 255, 255}; // transparent pixels are shown as on paper
    if (png_image_finish_read(&image.png, &white, picture.rgb.data(), 0, nullptr) == 0)
        refuse();
    return picture;
}

} // namespace lightwell
