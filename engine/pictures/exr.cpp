#include "engine/pictures/exr.h"

#include "engine/base/files.h"
#include "engine/pictures/exr_file.h"
#include "engine/pictures/limits.h"

namespace lightwell {

namespace {

/// A few KiB packed per tile and channel: small enough to look at a corner of a picture, large enough to pack well.
constexpr int final_tile_size = 64;

} // namespace

void write_exr(const Picture& picture, const std::filesystem::path& file, ExrUse use)
{
    check_picture(file.string(), picture);
    check_exr_layout(file.string(), picture, final_tile_size);
    write_atomically(file, [&](const std::filesystem::path& temporary) {
        ExrWriter writer(temporary, picture, final_tile_size, false, use);
        for (int y = 0; y < picture.height; y += final_tile_size)
            for (int x = 0; x < picture.width; x += final_tile_size)
                writer.write_tile(x, y, picture, 0, 0);
        writer.close();
    });
}

Picture read_exr(const std::filesystem::path& file)
{
    const MappedFile mapped(file);
    return read_exr_bytes(mapped.bytes(), file.string());
}

} // namespace lightwell
