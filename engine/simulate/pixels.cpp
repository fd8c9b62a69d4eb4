#include "engine/simulate/pixels.h"

#include <algorithm>
#include <numeric>

namespace lightwell {

const char* const pixel_channels[pixel_channel_count] = {
    "R",       "G",       "B",       "illuminance.Y",      "Z", "N.X", "N.Y", "N.Z", "error.R",
    "error.G", "error.B", "error.Y", "error.illuminance.Y"};

namespace {

constexpr std::size_t illuminance_at = 3, depth_at = 4, normal_at = 5, luminance_error_at = 11,
                      illuminance_error_at = 12;

/// Cosine between normals, and relative difference of distances, of what counts as the same surface.
constexpr double same_cosine = 0.98, same_distance = 0.1;

/// Whether the values lie within a share of their mean, or differ no more than by their noise.
bool close(const double* values, const double* errors, std::size_t count, double tolerance)
{
    constexpr double usual_span = 2.5; // of a few values of equal error, in standard errors
    const auto [low, high] = std::minmax_element(values, values + count);
    // The least: where something thin passes through one of them, its spread is no noise.
    const double noise = *std::min_element(errors, errors + count);
    return *high - *low <= std::max(tolerance * 0.5 * (*high + *low), usual_span * noise);
}

/// Paths through a pixel that is interpolated, and how far their mean may lie off in standard errors: what is thinner
/// than a pixel and falls between its neighbours shows in them.
constexpr int probe_paths = 4;
constexpr double most_off = 3;

/// Paths through a pixel beside noise, as a multiple of the usual ones.
constexpr int more_paths = 4;
/// What counts as noise, in multiples of what is usual in the picture: a standard error; a difference, where it is an
/// edge that runs between the pixels looked at, and no less than that share of their mean.
constexpr double noisy = 4, noisy_edge = 8, least_edge = 1;

} // namespace

bool same_surface(const Sight& a, const Sight& b)
{
    if (a.met_surface != b.met_surface)
        return false;
    return !a.met_surface || (a.modifier == b.modifier && dot(a.normal, b.normal) > same_cosine &&
                              std::fabs(a.distance_m - b.distance_m) <= same_distance * a.distance_m);
}

PathRandom PixelTask::random_of(int x, int y, int replicate, std::uint32_t path) const noexcept
{
    const auto pixel =
        static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(width) + static_cast<std::uint64_t>(x);
    return PathRandom(mix_bits(seed, static_cast<std::uint64_t>(replicate)), pixel, path);
}

PixelResult PixelTask::measure(int x, int y, int samples, bool same_paths) const
{
    PixelResult result;
    const auto each = static_cast<std::uint32_t>(samples / replicates);
    for (int r = 0; r < replicates; ++r) {
        Spectrum radiance, irradiance;
        for (std::uint32_t i = 0; i < each; ++i)
            add_path(result, x, y, r, random_of(x, y, same_paths ? 0 : r, i), radiance, irradiance);
        radiance = radiance / each;
        for (int c = 0; c < 3; ++c)
            result.channel[c].add(radiance[c]);
        result.luminance.add(luminance_of(radiance).value);
        result.illuminance.add(illuminance_of(irradiance / each).value);
    }
    return result;
}

void PixelTask::add_path(PixelResult& result, int x, int y, int replicate, PathRandom random, Spectrum& radiance,
                         Spectrum& irradiance) const
{
    const UnitSquare jitter = random.pair();
    ViewRay start;
    const UnitSquare lens = camera.has_lens() ? random.pair() : UnitSquare{};
    if (!camera.ray((x + jitter.u) / width, 1 - (y + jitter.v) / height, lens, start))
        return;
    const PathSample path = tracer.sample({start.origin, start.direction, start.reach_m}, replicate, random);
    radiance += path.radiance;
    if (!path.met_surface)
        return;
    irradiance += path.irradiance;
    result.depth_sum += path.distance_m;
    result.normal_sum += path.normal;
    ++result.met;
}

double PixelTask::probe(int x, int y, int paths) const
{
    PixelResult ignored;
    Spectrum radiance, irradiance;
    for (int i = 0; i < paths; ++i)
        add_path(ignored, x, y, 0, random_of(x, y, 0, static_cast<std::uint32_t>(i)), radiance, irradiance);
    return luminance_of(radiance / paths).value;
}

Sight PixelTask::sight(int x, int y) const noexcept
{
    ViewRay start;
    if (!camera.ray((x + 0.5) / width, 1 - (y + 0.5) / height, start))
        return {};
    return tracer.sight({start.origin, start.direction, start.reach_m});
}

PixelValue value_of(const PixelResult& result, int samples)
{
    // A picture element that the horizon cuts: the mean over the part that shows a surface.
    const double part = static_cast<double>(result.met) / samples;
    const bool met = result.met > 0;
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    const Vec3 normal = normalized(result.normal_sum);
    const double values[pixel_channel_count] = {result.channel[0].mean(),
                                                result.channel[1].mean(),
                                                result.channel[2].mean(),
                                                met ? result.illuminance.mean() / part : nothing,
                                                met ? result.depth_sum / result.met : infinity,
                                                normal.x,
                                                normal.y,
                                                normal.z,
                                                result.channel[0].standard_error(),
                                                result.channel[1].standard_error(),
                                                result.channel[2].standard_error(),
                                                result.luminance.standard_error(),
                                                met ? result.illuminance.standard_error() / part : nothing};
    PixelValue value;
    std::transform(std::begin(values), std::end(values), value.begin(), [](double v) { return static_cast<float>(v); });
    return value;
}

const PixelField::Pixel& PixelField::first(int x, int y)
{
    const std::int64_t key = static_cast<std::int64_t>(y) * task_.width + x;
    const auto found = first_.find(key);
    if (found != first_.end())
        return found->second;
    const Pixel pixel{value_of(task_.measure(x, y, image_.samples), image_.samples), task_.sight(x, y)};
    return first_.emplace(key, pixel).first->second;
}

/// Asks the pixels of even places around, never the pixel itself.
bool PixelField::beside_noise(int x, int y)
{
    double sum = 0, most_error = 0, low = infinity, high = 0;
    int count = 0;
    for (int v = (y - 1) / 2 * 2; v <= y + 2; v += 2)
        for (int u = (x - 1) / 2 * 2; u <= x + 2; u += 2) {
            if ((u == x && v == y) || u >= task_.width || v >= task_.height)
                continue;
            const PixelValue& value = first(u, v).value;
            const double luminance = luminance_of({value[0], value[1], value[2]}).value;
            sum += luminance;
            low = std::min(low, luminance);
            high = std::max(high, luminance);
            most_error = std::max(most_error, static_cast<double>(value[luminance_error_at]));
            ++count;
        }
    const double mean = sum / std::max(count, 1);
    const bool between = x % 2 != 0 || y % 2 != 0;
    const double quiet = std::max(image_.tolerance, image_.usual_error);
    const double edge = std::max(least_edge, noisy_edge * quiet);
    return most_error > noisy * quiet * mean || (between && high - low > edge * mean);
}

const PixelField::Pixel& PixelField::own(int x, int y)
{
    if (image_.tolerance == 0 || !beside_noise(x, y))
        return first(x, y);
    const std::int64_t key = static_cast<std::int64_t>(y) * task_.width + x;
    const auto found = own_.find(key);
    if (found != own_.end())
        return found->second;
    const int samples = more_paths * image_.samples;
    return own_.emplace(key, Pixel{value_of(task_.measure(x, y, samples), samples), task_.sight(x, y)}).first->second;
}

bool PixelField::interpolated(int x, int y, PixelValue& value)
{
    const bool between_columns = x % 2 != 0, between_rows = y % 2 != 0;
    if (!between_columns && !between_rows)
        return false;
    const int dx = between_columns ? 1 : 0, dy = between_rows ? 1 : 0;
    if (x + dx >= task_.width || y + dy >= task_.height)
        return false;
    const Pixel* around[4] = {&own(x - dx, y - dy), &own(x + dx, y + dy), nullptr, nullptr};
    std::size_t count = 2;
    if (between_columns && between_rows) {
        around[2] = &own(x - 1, y + 1);
        around[3] = &own(x + 1, y - 1);
        count = 4;
    }
    const Sight here = task_.sight(x, y);
    if (here.varies)
        return false;
    double luminance[4], illuminance[4], luminance_error[4], illuminance_error[4];
    for (std::size_t i = 0; i < count; ++i) {
        const PixelValue& v = around[i]->value;
        if (!same_surface(here, around[i]->sight))
            return false;
        luminance[i] = luminance_of({v[0], v[1], v[2]}).value;
        luminance_error[i] = v[luminance_error_at];
        illuminance[i] = here.met_surface ? v[illuminance_at] : 0;
        illuminance_error[i] = here.met_surface ? v[illuminance_error_at] : 0;
    }
    if (!close(luminance, luminance_error, count, image_.tolerance) ||
        !close(illuminance, illuminance_error, count, image_.tolerance))
        return false;
    const double mean = std::accumulate(luminance, luminance + count, 0.0) / static_cast<double>(count);
    const double path_noise = *std::min_element(luminance_error, luminance_error + count) * std::sqrt(image_.samples);
    const double allowed = std::max(image_.tolerance * mean, most_off * path_noise / std::sqrt(probe_paths));
    if (std::fabs(task_.probe(x, y, probe_paths) - mean) > allowed)
        return false;
    value.fill(0);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t c = 0; c < pixel_channel_count; ++c)
            value[c] += around[i]->value[c] / static_cast<float>(count);
    if (here.met_surface) {
        const Vec3 normal = normalized({value[normal_at], value[normal_at + 1], value[normal_at + 2]});
        for (int c = 0; c < 3; ++c)
            value[normal_at + static_cast<std::size_t>(c)] = static_cast<float>(normal[c]);
        value[depth_at] = static_cast<float>(here.distance_m);
    }
    return true;
}

const PixelValue& PixelField::at(int x, int y)
{
    if (image_.tolerance > 0 && interpolated(x, y, last_))
        return last_;
    return own(x, y).value;
}

void put(Picture& picture, std::size_t at, const PixelValue& value)
{
    for (std::size_t c = 0; c < pixel_channel_count; ++c)
        picture.channels.find(pixel_channels[c])->second[at] = value[c];
}

} // namespace lightwell
