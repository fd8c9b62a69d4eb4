#pragma once

#include "engine/base/spectrum.h"
#include "engine/pictures/image_file.h"

#include <array>
#include <filesystem>
#include <vector>

namespace lightwell {

/// A picture as a pattern: its shorter side is one unit long, (0, 0) its lower left corner.
class PictureTable {
public:
    /// Radiance RGBE and XYZE, OpenEXR, PNG and JPEG, by their content; the last two are decoded from sRGB.
    /// @throws InputError  missing, damaged, of another kind, without R G B
    static PictureTable read(const std::filesystem::path& file);
    /// PNG or JPEG whose numbers mean no colour: as they are stored, 0 to 1.
    /// @throws InputError  missing, damaged, of another kind
    static PictureTable read_stored(const std::filesystem::path& file);
    /// The same of an image that is in memory. One of more than `most_laid_pixels` is made smaller by means of whole
    /// squares of pixels.
    /// @param colours  decoded from sRGB to the engine's primaries; else as stored
    static PictureTable of_image(const ImageFile& image, bool colours);
    /// A picture on a wall is no sharper in the rooms that we calculate; each pixel takes 12 bytes.
    static constexpr std::size_t most_laid_pixels = 1u << 20;
    /// @param pixels  row 0 at the top
    PictureTable(int width, int height, const std::vector<Spectrum>& pixels);
    int width() const noexcept { return width_; }
    int height() const noexcept { return height_; }

    /// Linear between the middles of pixels; outside, continued for one pixel, then falling off.
    Spectrum at(double u, double v) const noexcept;

private:
    using Pixel = std::array<float, 3>;

    Spectrum pixel(int x, int y) const noexcept
    {
        const Pixel& found =
            pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
        return {found[0], found[1], found[2]};
    }
    int width_, height_;
    double pixels_per_unit_;
    std::vector<Pixel> pixels_;
};

} // namespace lightwell
