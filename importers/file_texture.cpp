#include "importers/file_texture.h"

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/pictures/image_file.h"

namespace lightwell {
namespace {

std::array<double, 256> srgb_table()
{
    std::array<double, 256> table;
    for (std::size_t i = 0; i < table.size(); ++i)
        table[i] = srgb_to_linear(static_cast<double>(i) / 255);
    return table;
}

/// Sums of whole numbers: exact for every picture that fits the bound of pixels.
struct Sums {
    std::array<std::array<std::uint64_t, 256>, 3> weights{}; ///< sum of opacities by channel and stored value
    std::array<std::uint64_t, 3> plain{};
    std::array<std::uint64_t, 256> opacities{};
};

Sums sums_of(const ImageFile& image)
{
    Sums sums;
    for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4) {
        const std::uint8_t* pixel = &image.rgba[i];
        for (std::size_t c = 0; c < 3; ++c) {
            sums.weights[c][pixel[c]] += pixel[3];
            sums.plain[c] += pixel[c];
        }
        ++sums.opacities[pixel[3]];
    }
    return sums;
}

std::string_view slice_of(std::string_view bytes, const FileTexture& texture, const std::string& place)
{
    if (texture.offset > bytes.size() || texture.length > bytes.size() - texture.offset)
        throw InputError(place, "the file has become shorter while it was read");
    return texture.length > 0 ? bytes.substr(texture.offset, texture.length) : bytes;
}

} // namespace

double PictureMeans::share_kept(double cutoff, double factor) const noexcept
{
    double kept = 0;
    for (std::size_t i = 0; i < opacity_shares.size(); ++i)
        if (static_cast<double>(i) / 255 * factor >= cutoff)
            kept += opacity_shares[i];
    return kept;
}

PictureMeans picture_means(std::string_view image_bytes, const std::string& place)
{
    static const std::array<double, 256> linear = srgb_table();
    const ImageFile image = read_image(image_bytes, place);
    const Sums sums = sums_of(image);
    const double pixels = static_cast<double>(image.rgba.size() / 4);
    double colour[3] = {}, plain[3] = {}, opacity = 0;
    for (std::size_t value = 0; value < linear.size(); ++value)
        opacity += static_cast<double>(value) * static_cast<double>(sums.opacities[value]);
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t value = 0; value < linear.size(); ++value)
            colour[c] += linear[value] * static_cast<double>(sums.weights[c][value]);
        colour[c] = opacity > 0 ? colour[c] / opacity : 0;
        plain[c] = static_cast<double>(sums.plain[c]) / (255 * pixels);
    }
    PictureMeans means{{colour[0], colour[1], colour[2]}, {plain[0], plain[1], plain[2]}, opacity / (255 * pixels), {}};
    for (std::size_t value = 0; value < linear.size(); ++value)
        means.opacity_shares[value] = static_cast<double>(sums.opacities[value]) / pixels;
    return means;
}

std::string bytes_of(const FileTexture& texture, const std::string& place)
{
    if (texture.bytes)
        return *texture.bytes;
    const MappedFile mapped(texture.file);
    return std::string(slice_of(mapped.bytes(), texture, place));
}

PictureMeans picture_means(const FileTexture& texture, const std::string& place)
{
    if (texture.bytes)
        return picture_means(*texture.bytes, place);
    const MappedFile mapped(texture.file);
    return picture_means(slice_of(mapped.bytes(), texture, place), place);
}

} // namespace lightwell
