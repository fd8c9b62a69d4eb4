#pragma once

#include "engine/base/progress.h"
#include "engine/base/quantities.h"
#include "engine/pictures/picture.h"
#include "engine/scene/scene.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace lightwell {

/// A rectangle of pixels, row 0 at the top.
struct Tile {
    int x = 0, y = 0, width = 0, height = 0;
};
inline constexpr int tile_size = 32;

struct PictureSettings {
    int width = 960, height = 540;
    int samples = 0;        ///< paths per pixel; 0: chosen from `accuracy` by a pilot run over a few hundred pixels
    double accuracy = 0.05; ///< wanted median over the pixels of standard error / luminance
    std::uint64_t seed = 1;
    int threads = 0; ///< 0: all processors; the result does not depend on it
    /// Each pixel is estimated by its own paths alone. Else neighbouring pixels of the same surface share their
    /// indirect irradiance (engine/simulate/shared_irradiance.h), which is biased where it varies quickly.
    bool unbiased = false;
};

/// Where finished tiles go, and where those of an interrupted run come from. May be called from several threads.
struct TileStore {
    std::function<std::optional<Picture>(const Tile&)> stored = {};
    std::function<void(const Tile&, const Picture&)> finished = {};
};

struct PictureResult {
    Picture picture; ///< channels as in picture.h, with error.R, error.G, error.B, error.Y (1 standard error)
    double median_relative_error = 0; ///< of luminance, over the pixels that are not black
    /// Root mean square over tiles of the relative difference that sharing made, beyond what noise explains.
    double sharing_bias = 0;
    int samples = 0;
    double seconds = 0;
};

/// Channels of the tiles that a TileStore gets: those of the result and what sharing needs.
std::vector<std::string> tile_channels();

struct GridSettings {
    int samples = 0;        ///< paths per sensor; 0: chosen from `accuracy` by a pilot run
    double accuracy = 0.02; ///< wanted median over the sensors of standard error / illuminance
    std::uint64_t seed = 1;
    int threads = 0;
};

/// Illuminance on the front side of each sensor, with one standard error.
struct GridResult {
    std::vector<Illuminance> values;
    std::vector<Illuminance> standard_errors;
    double median_relative_error = 0;
    int samples = 0;
    double seconds = 0;
};

/// A scene made ready for light: ray queries, list of sources. Rendering does not change it.
/// Error: grids and pictures with `unbiased` are unbiased; the standard error stated with each value is that of the
/// mean of eight independent replicates.
class Simulation {
public:
    /// @throws InputError from validate(scene)
    explicit Simulation(Scene scene);
    ~Simulation();
    Simulation(Simulation&&) noexcept;
    Simulation& operator=(Simulation&&) noexcept;

    const Scene& scene() const noexcept;
    /// Bytes held beside the scene itself by the ray queries.
    std::size_t query_bytes() const noexcept;
    /// @throws InputError for an unusable view, Cancelled when progress says stop
    PictureResult render(const View& view, const PictureSettings& settings, const Progress& progress = {},
                         const TileStore& tiles = {}) const;
    GridResult illuminance(const SensorGrid& grid, const GridSettings& settings, const Progress& progress = {}) const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace lightwell
