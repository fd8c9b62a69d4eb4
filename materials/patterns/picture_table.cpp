#include "materials/patterns/picture_table.h"

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/text.h"
#include "engine/pictures/exr.h"
#include "engine/pictures/jpeg.h"
#include "engine/pictures/png.h"
#include "engine/pictures/rgbe.h"
#include "materials/patterns/spectral_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lightwell {
namespace {

/// What the pixels of a Radiance picture were multiplied by before they were stored: patterns count what is stored.
double stored_factor(const Picture& picture)
{
    const auto exposure = picture.header.find("EXPOSURE");
    return exposure == picture.header.end() ? 1 : parse_double(exposure->second).value_or(1);
}

PictureTable of_channels(const Picture& picture, const std::string& file, double factor)
{
    for (const char* channel : {"R", "G", "B"})
        if (!picture.channels.contains(channel))
            throw InputError{file, std::string("the picture has no channel ") + channel, "give one with R, G and B"};
    std::vector<Spectrum> pixels;
    const auto &r = picture.channels.at("R"), &g = picture.channels.at("G"), &b = picture.channels.at("B");
    for (std::size_t i = 0; i < r.size(); ++i)
        pixels.push_back(Spectrum{r[i], g[i], b[i]} * factor);
    return {picture.width, picture.height, pixels};
}

std::array<double, 256> plain_values()
{
    std::array<double, 256> values;
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = static_cast<double>(i) / 255;
    return values;
}

std::array<double, 256> linear_of_srgb()
{
    std::array<double, 256> values = plain_values();
    for (double& value : values)
        value = srgb_to_linear(value);
    return values;
}

/// @param x, y  which square, from the upper left corner
Spectrum mean_of_square(const ImageFile& image, const std::array<double, 256>& values, int x, int y, int side)
{
    Spectrum sum;
    for (int row = y * side; row < std::min((y + 1) * side, image.height); ++row)
        for (int column = x * side; column < std::min((x + 1) * side, image.width); ++column) {
            const std::size_t at = static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                                   static_cast<std::size_t>(column);
            const std::uint8_t* pixel = &image.rgba[4 * at];
            sum += Spectrum{values[pixel[0]], values[pixel[1]], values[pixel[2]]};
        }
    const double count = static_cast<double>(std::min(side, image.height)) * std::min(side, image.width);
    return sum / count;
}

PictureTable of_display(const DisplayPicture& picture)
{
    const std::array<double, 256> linear = linear_of_srgb();
    std::vector<Spectrum> pixels;
    for (std::size_t i = 0; i + 2 < picture.rgb.size(); i += 3)
        pixels.push_back(from_rec709({linear[picture.rgb[i]], linear[picture.rgb[i + 1]], linear[picture.rgb[i + 2]]}));
    return {picture.width, picture.height, pixels};
}

/// The step between two middles of pixels and how far within it; a single row or column is the same everywhere.
struct Step {
    int low, high;
    double x;
};

Step step_of(double place, int count) noexcept
{
    if (count < 2)
        return {0, 0, 0};
    const double step = std::clamp(std::floor(place), 0.0, count - 2.0);
    return {static_cast<int>(step), static_cast<int>(step) + 1, place - step};
}

Spectrum between(const Spectrum& low, const Spectrum& high, double x) noexcept
{
    if (x > 2)
        return (high * 2 - low) / (x - 1);
    if (x < -1)
        return (low * 2 - high) / -x;
    return low * (1 - x) + high * x;
}

} // namespace

PictureTable PictureTable::read(const std::filesystem::path& file)
{
    std::string start;
    {
        const MappedFile mapped(file);
        if (is_spectral_picture(mapped.bytes()))
            return read_spectral_picture(mapped.bytes(), file.string());
        start = mapped.bytes().substr(0, 8);
    }
    if (start.starts_with("#?")) {
        const Picture picture = read_rgbe(file);
        return of_channels(picture, file.string(), stored_factor(picture));
    }
    if (start.starts_with("\x76\x2f\x31\x01"))
        return of_channels(read_exr(file), file.string(), 1);
    if (start.starts_with("\x89PNG"))
        return of_display(read_png(file));
    if (start.starts_with("\xff\xd8\xff"))
        return of_display(read_jpeg(file));
    throw InputError{file.string(), "no picture of a kind that is read",
                     "Radiance, OpenEXR, PNG and JPEG pictures are"};
}

PictureTable PictureTable::read_stored(const std::filesystem::path& file)
{
    const MappedFile mapped(file);
    return of_image(read_image(mapped.bytes(), file.string()), false);
}

PictureTable PictureTable::of_image(const ImageFile& image, bool colours)
{
    const std::array<double, 256> values = colours ? linear_of_srgb() : plain_values();
    int side = 1; // of the squares that become one pixel
    while (static_cast<std::size_t>(image.width / side) * static_cast<std::size_t>(image.height / side) >
           most_laid_pixels)
        ++side;
    const int width = std::max(1, image.width / side), height = std::max(1, image.height / side);
    std::vector<Spectrum> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Spectrum mean = mean_of_square(image, values, x, y, side);
            pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] =
                colours ? from_rec709(mean) : mean;
        }
    return {width, height, pixels};
}

PictureTable::PictureTable(int width, int height, const std::vector<Spectrum>& pixels)
    : width_(width), height_(height), pixels_per_unit_(std::min(width, height))
{
    pixels_.reserve(pixels.size());
    for (const Spectrum& pixel : pixels)
        pixels_.push_back({static_cast<float>(pixel.r), static_cast<float>(pixel.g), static_cast<float>(pixel.b)});
}

Spectrum PictureTable::at(double u, double v) const noexcept
{
    if (!std::isfinite(u) || !std::isfinite(v))
        return {};
    const Step column = step_of(u * pixels_per_unit_ - 0.5, width_);
    const Step row = step_of(v * pixels_per_unit_ - 0.5, height_); // from below
    const auto across = [&](int y) {
        return between(pixel(column.low, height_ - 1 - y), pixel(column.high, height_ - 1 - y), column.x);
    };
    return between(across(row.low), across(row.high), row.x);
}

} // namespace lightwell
