#include "engine/simulate/simulate.h"

#include "engine/base/errors.h"
#include "engine/base/threads.h"
#include "engine/sampling/statistics.h"
#include "engine/simulate/path_tracer.h"
#include "engine/simulate/replicates.h"
#include "engine/simulate/shared_irradiance.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fmt/format.h>
#include <mutex>

namespace lightwell {
namespace {

constexpr int pilot_samples = 4 * replicates;
constexpr int most_samples = 1 << 20;
/// A sensor that lies in a surface is lifted off it by this share of the scene's size.
constexpr double sensor_lift = 1e-9;
/// Dimmer pixels than this share of the mean say nothing about relative accuracy.
constexpr double dark_share = 1e-4;
/// By what sharing among pixels usually divides the error of indirect irradiance: the pilot run's guess. The error
/// stated with the result is not guessed.
constexpr double usual_shrink = 10;

double seconds_since(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The median over the items that are not dark.
double median_relative(const std::vector<double>& values, const std::vector<double>& errors)
{
    double mean = 0;
    for (const double v : values)
        mean += v / static_cast<double>(values.size());
    std::vector<double> relative;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (values[i] > dark_share * mean)
            relative.push_back(errors[i] / values[i]);
    if (relative.empty())
        return 0;
    const auto middle = relative.begin() + static_cast<std::ptrdiff_t>(relative.size() / 2);
    std::nth_element(relative.begin(), middle, relative.end());
    return *middle;
}

/// Tells how far the work has come, from one thread at a time, and stops it when asked.
class Teller {
public:
    Teller(const Progress& progress, std::string stage, std::size_t total)
        : progress_(progress), stage_(std::move(stage)), total_(total)
    {
    }
    void check() const
    {
        if (progress_.stop())
            throw Cancelled{};
    }
    void done_one()
    {
        const std::lock_guard lock(mutex_);
        progress_.tell(stage_, static_cast<double>(++done_) / static_cast<double>(total_));
    }

private:
    const Progress& progress_;
    std::string stage_;
    std::size_t total_, done_ = 0;
    std::mutex mutex_;
};

struct PixelResult {
    RunningStatistics channel[3], luminance, illuminance;
    RunningStatistics rest[3], rest_luminance, indirect[3], indirect_illuminance; ///< for sharing
    Spectrum reflectance_sum;
    double closeness_sum = 0;
    double depth_sum = 0;
    Vec3 normal_sum;
    int met = 0;
};

struct PixelTask {
    const Camera& camera;
    const PathTracer& tracer;
    int width, height;
    std::uint64_t seed;
    double reach_m; ///< between the clipping distances

    PixelResult operator()(int x, int y, int samples) const
    {
        PixelResult result;
        const auto pixel =
            static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(width) + static_cast<std::uint64_t>(x);
        const auto each = static_cast<std::uint32_t>(samples / replicates);
        for (std::uint64_t r = 0; r < replicates; ++r) {
            Sums sums;
            for (std::uint32_t i = 0; i < each; ++i)
                add_path(result, x, y, PathRandom(mix_bits(seed, r), pixel, i), sums);
            add_colour(result.channel, sums.radiance / each);
            add_colour(result.rest, (sums.radiance - sums.scattered) / each);
            add_colour(result.indirect, sums.indirect / each);
            result.luminance.add(luminance_of(sums.radiance / each).value);
            result.rest_luminance.add(luminance_of((sums.radiance - sums.scattered) / each).value);
            result.illuminance.add(illuminance_of(sums.irradiance / each).value);
            result.indirect_illuminance.add(illuminance_of(sums.indirect / each).value);
        }
        return result;
    }

private:
    /// Over the paths of one replicate.
    struct Sums {
        Spectrum radiance, irradiance;
        Spectrum indirect;  ///< irradiance on the first surface by scattered rays
        Spectrum scattered; ///< what that surface sends to the eye of it, diffusely
    };
    static void add_colour(RunningStatistics (&means)[3], Spectrum colour)
    {
        means[0].add(colour.r);
        means[1].add(colour.g);
        means[2].add(colour.b);
    }
    void add_path(PixelResult& result, int x, int y, PathRandom random, Sums& sums) const
    {
        const UnitSquare jitter = random.pair();
        ViewRay start;
        if (!camera.ray((x + jitter.u) / width, 1 - (y + jitter.v) / height, start))
            return;
        const PathSample path = tracer.sample({start.origin, start.direction, reach_m}, random);
        sums.radiance += path.radiance;
        if (!path.met_surface)
            return;
        sums.irradiance += path.irradiance;
        sums.indirect += path.indirect_irradiance;
        sums.scattered += path.indirect_irradiance * path.diffuse_reflectance / pi;
        result.reflectance_sum += path.diffuse_reflectance;
        result.closeness_sum += path.closeness_per_m;
        result.depth_sum += path.distance_m;
        result.normal_sum += path.normal;
        ++result.met;
    }
};

const char* const channel_names[] = {
    "R",       "G",       "B",       "illuminance.Y",      "Z", "N.X", "N.Y", "N.Z", "error.R",
    "error.G", "error.B", "error.Y", "error.illuminance.Y"};

Picture empty_picture(int width, int height)
{
    Picture picture{width, height, {}, {}};
    for (const std::string& name : tile_channels())
        picture.add_channel(name);
    return picture;
}

/// A mean and its standard error under the names PREFIX.C and error.PREFIX.C.
void put_for_sharing(Picture& picture, std::size_t at, const PixelResult& result, int samples)
{
    const auto set = [&](std::string name, double value) {
        picture.channels.find(name)->second[at] = static_cast<float>(value);
    };
    for (int c = 0; c < 3; ++c) {
        const std::string colour(1, "RGB"[c]);
        set(std::string("rest.").append(colour), result.rest[c].mean());
        set(std::string("error.rest.").append(colour), result.rest[c].standard_error());
        set(std::string("indirect.").append(colour), result.indirect[c].mean());
        set(std::string("error.indirect.").append(colour), result.indirect[c].standard_error());
        set(std::string("reflectance.").append(colour), result.reflectance_sum[c] / samples);
    }
    set("error.rest.Y", result.rest_luminance.standard_error());
    set("error.indirect.Y", result.indirect_illuminance.standard_error());
    set("closeness", result.closeness_sum / samples);
}

void put(Picture& picture, std::size_t at, const PixelResult& result, int samples)
{
    const auto set = [&](const char* channel, double value) {
        picture.channels.find(channel)->second[at] = static_cast<float>(value);
    };
    set("R", result.channel[0].mean());
    set("G", result.channel[1].mean());
    set("B", result.channel[2].mean());
    set("error.R", result.channel[0].standard_error());
    set("error.G", result.channel[1].standard_error());
    set("error.B", result.channel[2].standard_error());
    set("error.Y", result.luminance.standard_error());
    // A picture element that the horizon cuts: the mean over the part that shows a surface.
    const double part = static_cast<double>(result.met) / samples;
    const bool met = result.met > 0;
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    set("illuminance.Y", met ? result.illuminance.mean() / part : nothing);
    set("error.illuminance.Y", met ? result.illuminance.standard_error() / part : nothing);
    set("Z", met ? result.depth_sum / result.met : infinity);
    const Vec3 normal = normalized(result.normal_sum);
    set("N.X", normal.x);
    set("N.Y", normal.y);
    set("N.Z", normal.z);
    put_for_sharing(picture, at, result, samples);
}

void copy_tile(Picture& picture, const Tile& tile, const Picture& part)
{
    for (auto& [name, values] : picture.channels) {
        const std::vector<float>& from = part.channels.at(name);
        for (int y = 0; y < tile.height; ++y)
            std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(y) * tile.width, tile.width,
                        values.begin() + static_cast<std::ptrdiff_t>(tile.y + y) * picture.width + tile.x);
    }
}

void drop_sharing_channels(Picture& picture)
{
    for (const std::string& name : sharing_channels())
        picture.channels.erase(name);
}

std::vector<Tile> tiles_of(int width, int height)
{
    std::vector<Tile> tiles;
    for (int y = 0; y < height; y += tile_size)
        for (int x = 0; x < width; x += tile_size)
            tiles.push_back({x, y, std::min(tile_size, width - x), std::min(tile_size, height - y)});
    return tiles;
}

/// The pilot run: an even lattice of pixels, as many as tell the median to a few percent.
int pilot_pixels(const PixelTask& pixel, const PictureSettings& settings, const Progress& progress)
{
    constexpr int columns = 24, rows = 16;
    const int nx = std::min(columns, settings.width), ny = std::min(rows, settings.height);
    std::vector<double> values(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny)), errors(values.size());
    Teller teller(progress, "pilot run", values.size());
    parallel_for(values.size(), settings.threads, [&](std::size_t i) {
        teller.check();
        const int column = static_cast<int>(i) % nx, row = static_cast<int>(i) / nx;
        const PixelResult result = pixel((2 * column + 1) * settings.width / (2 * nx),
                                         (2 * row + 1) * settings.height / (2 * ny), pilot_samples);
        values[i] = result.luminance.mean();
        const double factor = result.reflectance_sum.g / pilot_samples / (pi * usual_shrink);
        errors[i] = settings.unbiased ? result.luminance.standard_error()
                                      : std::hypot(result.rest_luminance.standard_error(),
                                                   factor * result.indirect_illuminance.standard_error());
        teller.done_one();
    });
    return samples_for(median_relative(values, errors), pilot_samples, settings.accuracy, most_samples);
}

int whole_replicates(int samples)
{
    return std::max(1, (samples + replicates - 1) / replicates) * replicates;
}

void check_size(const View& view, const PictureSettings& settings)
{
    constexpr int most_pixels_a_side = 1 << 15;
    for (const int size : {settings.width, settings.height})
        if (size < 1 || size > most_pixels_a_side)
            throw InputError{"view " + view.name, fmt::format("picture size is {} x {}, expected 1 to {} a side",
                                                              settings.width, settings.height, most_pixels_a_side)};
}

void check_accuracy(double accuracy, const std::string& place)
{
    if (!(accuracy > 0 && accuracy < 1))
        throw InputError{place, fmt::format("accuracy is {}, expected between 0 and 1", accuracy), "write 5% or 0.05"};
}

} // namespace

