#include "engine/pictures/image_file.h"

#include "engine/base/errors.h"
#include "engine/pictures/limits.h"

#include <csetjmp>
#include <cstdio> // jpeglib.h forgets it
#include <jpeglib.h>
#include <png.h>

namespace lightwell {
namespace {

constexpr std::int64_t channels = 4;

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
    handle.png.format = PNG_FORMAT_RGBA;
    ImageFile image{static_cast<int>(handle.png.width), static_cast<int>(handle.png.height), {}};
    image.rgba.resize(PNG_IMAGE_SIZE(handle.png));
    if (png_image_finish_read(&handle.png, nullptr, image.rgba.data(), 0, nullptr) == 0)
        refuse(place, "PNG", handle.png.message);
    return image;
}

/// libjpeg's handle; it reports faults by a jump, so nothing with a destructor may live in the jumping functions.
struct Jpeg {
    jpeg_decompress_struct file{};
    jpeg_error_mgr errors{};
    std::jmp_buf way_out;
    char message[JMSG_LENGTH_MAX] = "";
};

void jump_out(j_common_ptr file)
{
    auto* jpeg = static_cast<Jpeg*>(file->client_data);
    file->err->format_message(file, jpeg->message);
    std::longjmp(jpeg->way_out, 1);
}

void say_nothing(j_common_ptr) {}

/// @return false with a message when the header is damaged
bool begin(Jpeg& jpeg, std::string_view bytes)
{
    jpeg.file.err = jpeg_std_error(&jpeg.errors);
    jpeg.errors.error_exit = jump_out;
    jpeg.errors.output_message = say_nothing;
    jpeg.file.client_data = &jpeg;
    if (setjmp(jpeg.way_out) != 0)
        return false;
    jpeg_create_decompress(&jpeg.file);
    jpeg_mem_src(&jpeg.file, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_read_header(&jpeg.file, TRUE);
    return true;
}

/// @param rgb  room for width * height pixels of three bytes
bool read_rows(Jpeg& jpeg, unsigned char* rgb)
{
    if (setjmp(jpeg.way_out) != 0)
        return false;
    jpeg.file.out_color_space = JCS_RGB;
    jpeg_start_decompress(&jpeg.file);
    while (jpeg.file.output_scanline < jpeg.file.output_height) {
        JSAMPROW row = rgb + std::size_t{3} * jpeg.file.output_scanline * jpeg.file.output_width;
        jpeg_read_scanlines(&jpeg.file, &row, 1);
    }
    return true;
}

ImageFile read_jpeg_image(std::string_view bytes, const std::string& place)
{
    struct Handle {
        Jpeg jpeg;
        ~Handle() { jpeg_destroy_decompress(&jpeg.file); }
    } handle;
    Jpeg& jpeg = handle.jpeg;
    if (!begin(jpeg, bytes))
        refuse(place, "JPEG", jpeg.message);
    check_picture_size(place, jpeg.file.image_width, jpeg.file.image_height, channels, bytes.size());
    ImageFile image{static_cast<int>(jpeg.file.image_width), static_cast<int>(jpeg.file.image_height), {}};
    const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    std::vector<std::uint8_t> rgb(3 * pixels);
    if (!read_rows(jpeg, rgb.data()))
        refuse(place, "JPEG", jpeg.message);
    image.rgba.resize(4 * pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        for (std::size_t c = 0; c < 3; ++c)
            image.rgba[4 * i + c] = rgb[3 * i + c];
        image.rgba[4 * i + 3] = 255;
    }
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
