#include "engine/simulate/parts.h"

#include <algorithm>
#include <cmath>

/// \file What a few values found again by plain path tracing tell of the bias of all.
namespace lightwell {
namespace {

/// Differences are relative to the value, and to no less than this share of the mean.
constexpr double least_level = 0.01;
/// Plain paths of each checked value to begin with.
constexpr int first_paths = 4 * replicates;
/// The most paths that the check takes, as a share of all: each is longer than those of the values.
constexpr double check_share = 1.0 / 16;
/// Of a plain path, shadow rays included, in a room: few sensors may rest on much more ambient light than paths.
constexpr double rays_a_path = 16;

/// The part of a mean that is not likely to be noise.
/// Source  James, Stein 1961, the positive part
double believed(double mean, double standard_error)
{
    const double squared = mean * mean;
    return squared > 0 ? mean * std::max(0.0, 1 - standard_error * standard_error / squared) : 0;
}

} // namespace

BiasEstimate bias_of(const std::vector<Checked>& points)
{
    BiasEstimate bias;
    bias.points = static_cast<int>(points.size());
    double level = 0, sum = 0, squares = 0, noise = 0;
    for (const Checked& p : points) {
        const double difference = p.value - p.plain;
        level += p.plain;
        sum += difference;
        squares += difference * difference;
        noise += p.plain_error * p.plain_error;
    }
    const auto n = static_cast<double>(points.size());
    if (!(level > 0))
        return bias;
    bias.mean = sum / level;
    // Few points may agree by chance, and one always does: the sum is no surer than the plain paths are.
    bias.standard_error = std::sqrt(std::max(squares - sum * sum / n, noise)) / level;
    bias.spread = std::sqrt(std::max(squares - noise, 0.0) / n) / (level / n);
    return bias;
}

BiasCheck check_bias(const std::function<std::vector<Checked>(int paths)>& measure, double wanted, const AllWork& all)
{
    const double all_paths = std::max(all.paths, static_cast<double>(all.rays.total()) / rays_a_path);
    BiasCheck check;
    for (int paths = first_paths;; paths *= 4) {
        check.points = measure(paths);
        check.whole = bias_of(check.points);
        if (check.whole.standard_error <= wanted ||
            4.0 * paths * static_cast<double>(check.points.size()) > check_share * all_paths)
            return check;
    }
}

LocalBias::LocalBias(const BiasEstimate& whole, const std::vector<Checked>& points) : points_(points)
{
    mean_ = believed(whole.mean, whole.standard_error);
    double level = 0;
    for (const Checked& p : points)
        level += p.plain / static_cast<double>(points.size());
    least_ = least_level * level;
    const double spread = whole.spread * level;
    for (const Checked& p : points) {
        const double both = spread * spread + p.plain_error * p.plain_error;
        const double share = both > 0 ? spread * spread / both : 0;
        const double rest = p.value - p.plain - mean_ * p.value;
        rest_.push_back(share * rest / std::max({p.value, least_, 1e-300}));
    }
}

double LocalBias::at(const Point& place, double value) const noexcept
{
    double weights = 0, sum = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const Vec3 way = points_[i].place - place;
        const double weight = 1 / std::max(dot(way, way), 1e-12);
        weights += weight;
        sum += weight * rest_[i];
    }
    const double rest = weights > 0 ? sum / weights : 0;
    return mean_ * value + rest * std::max(value, least_);
}

} // namespace lightwell