std::vector<std::string> tile_channels()
{
    std::vector<std::string> names(std::begin(channel_names), std::end(channel_names));
    names.insert(names.end(), sharing_channels().begin(), sharing_channels().end());
    return names;
}

int samples_for(double found, int pilot, double wanted, int most) noexcept
{
    const double ratio = found / wanted;
    const double samples = std::min(pilot * ratio * ratio, static_cast<double>(most));
    return whole_replicates(static_cast<int>(std::ceil(samples)));
}

struct Simulation::Parts {
    Scene scene;
    RayQueries rays;
    SourceList sources;
    PathTracer tracer;
    double size_m;

    explicit Parts(Scene&& s)
        : scene(std::move(s)), rays(scene), sources(scene, rays), tracer(scene, rays, sources),
          size_m(bounds(scene).diagonal())
    {
    }
};

Simulation::Simulation(Scene scene)
{
    validate(scene);
    parts_ = std::make_unique<Parts>(std::move(scene));
}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

const Scene& Simulation::scene() const noexcept
{
    return parts_->scene;
}

std::size_t Simulation::query_bytes() const noexcept
{
    return parts_->rays.bytes();
}

PictureResult Simulation::render(const View& view, const PictureSettings& settings, const Progress& progress,
                                 const TileStore& store) const
{
    const auto start = std::chrono::steady_clock::now();
    check_size(view, settings);
    check_accuracy(settings.accuracy, "view " + view.name);
    const Camera camera(view);
    const PixelTask pixel{camera,          parts_->tracer, settings.width,
                          settings.height, settings.seed,  view.aft_m > 0 ? view.aft_m - view.fore_m : infinity};
    PictureResult result;
    result.samples =
        settings.samples > 0 ? whole_replicates(settings.samples) : pilot_pixels(pixel, settings, progress);
    result.picture = empty_picture(settings.width, settings.height);
    const std::vector<Tile> tiles = tiles_of(settings.width, settings.height);
    Teller teller(progress, "view " + view.name, tiles.size());
    parallel_for(tiles.size(), settings.threads, [&](std::size_t i) {
        const Tile& tile = tiles[i];
        std::optional<Picture> part = store.stored ? store.stored(tile) : std::nullopt;
        if (!part) {
            part = empty_picture(tile.width, tile.height);
            for (int y = 0; y < tile.height; ++y) {
                teller.check();
                for (int x = 0; x < tile.width; ++x)
                    put(*part,
                        static_cast<std::size_t>(y) * static_cast<std::size_t>(tile.width) +
                            static_cast<std::size_t>(x),
                        pixel(tile.x + x, tile.y + y, result.samples), result.samples);
            }
            if (store.finished)
                store.finished(tile, *part);
        }
        copy_tile(result.picture, tile, *part); // tiles do not overlap
        teller.done_one();
    });
    if (settings.unbiased)
        drop_sharing_channels(result.picture);
    else
        result.sharing_bias = share_irradiance(result.picture, camera, settings.threads);
    std::vector<double> luminance, error;
    for (std::size_t i = 0; i < result.picture.channels.at("R").size(); ++i) {
        const auto& c = result.picture.channels;
        luminance.push_back(luminance_of({c.at("R")[i], c.at("G")[i], c.at("B")[i]}).value);
        error.push_back(c.at("error.Y")[i]);
    }
    result.median_relative_error = median_relative(luminance, error);
    result.seconds = seconds_since(start);
    return result;
}

