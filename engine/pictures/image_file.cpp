#include "engine/pictures/image_file.h"

#include "engine/base/errors.h"
#include "engine/pictures/limits.h"

#include <algorithm>
#include <csetjmp>
#include <cstdio> // jpeglib.h forgets it
#include <jpeglib.h>
#include <png.h>

namespace lightwell {
namespace {

constexpr std::int64_t channels = 4;
/// A picture of a material may take this much memory, or three times its file, whichever is more: 5800 x 5800 pixels.
constexpr std::size_t least_bound_bytes = std::size_t{1} << 27;

bool fits(std::size_t width, std::size_t height, std::size_t file_bytes)
{
    return width * height * channels <= std::max(least_bound_bytes, 3 * file_bytes);
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
    if (!fits(handle.png.width, handle.png.height, bytes.size()))
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

/// Fixes the scale of the picture that comes out, which jpeg.file.output_width and _height then tell.
bool start(Jpeg& jpeg, unsigned scale_denominator)
{
    if (setjmp(jpeg.way_out) != 0)
        return false;
    jpeg.file.out_color_space = JCS_RGB;
    jpeg.file.scale_num = 1;
    jpeg.file.scale_denom = scale_denominator;
    jpeg_start_decompress(&jpeg.file);
    return true;
}

/// @param row   room for three bytes a pixel of one row
/// @param rgba  room for four bytes a pixel of the whole
bool read_rows(Jpeg& jpeg, unsigned char* row, unsigned char* rgba)
{
    if (setjmp(jpeg.way_out) != 0)
        return false;
    while (jpeg.file.output_scanline < jpeg.file.output_height) {
        JSAMPROW rows[1] = {row};
        unsigned char* to = rgba + std::size_t{4} * jpeg.file.output_scanline * jpeg.file.output_width;
        jpeg_read_scanlines(&jpeg.file, rows, 1);
        for (std::size_t x = 0; x < jpeg.file.output_width; ++x) {
            for (std::size_t c = 0; c < 3; ++c)
                to[4 * x + c] = row[3 * x + c];
            to[4 * x + 3] = 255;
        }
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
    const std::size_t width = jpeg.file.image_width, height = jpeg.file.image_height;
    check_picture_size(place, static_cast<std::int64_t>(width), static_cast<std::int64_t>(height), channels,
                       bytes.size());
    unsigned denominator = 1;
    while (denominator < 8 && !fits(width / denominator, height / denominator, bytes.size()))
        denominator *= 2;
    if (!start(jpeg, denominator))
        refuse(place, "JPEG", jpeg.message);
    ImageFile image{static_cast<int>(jpeg.file.output_width), static_cast<int>(jpeg.file.output_height), {}};
    std::vector<std::uint8_t> row(std::size_t{3} * jpeg.file.output_width);
    image.rgba.resize(std::size_t{4} * jpeg.file.output_width * jpeg.file.output_height);
    if (!read_rows(jpeg, row.data(), image.rgba.data()))
        refuse(place, "JPEG", jpeg.message);
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
