#include "engine/simulate/shared_irradiance.h"

#include "engine/base/spectrum.h"
#include "engine/base/threads.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lightwell {
namespace {

/// Largest distance shared over, as a share of the harmonic mean distance: a symmetric neighbourhood cancels the
/// linear change of irradiance, so this may be wider than for a one-sided record.
constexpr double share_of_distance = 0.2;
/// ... and in pixels: enough to average a few hundred, few enough to stay quick.
constexpr int most_pixels = 24;
constexpr double least_pixels = 1;
/// Cosine between normals and slope of the offset out of the plane that count as the same surface.
constexpr double same_cosine = 0.95, same_slope = 0.15;
/// Neighbours over which the closeness is averaged before it is used.
constexpr int closeness_pixels = 3;
constexpr int bias_tile = 32;

const std::array<const char*, 3> colours{"R", "G", "B"};

struct PixelRecord {
    Point position;
    Direction normal;
    double footprint_m = 0; ///< distance between neighbouring pixels across the line of sight
    double closeness = 0, reach_m = 0;
    bool usable = false;
};

class Sharing {
public:
    Sharing(Picture& picture, const Camera& camera) : picture_(picture), records_(count())
    {
        for (const char* c : colours) {
            const std::string colour(c);
            rest_.push_back(&channel("rest." + colour));
            indirect_.push_back(&channel("indirect." + colour));
            reflectance_.push_back(&channel("reflectance." + colour));
        }
        for (const char* c : {"R", "G", "B", "Y"}) {
            const std::string colour(c);
            rest_error_.push_back(&channel("error.rest." + colour));
            indirect_error_.push_back(&channel("error.indirect." + colour));
            error_.push_back(&channel("error." + colour));
        }
        for (int y = 0; y < picture.height; ++y)
            for (int x = 0; x < picture.width; ++x)
                place(camera, x, y);
    }
    double run(int threads)
    {
        const auto rows = static_cast<std::size_t>(picture_.height);
        parallel_for(rows, threads, [&](std::size_t y) { smooth_closeness(static_cast<int>(y)); });
        std::vector<std::vector<float>> shared(3, std::vector<float>(count()));
        std::vector<float> shrink(count(), 1);
        parallel_for(rows, threads, [&](std::size_t y) {
            for (int x = 0; x < picture_.width; ++x)
                share(x, static_cast<int>(y), shared, shrink);
        });
        const double bias = compare(shared, shrink);
        write(shared, shrink);
        return bias;
    }

private:
    std::size_t count() const
    {
        return static_cast<std::size_t>(picture_.width) * static_cast<std::size_t>(picture_.height);
    }
    std::size_t at(int x, int y) const
    {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width) + static_cast<std::size_t>(x);
    }
    std::vector<float>& channel(const std::string& name) { return picture_.channels.at(name); }

    void place(const Camera& camera, int x, int y)
    {
        const std::size_t i = at(x, y);
        PixelRecord& r = records_[i];
        const double depth = channel("Z")[i];
        r.normal = {channel("N.X")[i], channel("N.Y")[i], channel("N.Z")[i]};
        ViewRay ray, beside;
        r.usable = std::isfinite(depth) && length(r.normal) > 0.5 && (*reflectance_[1])[i] > 0 &&
                   camera.ray((x + 0.5) / picture_.width, 1 - (y + 0.5) / picture_.height, ray) &&
                   camera.ray((x + 1.5) / picture_.width, 1 - (y + 0.5) / picture_.height, beside);
        if (!r.usable)
            return;
        r.position = ray.origin + ray.direction * depth;
        r.footprint_m = length(beside.origin + beside.direction * depth - r.position);
        r.closeness = channel("closeness")[i];
    }
    template <class Visit>
    void around(int x, int y, int radius, const Visit& visit) const
    {
        const int x1 = std::min(picture_.width - 1, x + radius), y1 = std::min(picture_.height - 1, y + radius);
        for (int v = std::max(0, y - radius); v <= y1; ++v)
            for (int u = std::max(0, x - radius); u <= x1; ++u)
                visit(at(u, v));
    }
    static bool same_surface(const PixelRecord& a, const PixelRecord& b, double& distance_m)
    {
        if (!b.usable || dot(a.normal, b.normal) < same_cosine)
            return false;
        const Vec3 way = b.position - a.position;
        const double squared = dot(way, way), off = dot(way, a.normal);
        const double slack = same_slope * same_slope * squared + 0.01 * a.footprint_m * a.footprint_m;
        distance_m = std::sqrt(squared);
        return off * off <= slack;
    }
    void smooth_closeness(int y)
    {
        for (int x = 0; x < picture_.width; ++x) {
            PixelRecord& r = records_[at(x, y)];
            if (!r.usable)
                continue;
            double sum = 0, number = 0, distance = 0;
            around(x, y, closeness_pixels, [&](std::size_t i) {
                if (same_surface(r, records_[i], distance)) {
                    sum += records_[i].closeness;
                    ++number;
                }
            });
            const double wanted = sum > 0 ? share_of_distance * number / sum : infinity;
            r.reach_m = std::clamp(wanted, least_pixels * r.footprint_m, most_pixels * r.footprint_m);
        }
    }
    /// shrink: the standard error of the shared irradiance over that of the pixel's own.
    void share(int x, int y, std::vector<std::vector<float>>& shared, std::vector<float>& shrink) const
    {
        const std::size_t here = at(x, y);
        const PixelRecord& r = records_[here];
        double sum[3] = {}, weights = 0, variance = 0, distance = 0;
        if (r.usable)
            around(x, y, most_pixels, [&](std::size_t i) {
                if (!same_surface(r, records_[i], distance))
                    return;
                const double reach = std::min(r.reach_m, std::max(records_[i].reach_m, 0.5 * r.reach_m));
                const double weight = std::max(0.0, 1 - distance / reach);
                if (!(weight > 0))
                    return;
                for (std::size_t c = 0; c < 3; ++c)
                    sum[c] += weight * (*indirect_[c])[i];
                const double error = (*indirect_error_[3])[i];
                variance += weight * weight * error * error;
                weights += weight;
            });
        for (std::size_t c = 0; c < 3; ++c)
            shared[c][here] = weights > 0 ? static_cast<float>(sum[c] / weights) : (*indirect_[c])[here];
        const double own = (*indirect_error_[3])[here];
        if (weights > 0 && own > 0)
            shrink[here] = static_cast<float>(std::sqrt(variance) / weights / own);
    }
    double scattered(std::size_t c, std::size_t i, double irradiance) const
    {
        return (*reflectance_[c])[i] * irradiance / pi;
    }

