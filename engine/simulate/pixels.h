#pragma once

#include "engine/pictures/picture.h"
#include "engine/sampling/statistics.h"
#include "engine/scene/view.h"
#include "engine/simulate/path_tracer.h"

#include <array>
#include <unordered_map>

/// \file Pixels of one picture; nothing outside engine/simulate includes it.
namespace lightwell {

/// Whether two sights show the same surface, near enough to interpolate between them.
bool same_surface(const Sight& a, const Sight& b);

inline constexpr std::size_t pixel_channel_count = 13;
extern const char* const pixel_channels[pixel_channel_count];
/// One value for each of pixel_channels.
using PixelValue = std::array<float, pixel_channel_count>;

/// Sums over the paths of one pixel.
struct PixelResult {
    RunningStatistics channel[3], luminance, illuminance;
    double depth_sum = 0;
    Vec3 normal_sum;
    int met = 0;
};
PixelValue value_of(const PixelResult& result, int samples);

/// A pixel by its own paths: a pure function of its place.
struct PixelTask {
    const Camera& camera;
    const PathTracer& tracer;
    int width, height;
    std::uint64_t seed;

    /// @param same_paths  all replicates follow the same paths, so that only their ambient light differs
    PixelResult measure(int x, int y, int samples, bool same_paths = false) const;
    /// Luminance of a few of its paths, cd/m^2.
    double probe(int x, int y, int paths) const;
    /// What its middle shows.
    Sight sight(int x, int y) const noexcept;

private:
    PathRandom random_of(int x, int y, int replicate, std::uint32_t path) const noexcept;
    void add_path(PixelResult& result, int x, int y, int replicate, PathRandom random, Spectrum& radiance,
                  Spectrum& irradiance) const;
};

struct ImageSampling {
    int samples;          ///< paths of a pixel of its own
    double tolerance = 0; ///< relative difference of luminance and of illuminance that neighbours may have; 0: every
                          ///< pixel has the same number of paths
    double usual_error =
        0; ///< of this picture's pixels, relative: far above it and the tolerance, there are more paths
};

/// The pixels of a part of a picture: every other one in both directions by its own paths, those between by
/// interpolation where the neighbours agree, its middle shows the same surface and a few paths bring nothing else,
/// else by their own paths too.
/// Where the pixels around are noisy or far apart, as at the edge of a shadow, own paths are four times as many: what
/// decides that has no part in the pixel's own value, so that it is not biased.
/// A pixel has the same value whatever part it is asked from.
/// Error: biased by interpolation, less than the tolerance where luminance is smooth
/// Source  Ward 1994, Section 3.1 (image plane sampling), with a few rays to each pixel so that nothing thin is lost
class PixelField {
public:
    PixelField(const PixelTask& task, const ImageSampling& image) : task_(task), image_(image) {}
    const PixelValue& at(int x, int y);

private:
    struct Pixel {
        PixelValue value;
        Sight sight;
    };
    const Pixel& first(int x, int y);
    const Pixel& own(int x, int y);
    bool beside_noise(int x, int y);
    bool interpolated(int x, int y, PixelValue& value);

    const PixelTask& task_;
    ImageSampling image_;
    std::unordered_map<std::int64_t, Pixel> first_, own_; ///< by the usual paths, and by those it deserves
    PixelValue last_{};
};

/// Writes a pixel's value to all channels.
void put(Picture& picture, std::size_t at, const PixelValue& value);

} // namespace lightwell
