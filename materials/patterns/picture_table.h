#pragma once

#include "engine/base/spectrum.h"

#include <filesystem>
#include <vector>

namespace lightwell {

/// A picture as a pattern: its shorter side is one unit long, (0, 0) its lower left corner.
class PictureTable {
public:
    /// Radiance RGBE and XYZE, OpenEXR, PNG and JPEG, by their content; the last two are decoded from sRGB.
    /// @throws InputError  missing, damaged, of another kind, without R G B
    static PictureTable read(const std::filesystem::path& file);
    /// @param pixels  row 0 at the top
    PictureTable(int width, int height, std::vector<Spectrum> pixels);

    /// Linear between the middles of pixels; outside, continued for one pixel, then falling off.
    Spectrum at(double u, double v) const noexcept;

private:
    Spectrum pixel(int x, int y) const noexcept
    {
        return pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
    }
    int width_, height_;
    double pixels_per_unit_;
    std::vector<Spectrum> pixels_;
};

} // namespace lightwell
