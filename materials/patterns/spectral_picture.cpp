#include "materials/patterns/spectral_picture.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "materials/patterns/spectral_colour.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

constexpr std::string_view format = "FORMAT=Radiance_spectra";
/// More than any spectrometer tells apart, and more pixels than memory should be asked for.
constexpr long long most_components = 1024, most_side = 65536, most_pixels = 1 << 28;

class SpectralPicture {
public:
    SpectralPicture(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) { read_header(); }

    PictureTable table()
    {
        std::vector<Spectrum> pixels;
        const std::size_t width = static_cast<std::size_t>(width_), bands = static_cast<std::size_t>(components_) + 1;
        std::vector<unsigned char> line(width * bands);
        for (long long y = 0; y < height_; ++y) {
            read_line(line);
            for (std::size_t x = 0; x < width; ++x)
                pixels.push_back(colour(&line[x * bands]));
        }
        return {static_cast<int>(width_), static_cast<int>(height_), std::move(pixels)};
    }

private:
    [[noreturn]] void fail(const std::string& what) const
    {
        throw InputError{file_ + ", byte " + std::to_string(at_), what, "get the picture again from its source"};
    }
    std::string_view next_line()
    {
        const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
        const std::string_view line = bytes_.substr(at_, end - at_);
        at_ = std::min(end + 1, bytes_.size());
        return line;
    }
    void read_header()
    {
        for (std::string_view line = next_line(); !line.empty(); line = next_line()) {
            if (at_ == bytes_.size())
                fail("the header does not end");
            if (line.starts_with("NCOMP="))
                components_ = parse_integer(trimmed(line.substr(6))).value_or(0);
            else if (line.starts_with("WAVELENGTH_SPLITS="))
                read_splits(line.substr(18));
        }
        const std::vector<std::string_view> size = split(next_line(), " ");
        if (size.size() != 4 || size[0] != "-Y" || size[2] != "+X")
            fail("no size of the form -Y HEIGHT +X WIDTH");
        height_ = parse_integer(size[1]).value_or(0);
        width_ = parse_integer(size[3]).value_or(0);
        if (components_ < 1 || components_ > most_components || width_ < 1 || width_ > most_side || height_ < 1 ||
            height_ > most_side || width_ * height_ * components_ > most_pixels)
            fail(std::to_string(width_) + " x " + std::to_string(height_) + " pixels of " +
                 std::to_string(components_) + " components");
    }
    void read_splits(std::string_view text)
    {
        const std::vector<std::string_view> words = split(text, " ");
        if (words.size() != 4)
            fail("WAVELENGTH_SPLITS has not four wavelengths");
        first_nm_ = parse_double(words[0]).value_or(0);
        last_nm_ = parse_double(words[3]).value_or(0);
        if (!(first_nm_ > last_nm_ && last_nm_ > 0 && std::isfinite(first_nm_)))
            fail("the wavelengths do not fall from the first to the last");
    }
    unsigned char byte()
    {
        if (at_ >= bytes_.size())
            fail("the picture ends before its last line");
        return static_cast<unsigned char>(bytes_[at_++]);
    }
    /// Pixel after pixel, or, marked by 2 2 and the width, component after component in runs.
    void read_line(std::vector<unsigned char>& line)
    {
        const std::size_t width = static_cast<std::size_t>(width_), bands = static_cast<std::size_t>(components_) + 1;
        const auto at = [&](std::size_t i) {
            return at_ + i < bytes_.size() ? static_cast<unsigned char>(bytes_[at_ + i]) : 0u;
        };
        const bool in_runs = at(0) == 2 && at(1) == 2 && (at(2) << 8 | at(3)) == width;
        if (!in_runs) {
            for (unsigned char& value : line)
                value = byte();
            return;
        }
        at_ += 4;
        for (std::size_t band = 0; band < bands; ++band)
            for (std::size_t x = 0; x < width;) {
                const unsigned count = byte();
                const bool run = count > 128;
                const std::size_t length = run ? count & 127u : count;
                if (length == 0 || x + length > width)
                    fail("a run goes beyond the end of its line");
                const unsigned char value = run ? byte() : 0;
                for (std::size_t i = 0; i < length; ++i)
                    line[x++ * bands + band] = run ? value : byte();
            }
    }
    /// Mantissas and their common exponent.
    Spectrum colour(const unsigned char* pixel) const
    {
        const int exponent = pixel[components_];
        if (exponent == 0)
            return {};
        constexpr int bias = 136;
        const double unit = std::ldexp(1.0, exponent - bias);
        return spectral_colour([&](double nm) {
            const double place = (first_nm_ - nm) / (first_nm_ - last_nm_) * static_cast<double>(components_) - 0.5;
            const double low = std::clamp(std::floor(place), 0.0, static_cast<double>(components_ - 1));
            const auto i = static_cast<long long>(low), k = std::min(i + 1, components_ - 1);
            const double share = std::clamp(place - low, 0.0, 1.0);
            return unit * ((pixel[i] + 0.5) * (1 - share) + (pixel[k] + 0.5) * share);
        });
    }

    std::string_view bytes_;
    const std::string& file_;
    std::size_t at_ = 0;
    long long components_ = 0, width_ = 0, height_ = 0;
    double first_nm_ = 780, last_nm_ = 380;
};

} // namespace

bool is_spectral_picture(std::string_view bytes) noexcept
{
    const std::size_t header = std::min(bytes.find("\n\n"), std::min<std::size_t>(bytes.size(), 1 << 16));
    return bytes.starts_with("#?") && bytes.substr(0, header).find(format) != std::string_view::npos;
}

PictureTable read_spectral_picture(std::string_view bytes, const std::string& file)
{
    return SpectralPicture(bytes, file).table();
}

} // namespace lightwell
