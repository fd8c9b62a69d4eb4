#include "engine/pictures/jpeg.h"

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/pictures/limits.h"

#include <cstdio> // before jpeglib.h, which needs it
#include <jpeglib.h>
#include <limits>

namespace lightwell {
namespace {

constexpr int channels = 3;

/// What libjpeg says when it gives up. It is compiled to let exceptions pass.
struct Damaged {
    std::string message;
};

std::string message_of(j_common_ptr info)
{
    char text[JMSG_LENGTH_MAX];
    info->err->format_message(info, text);
    return text;
}

[[noreturn]] void give_up(j_common_ptr info)
{
    throw Damaged{message_of(info)};
}

/// Warnings of the library are damage too: it would fill what is missing with grey.
void refuse_warning(j_common_ptr info, int level)
{
    if (level < 0)
        throw Damaged{message_of(info)};
}

/// libjpeg's handle, freed however the scope ends.
struct Decoder {
    jpeg_decompress_struct info{};
    jpeg_error_mgr errors{};

    explicit Decoder(std::string_view bytes)
    {
        info.err = jpeg_std_error(&errors);
        errors.error_exit = give_up;
        errors.emit_message = refuse_warning;
        jpeg_create_decompress(&info);
        jpeg_mem_src(&info, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    }
    ~Decoder() { jpeg_destroy_decompress(&info); }
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;
};

DisplayPicture decoded(Decoder& decoder, const std::string& place, std::size_t bytes, std::size_t pixel_bound)
{
    constexpr unsigned largest_denominator = 8; // of the library's scales
    jpeg_decompress_struct& info = decoder.info;
    jpeg_read_header(&info, TRUE);
    check_picture_size(place, info.image_width, info.image_height, channels, bytes);
    info.out_color_space = JCS_RGB;
    info.scale_num = 1;
    info.scale_denom = 1;
    while (info.scale_denom < largest_denominator &&
           std::size_t{info.image_width / info.scale_denom} * (info.image_height / info.scale_denom) > pixel_bound)
        info.scale_denom *= 2;
    jpeg_start_decompress(&info);
    DisplayPicture picture{static_cast<int>(info.output_width), static_cast<int>(info.output_height), {}};
    const std::size_t row_bytes = std::size_t{info.output_width} * channels;
    picture.rgb.resize(row_bytes * info.output_height);
    while (info.output_scanline < info.output_height) {
        JSAMPROW row = picture.rgb.data() + row_bytes * info.output_scanline;
        jpeg_read_scanlines(&info, &row, 1);
    }
    jpeg_finish_decompress(&info);
    return picture;
}

} // namespace

DisplayPicture read_jpeg(std::string_view bytes, const std::string& place, std::size_t pixel_bound)
{
    try {
        Decoder decoder(bytes);
        return decoded(decoder, place, bytes.size(), pixel_bound);
    } catch (const Damaged& damage) {
        throw InputError{place, "cannot be read as JPEG: " + damage.message, "give a complete .jpg file"};
    }
}

DisplayPicture read_jpeg(const std::filesystem::path& file)
{
    const MappedFile mapped(file);
    return read_jpeg(mapped.bytes(), file.string(), std::numeric_limits<std::size_t>::max());
}

} // namespace lightwell