    /// Means over tiles before and after; what their noise does not explain is bias.
    double compare(const std::vector<std::vector<float>>& shared, const std::vector<float>& shrink) const
    {
        double squares = 0;
        int tiles = 0;
        for (int y = 0; y < picture_.height; y += bias_tile)
            for (int x = 0; x < picture_.width; x += bias_tile) {
                double before = 0, change = 0, noise = 0;
                for (int v = y; v < std::min(y + bias_tile, picture_.height); ++v)
                    for (int u = x; u < std::min(x + bias_tile, picture_.width); ++u) {
                        const std::size_t i = at(u, v);
                        const auto luminance = [&](double er, double eg, double eb) {
                            return photopic({scattered(0, i, er), scattered(1, i, eg), scattered(2, i, eb)});
                        };
                        const double own = luminance((*indirect_[0])[i], (*indirect_[1])[i], (*indirect_[2])[i]);
                        const double after = luminance(shared[0][i], shared[1][i], shared[2][i]);
                        before += photopic({(*rest_[0])[i], (*rest_[1])[i], (*rest_[2])[i]}) + own;
                        change += after - own;
                        const double error = scattered(1, i, (*indirect_error_[3])[i]) / lumens_per_watt;
                        noise += shrink[i] == 1 ? 0 : error * error;
                    }
                if (before > 0) {
                    squares += (change * change - noise) / (before * before);
                    ++tiles;
                }
            }
        return tiles > 0 ? std::sqrt(std::max(0.0, squares / tiles)) : 0;
    }
    void write(const std::vector<std::vector<float>>& shared, const std::vector<float>& shrink)
    {
        for (std::size_t i = 0; i < count(); ++i) {
            for (std::size_t c = 0; c < 3; ++c)
                channel(colours[c])[i] = static_cast<float>((*rest_[c])[i] + scattered(c, i, shared[c][i]));
            for (std::size_t c = 0; c < 4; ++c) {
                // Illuminance to luminance for Y: the reflectance of green stands for the colour's.
                const double factor = (*reflectance_[c == 3 ? 1 : c])[i] / pi * shrink[i];
                const double part = factor * (*indirect_error_[c])[i];
                (*error_[c])[i] = static_cast<float>(std::hypot((*rest_error_[c])[i], part));
            }
        }
    }

    Picture& picture_;
    std::vector<PixelRecord> records_;
    std::vector<std::vector<float>*> rest_, indirect_, reflectance_, rest_error_, indirect_error_, error_;
};

} // namespace

const std::vector<std::string>& sharing_channels()
{
    static const std::vector<std::string> names{
        "rest.R",        "rest.G",           "rest.B",           "indirect.R",       "indirect.G",       "indirect.B",
        "reflectance.R", "reflectance.G",    "reflectance.B",    "error.rest.R",     "error.rest.G",     "error.rest.B",
        "error.rest.Y",  "error.indirect.R", "error.indirect.G", "error.indirect.B", "error.indirect.Y", "closeness"};
    return names;
}

double share_irradiance(Picture& picture, const Camera& camera, int threads)
{
    const double bias = Sharing(picture, camera).run(threads);
    for (const std::string& name : sharing_channels())
        picture.channels.erase(name);
    return bias;
}

} // namespace lightwell