GridResult Simulation::illuminance(const SensorGrid& grid, const GridSettings& settings, const Progress& progress) const
{
    const auto start = std::chrono::steady_clock::now();
    check_accuracy(settings.accuracy, "grid " + grid.name);
    std::vector<double> values(grid.sensors.size()), errors(grid.sensors.size());
    const auto measure = [&](const char* stage, int samples, std::size_t step) {
        const std::size_t count = (grid.sensors.size() + step - 1) / step;
        Teller teller(progress, stage + grid.name, count);
        parallel_for(count, settings.threads, [&](std::size_t k) {
            teller.check();
            const std::size_t i = k * step;
            const Sensor& sensor = grid.sensors[i];
            Hit here;
            here.position = sensor.position;
            here.error_m =
                sensor_lift * parts_->size_m + 64 * std::numeric_limits<double>::epsilon() * max_abs(sensor.position);
            RunningStatistics mean;
            const auto each = static_cast<std::uint32_t>(samples / replicates);
            for (std::uint64_t r = 0; r < replicates; ++r) {
                Spectrum sum;
                for (std::uint32_t n = 0; n < each; ++n) {
                    PathRandom random(mix_bits(settings.seed, r), i, n);
                    sum += parts_->tracer.irradiance(here, normalized(sensor.normal), random);
                }
                mean.add(illuminance_of(sum / each).value);
            }
            values[i] = mean.mean();
            errors[i] = mean.standard_error();
            teller.done_one();
        });
    };
    GridResult result;
    result.samples = whole_replicates(settings.samples);
    if (settings.samples <= 0) {
        constexpr std::size_t pilot_sensors = 64;
        const std::size_t step = std::max<std::size_t>(1, grid.sensors.size() / pilot_sensors);
        constexpr int pilot = 16 * pilot_samples;
        measure("pilot run, grid ", pilot, step);
        std::vector<double> some_values, some_errors;
        for (std::size_t i = 0; i < values.size(); i += step) {
            some_values.push_back(values[i]);
            some_errors.push_back(errors[i]);
        }
        result.samples = samples_for(median_relative(some_values, some_errors), pilot, settings.accuracy, most_samples);
    }
    measure("grid ", result.samples, 1);
    for (std::size_t i = 0; i < values.size(); ++i) {
        result.values.push_back(Illuminance{values[i]});
        result.standard_errors.push_back(Illuminance{errors[i]});
    }
    result.median_relative_error = median_relative(values, errors);
    result.seconds = seconds_since(start);
    return result;
}

} // namespace lightwell
