#pragma once

#include "engine/base/progress.h"
#include "engine/base/quantities.h"
#include "engine/base/report.h"
#include "engine/base/tally.h"
#include "engine/direct/settings.h"
#include "engine/pictures/picture.h"
#include "engine/plan/plan.h"
#include "engine/scene/scene.h"
#include "engine/simulate/ambient_light.h"
#include "engine/sources/secondary_sources.h"

#include <cstdint>
#include <filesystem>
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

/// Techniques that can be switched off to see what each buys. `unbiased` in the settings switches all of the first
/// three off.
struct Techniques {
    bool deep_field = true; ///< further bounces from engine/ambient's deep field; else by scattered rays
    bool cache = true; ///< ambient light of the first surface by interpolation, where there are many pixels or sensors
    bool gradients = true;      ///< of the records
    bool image_sampling = true; ///< pixels between others that agree are interpolated; else each has its own paths
    bool hessian = true;        ///< decides the distance between records; else the harmonic mean distance alone
};

/// Ambient light kept on disk, for the next view, the next run and other processes at the same time.
struct AmbientFile {
    std::filesystem::path file; ///< empty: none. Not for `unbiased`, which keeps nothing
    /// Accuracy that ambient light is found for; 0: that of the result. Results share a file only at one accuracy.
    double accuracy = 0;
};

struct PictureSettings {
    int width = 960, height = 540;
    int samples = 0;        ///< paths per pixel; 0: chosen from `accuracy` by a pilot run over a few hundred pixels
    double accuracy = 0.05; ///< wanted median over the pixels of standard error / luminance
    std::uint64_t seed = 1;
    int threads = 0;       ///< 0: all processors; the result does not depend on it
    bool unbiased = false; ///< plain path tracing: no cache, no interpolation, only noise
    Techniques techniques = {};
    AmbientFile ambient_file = {};
    /// The part that is wanted; width 0: all. Its pixels have the same bits as those of the whole picture.
    Tile region = {};
};

/// The pixels that are wanted: the region, or all. Tiles are counted from its corner.
/// @throws InputError when the region is not within the picture
Tile wanted_pixels(const PictureSettings& settings);

/// Difference of a result to plain path tracing at a few pixels or sensors, relative to their mean: what
/// interpolation and coarse further bounces do, apart from the noise that the standard errors state.
struct BiasEstimate {
    double mean = 0;           ///< mean difference / mean value
    double standard_error = 0; ///< of that
    double spread = 0;         ///< root mean square of the single differences, noise subtracted
    int points = 0;            ///< looked at; 0: the result is unbiased, or was not checked
};

/// What was built for a result: 0 for stages that the scene or the settings did without.
struct WorkCounts {
    std::size_t deep_sites = 0, bright_discs = 0, ambient_records = 0;
    std::size_t sites_kept = 0, records_kept = 0; ///< of these, taken from the file of kept light
    std::size_t secondary_sources = 0;            ///< openings that rays were aimed at
    // Rays by what they were for: the same for any number of threads.
    RayCounts ambient_rays; ///< before any value: sites, records
    RayCounts fixed_rays;   ///< to choose the samples and to check the bias
    RayCounts value_rays;   ///< for the values themselves

    RayCounts rays() const noexcept
    {
        RayCounts sum = ambient_rays;
        sum += fixed_rays;
        sum += value_rays;
        return sum;
    }
};

/// Where finished tiles go, and where those of an interrupted run come from. May be called from several threads.
struct TileStore {
    std::function<std::optional<Picture>(const Tile&)> stored = {};
    std::function<void(const Tile&, const Picture&)> finished = {};
};

struct PictureResult {
    Picture picture; ///< of the region; channels as in picture.h, with error.R, error.G, error.B, error.Y (1 standard
                     ///< error)
    double median_relative_error = 0; ///< of luminance, over the pixels that are not black
    BiasEstimate bias;
    WorkCounts work;
    int samples = 0;
    double seconds = 0;
    Report report; ///< damage found in the file of kept light
};

/// Channels of a picture and of the tiles that a TileStore gets.
std::vector<std::string> tile_channels();

struct GridSettings {
    int samples = 0;        ///< paths per sensor; 0: chosen from `accuracy` by a pilot run
    double accuracy = 0.02; ///< wanted median over the sensors of standard error / illuminance
    std::uint64_t seed = 1;
    int threads = 0;
    bool unbiased = false;
    Techniques techniques = {};
    AmbientFile ambient_file = {};
};

/// Illuminance on the front side of each sensor, with one standard error.
struct GridResult {
    std::vector<Illuminance> values;
    std::vector<Illuminance> standard_errors;
    std::vector<Illuminance> biases; ///< expected value - truth of each, apart from its standard error; empty: unbiased
    Illuminance mean_standard_error; ///< of the mean over the sensors: they share ambient light, so their errors too
    BiasEstimate bias;
    WorkCounts work;
    double median_relative_error = 0;
    int samples = 0;
    double seconds = 0;
    Report report;
};

/// What is made ready with a scene, for all its pictures and grids.
struct Preparation {
    int virtual_depth = 2;       ///< mirrors one after the other that virtual sources stand behind; 0: none
    bool virtual_sources = true; ///< false: as a depth of 0
    /// Rays that look do not see surfaces from behind (BackFaces::unseen, engine/accel/ray_queries.h).
    bool backs_unseen = false;
    DirectSettings direct = {};
    SecondarySettings secondary = {}; ///< openings that rays are aimed at
    /// Diffuse interreflection as other programs limit it; results are then found as with `unbiased`.
    std::optional<AmbientLimit> ambient_limit = {};
};

/// What was made ready for a scene, by stage: 0 for those that its plan does without.
struct PreparedStages {
    std::size_t lamps = 0, suns = 0;
    std::size_t openings = 0;        ///< panes at which rays to the sky are aimed
    std::size_t mirrors = 0;         ///< flat ones that are followed
    std::size_t virtual_sources = 0; ///< images of lamps and suns
    std::size_t see_through = 0;     ///< materials that shadow rays pass, weakened
    std::size_t both_sides = 0;      ///< materials whose back is looked at too: translucent ones
    std::size_t patterns = 0;        ///< by which sources vary
};

struct SimulationParts;

/// A scene made ready for light: ray queries, list of sources. Rendering does not change it.
/// Error: with `unbiased` only noise; else interpolated ambient light adds a bias, estimated with each result. The
/// standard error stated with each value is that of the mean of eight independent replicates.
class Simulation {
public:
    /// @throws InputError from validate(scene), and for a preparation out of range
    explicit Simulation(Scene scene, const Preparation& preparation = {});
    ~Simulation();
    Simulation(Simulation&&) noexcept;
    Simulation& operator=(Simulation&&) noexcept;

    const Scene& scene() const noexcept;
    const Preparation& preparation() const noexcept;
    /// What the scene needs, by which stages were built or left out.
    const Plan& plan() const noexcept;
    PreparedStages prepared() const;
    /// Bytes held beside the scene itself by the ray queries.
    std::size_t query_bytes() const noexcept;
    /// @throws InputError for an unusable view, Cancelled when progress says stop
    PictureResult render(const View& view, const PictureSettings& settings, const Progress& progress = {},
                         const TileStore& tiles = {}) const;
    GridResult illuminance(const SensorGrid& grid, const GridSettings& settings, const Progress& progress = {}) const;

private:
    std::unique_ptr<SimulationParts> parts_;
};

} // namespace lightwell
