#include "engine/base/threads.h"
#include "engine/simulate/ambient_build.h"
#include "engine/simulate/pixels.h"
#include "engine/simulate/replicates.h"

#include <algorithm>
#include <fmt/format.h>

namespace lightwell {
namespace {

/// The pilot run looks at an even lattice of pixels, as many as tell the median to a few percent; the check against
/// plain path tracing at fewer, with more paths.
constexpr int pilot_columns = 24, pilot_rows = 16, check_columns = 8, check_rows = 6;
/// Records of ambient light are looked for at every so many pixels, then between them.
constexpr int first_stride = 32, last_stride = 4;
/// They are used only where so large a share of the pixels shows the same surface as the next one: leaves and needles
/// would need a record each.
constexpr double least_connected = 0.5;

Picture empty_picture(int width, int height)
{
    Picture picture{width, height, {}, {}};
    for (const std::string& name : tile_channels())
        picture.add_channel(name);
    return picture;
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

std::vector<Tile> tiles_of(int width, int height)
{
    std::vector<Tile> tiles;
    for (int y = 0; y < height; y += tile_size)
        for (int x = 0; x < width; x += tile_size)
            tiles.push_back({x, y, std::min(tile_size, width - x), std::min(tile_size, height - y)});
    return tiles;
}

/// Luminance at an even lattice of pixels of a part of the picture.
struct Lattice {
    std::vector<int> x, y;
    std::vector<double> values, errors;
};
Lattice measure_lattice(const PixelTask& task, const Tile& part, int columns, int rows, int samples, int threads,
                        Teller& teller, bool same_paths = false)
{
    Lattice lattice;
    const int nx = std::min(columns, part.width), ny = std::min(rows, part.height);
    for (int row = 0; row < ny; ++row)
        for (int column = 0; column < nx; ++column) {
            lattice.x.push_back(part.x + (2 * column + 1) * part.width / (2 * nx));
            lattice.y.push_back(part.y + (2 * row + 1) * part.height / (2 * ny));
        }
    lattice.values.resize(lattice.x.size());
    lattice.errors.resize(lattice.x.size());
    parallel_for(lattice.x.size(), threads, [&](std::size_t i) {
        teller.check();
        const PixelResult result = task.measure(lattice.x[i], lattice.y[i], samples, same_paths);
        lattice.values[i] = result.luminance.mean();
        lattice.errors[i] = result.luminance.standard_error();
        teller.done_one();
    });
    return lattice;
}

/// Rays through the middle of pixels, and where they meet what receives ambient light.
struct Sights {
    const Camera& camera;
    const PathTracer& tracer;
    int width, height;

    bool ray(int x, int y, Ray& out) const
    {
        ViewRay start;
        if (!camera.ray((x + 0.5) / width, 1 - (y + 0.5) / height, start))
            return false;
        out = {start.origin, start.direction, start.reach_m};
        return true;
    }
    /// Share of an even lattice of pixels that show the same surface as the pixel beside them.
    double connected() const
    {
        int shown = 0, same = 0;
        for (int y = first_stride / 4; y < height; y += first_stride / 2)
            for (int x = first_stride / 4; x + 1 < width; x += first_stride / 2) {
                Ray here, beside;
                if (!ray(x, y, here) || !ray(x + 1, y, beside))
                    continue;
                const Sight sight = tracer.sight(here);
                shown += sight.met_surface ? 1 : 0;
                same += sight.met_surface && same_surface(sight, tracer.sight(beside)) ? 1 : 0;
            }
        return shown > 0 ? static_cast<double>(same) / shown : 1;
    }
    void candidates(int x, int y, std::vector<AmbientCandidate>& found) const
    {
        Ray here, beside;
        if (!ray(x, y, here) || !ray(x + 1 < width ? x + 1 : x - 1, y, beside))
            return;
        std::vector<SurfacePlace> receivers;
        PathRandom random(
            0, static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(width) + static_cast<std::uint64_t>(x), 0);
        tracer.receivers_along(here, 0, random, receivers);
        const double turn = length(beside.direction - here.direction), step = length(beside.origin - here.origin);
        for (const SurfacePlace& r : receivers)
            found.push_back({r, step + turn * length(r.position - here.origin)});
    }
};

void build(AmbientBuild& ambient, const Sights& sights, const Techniques& techniques, int threads, Teller& teller)
{
    const auto width = static_cast<std::size_t>(sights.width);
    const std::size_t pixels = width * static_cast<std::size_t>(sights.height);
    ambient.build_deep(pixels, [&](std::size_t i, PathRandom&, Ray& ray) {
        return sights.ray(static_cast<int>(i % width), static_cast<int>(i / width), ray);
    });
    if (!techniques.cache || sights.connected() < least_connected)
        return;
    for (int stride = first_stride; stride >= last_stride; stride /= 2) {
        const int offset = stride / 2;
        const int columns = (sights.width - offset + stride - 1) / stride;
        const int rows = (sights.height - offset + stride - 1) / stride;
        std::vector<std::vector<AmbientCandidate>> of_row(static_cast<std::size_t>(std::max(rows, 0)));
        parallel_for(of_row.size(), threads, [&](std::size_t row) {
            teller.check();
            for (int column = 0; column < columns; ++column)
                sights.candidates(offset + column * stride, offset + static_cast<int>(row) * stride, of_row[row]);
        });
        std::vector<AmbientCandidate> candidates;
        for (const auto& row : of_row)
            candidates.insert(candidates.end(), row.begin(), row.end());
        teller.check();
        ambient.grow(candidates);
        teller.done_one();
    }
    ambient.complete();
}

void check_size(const View& view, const PictureSettings& settings)
{
    constexpr int most_pixels_a_side = 1 << 15;
    for (const int size : {settings.width, settings.height})
        if (size < 1 || size > most_pixels_a_side)
            throw InputError{"view " + view.name, fmt::format("picture size is {} x {}, expected 1 to {} a side",
                                                              settings.width, settings.height, most_pixels_a_side)};
}

/// All tiles of a part of the picture, those kept from an interrupted run included.
Picture render_tiles(const PixelTask& pixel, const Tile& wanted, const ImageSampling& image, int threads,
                     const TileStore& store, Teller& teller)
{
    Picture picture = empty_picture(wanted.width, wanted.height);
    if (wanted.width < pixel.width || wanted.height < pixel.height)
        picture.place = {wanted.x, wanted.y, pixel.width, pixel.height};
    const std::vector<Tile> tiles = tiles_of(wanted.width, wanted.height);
    parallel_for(tiles.size(), threads, [&](std::size_t i) {
        const Tile& tile = tiles[i];
        std::optional<Picture> part = store.stored ? store.stored(tile) : std::nullopt;
        if (!part) {
            part = empty_picture(tile.width, tile.height);
            PixelField field(pixel, image);
            for (int y = 0; y < tile.height; ++y) {
                teller.check();
                for (int x = 0; x < tile.width; ++x)
                    put(*part,
                        static_cast<std::size_t>(y) * static_cast<std::size_t>(tile.width) +
                            static_cast<std::size_t>(x),
                        field.at(wanted.x + tile.x + x, wanted.y + tile.y + y));
            }
            if (store.finished)
                store.finished(tile, *part);
        }
        copy_tile(picture, tile, *part); // tiles do not overlap
        teller.done_one();
    });
    return picture;
}

double median_relative_error(const Picture& picture)
{
    std::vector<double> luminance, error;
    const auto& c = picture.channels;
    for (std::size_t i = 0; i < c.at("R").size(); ++i) {
        luminance.push_back(luminance_of({c.at("R")[i], c.at("G")[i], c.at("B")[i]}).value);
        error.push_back(c.at("error.Y")[i]);
    }
    return median_relative(luminance, error);
}

/// Adds the channel "bias.Y" to the picture, and the estimate for the whole.
void add_bias(PictureResult& result, const PixelTask& plain, const Tile& wanted, int threads, Teller& teller)
{
    Picture& picture = result.picture;
    const auto luminance_at = [&](int x, int y) {
        return luminance_of({picture.at("R", x, y), picture.at("G", x, y), picture.at("B", x, y)}).value;
    };
    const auto measure = [&](int paths) {
        const Lattice lattice = measure_lattice(plain, wanted, check_columns, check_rows, paths, threads, teller);
        std::vector<Checked> points;
        for (std::size_t i = 0; i < lattice.values.size(); ++i) {
            const int x = lattice.x[i] - wanted.x, y = lattice.y[i] - wanted.y;
            points.push_back({luminance_at(x, y), lattice.values[i], lattice.errors[i], {x + 0.0, y + 0.0, 0}});
        }
        return points;
    };
    const double all_paths = static_cast<double>(result.samples) * picture.width * picture.height;
    const BiasCheck check = check_bias(measure, result.median_relative_error, {all_paths, {}});
    result.bias = check.whole;
    const LocalBias local(check.whole, check.points);
    std::vector<float>& channel = picture.add_channel("bias.Y");
    for (int y = 0, i = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x, ++i)
            channel[static_cast<std::size_t>(i)] =
                static_cast<float>(local.at({x + 0.0, y + 0.0, 0}, luminance_at(x, y)));
}

} // namespace

std::vector<std::string> tile_channels()
{
    return {std::begin(pixel_channels), std::end(pixel_channels)};
}

Tile wanted_pixels(const PictureSettings& settings)
{
    const Tile whole{0, 0, settings.width, settings.height};
    const Tile& wanted = settings.region.width == 0 ? whole : settings.region;
    if (wanted.x < 0 || wanted.y < 0 || wanted.width < 1 || wanted.height < 1 ||
        wanted.width > whole.width - wanted.x || wanted.height > whole.height - wanted.y)
        throw InputError{
            fmt::format("region {},{},{},{}", wanted.x, wanted.y, wanted.x + wanted.width, wanted.y + wanted.height),
            fmt::format("is not inside the picture of {} x {} pixels", whole.width, whole.height),
            "give the first column and row, and the ones after the last: 0,0 is the top left pixel"};
    return wanted;
}

PictureResult Simulation::render(const View& view, const PictureSettings& settings, const Progress& progress,
                                 const TileStore& store) const
{
    const auto start = std::chrono::steady_clock::now();
    check_size(view, settings);
    check_accuracy(settings.accuracy, "view " + view.name);
    const Camera camera(view);
    const Tile wanted = wanted_pixels(settings), whole{0, 0, settings.width, settings.height};
    const bool plain = settings.unbiased || !settings.techniques.deep_field || parts_->preparation.ambient_limit;
    AmbientBuild ambient(*parts_, effort_of(settings), settings.techniques, stop_when_asked(progress),
                         plain ? "" : settings.ambient_file.file);
    RayLaps rays;
    if (!plain && !parts_->plan.needs.only_direct()) {
        Teller teller(progress, "ambient light, view " + view.name, 5);
        build(ambient, {camera, parts_->tracer, settings.width, settings.height}, settings.techniques, settings.threads,
              teller);
    }
    PixelTask pixel{camera, plain ? parts_->tracer : ambient.tracer(), settings.width, settings.height, settings.seed};
    PictureResult result;
    result.work = ambient.work();
    result.work.ambient_rays = rays.next();
    result.samples = whole_replicates(settings.samples);
    if (settings.samples <= 0) {
        Teller teller(progress, "pilot run", 2 * pilot_columns * pilot_rows);
        const auto error_with = [&](int samples, bool same_paths) {
            const Lattice lattice =
                measure_lattice(pixel, whole, pilot_columns, pilot_rows, samples, settings.threads, teller, same_paths);
            return median_relative(lattice.values, lattice.errors);
        };
        const double shared = plain ? 0 : error_with(pilot_samples / same_paths_share, true);
        result.samples = samples_for(pilot_errors(error_with(pilot_samples, false), pilot_samples, shared),
                                     settings.accuracy, most_samples);
    }
    ImageSampling image{result.samples};
    if (!plain && settings.techniques.image_sampling) {
        Teller teller(progress, "pilot run", pilot_columns * pilot_rows);
        const Lattice some =
            measure_lattice(pixel, whole, pilot_columns, pilot_rows, image.samples, settings.threads, teller);
        image.tolerance = settings.accuracy;
        image.usual_error = median_relative(some.values, some.errors);
    }
    result.work.fixed_rays = rays.next();
    Teller teller(progress, "view " + view.name, tiles_of(wanted.width, wanted.height).size());
    result.picture = render_tiles(pixel, wanted, image, settings.threads, store, teller);
    result.work.value_rays = rays.next();
    result.median_relative_error = median_relative_error(result.picture);
    if (!plain) {
        Teller check(progress, "check, view " + view.name, check_columns * check_rows);
        add_bias(result, {camera, parts_->tracer, settings.width, settings.height, mix_bits(settings.seed)}, wanted,
                 settings.threads, check);
    }
    result.work.fixed_rays += rays.next();
    result.report = ambient.report();
    result.seconds = seconds_since(start);
    return result;
}

} // namespace lightwell
