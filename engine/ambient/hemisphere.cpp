#include "engine/ambient/hemisphere.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

double photopic_at(const Hemisphere& s, int row, int column)
{
    return photopic(s.radiance[s.at(row, column)]);
}

/// Polar angle at a share of the projected solid angle.
double polar_rad(double share)
{
    return std::asin(std::sqrt(std::clamp(share, 0.0, 1.0)));
}

/// The paper's weights of one row.
struct RowWeights {
    double across_top;   ///< sin(theta-) cos^2(theta-): change across the border to the row above
    double along_side;   ///< sin(theta+) - sin(theta-): change across the border to the column before
    double mean_tangent; ///< exact mean of tan(theta) over the row
};

RowWeights row_weights(int row, int rows)
{
    const double low = polar_rad(static_cast<double>(row) / rows), high = polar_rad((row + 1.0) / rows);
    const auto integral = [](double t) { return 0.5 * t - 0.25 * std::sin(2 * t); };
    const double s = std::sin(low), c = std::cos(low);
    return {s * c * c, std::sin(high) - s, 2 * rows * (integral(high) - integral(low))};
}

/// Facets between the samples, as edges: each carries the difference of radiance of the facets on its two sides.
class FacetedHemisphere {
public:
    explicit FacetedHemisphere(const Hemisphere& samples) : samples_(samples)
    {
        const int n = samples.columns;
        double farthest = 0;
        for (const double c : samples.closeness_per_m)
            farthest = c > 0 ? std::max(farthest, 1 / c) : farthest;
        for (int row = 0; row < samples.rows; ++row)
            for (int column = 0; column < n; ++column) {
                const double closeness = samples.closeness_per_m[samples.at(row, column)];
                const double distance = closeness > 0 ? 1 / closeness : sky_distance * farthest;
                const double share = (row + 0.5) / samples.rows, sine = std::sqrt(share);
                const double turn = 2 * pi * (column + 0.5) / n;
                points_.push_back(Vec3{sine * std::cos(turn), sine * std::sin(turn), std::sqrt(1 - share)} * distance);
            }
        add_edges();
    }
    /// Photopic irradiance at a place of the receiver's plane, in its frame.
    double irradiance(const Vec3& at) const noexcept
    {
        double sum = 0;
        for (const Edge& e : edges_) {
            const Vec3 a = points_[e.from] - at, b = points_[e.to] - at, c = cross(a, b);
            const double sine = length(c);
            if (sine > 0)
                sum += e.step * std::atan2(sine, dot(a, b)) * c.z / sine;
        }
        return 0.5 * sum;
    }

private:
    struct Edge {
        std::size_t from, to;
        double step; ///< radiance on the left minus that on the right, W/(m^2 sr)
    };
    /// What is met nowhere is as good as this many times the farthest distance away.
    static constexpr double sky_distance = 100;

    /// A facet shows what is behind: the farthest of its corners.
    double facet_radiance(int row, int column, bool upper) const
    {
        const int next = (column + 1) % samples_.columns;
        const std::size_t corners[3] = {samples_.at(row, next), samples_.at(row + 1, column),
                                        upper ? samples_.at(row, column) : samples_.at(row + 1, next)};
        const std::size_t farthest = *std::min_element(corners, corners + 3, [&](std::size_t a, std::size_t b) {
            return samples_.closeness_per_m[a] < samples_.closeness_per_m[b];
        });
        return photopic(samples_.radiance[farthest]);
    }
    /// Facets: a cap about the zenith, two triangles between any two rows and columns; nothing below the last row.
    void add_edges()
    {
        const int n = samples_.columns;
        double cap = 0;
        for (int column = 0; column < n; ++column)
            cap += photopic_at(samples_, 0, column) / n;
        for (int row = 0; row < samples_.rows; ++row)
            for (int column = 0; column < n; ++column) {
                const int next = (column + 1) % n;
                const double above = row == 0 ? cap : facet_radiance(row - 1, column, false);
                const double below = row + 1 < samples_.rows ? facet_radiance(row, column, true) : 0;
                edges_.push_back({samples_.at(row, column), samples_.at(row, next), above - below});
                if (row + 1 == samples_.rows)
                    continue;
                // From the lower left corner to the upper right one, and down the right-hand side.
                const double upper = below, lower = facet_radiance(row, column, false);
                edges_.push_back({samples_.at(row + 1, column), samples_.at(row, next), upper - lower});
                const double beside = facet_radiance(row, next, true);
                edges_.push_back({samples_.at(row + 1, next), samples_.at(row, next), lower - beside});
            }
    }

    const Hemisphere& samples_;
    std::vector<Vec3> points_;
    std::vector<Edge> edges_;
};

} // namespace

Direction hemisphere_direction(const Frame& frame, UnitSquare u) noexcept
{
    const double sine = std::sqrt(u.u), turn = 2 * pi * u.v;
    return normalized(frame.to_world({sine * std::cos(turn), sine * std::sin(turn), std::sqrt(std::fmax(0, 1 - u.u))}));
}

IrradianceGradient gradient_of(const Hemisphere& s) noexcept
{
    IrradianceGradient gradient;
    const int m = s.rows, n = s.columns;
    const auto at_angle = [&](double turn) { return s.frame.x * std::cos(turn) + s.frame.y * std::sin(turn); };
    for (int k = 0; k < n; ++k) {
        const int before = (k + n - 1) % n;
        const double middle = 2 * pi * (k + 0.5) / n;
        const Vec3 outward = at_angle(middle), around = at_angle(middle + 0.5 * pi);
        const Vec3 around_border = at_angle(2 * pi * k / n + 0.5 * pi);
        Spectrum up, side, turned;
        for (int j = 0; j < m; ++j) {
            const RowWeights w = row_weights(j, m);
            const std::size_t here = s.at(j, k);
            const auto step = [&](std::size_t other) {
                return (s.radiance[here] - s.radiance[other]) *
                       std::max(s.closeness_per_m[here], s.closeness_per_m[other]);
            };
            if (j > 0)
                up += step(s.at(j - 1, k)) * w.across_top;
            side += step(s.at(j, before)) * w.along_side;
            turned += s.radiance[here] * w.mean_tangent;
        }
        for (int c = 0; c < 3; ++c) {
            gradient.translation[c] += outward * (2 * pi / n * up[c]) + around_border * side[c];
            gradient.rotation[c] += around * (pi / (m * n) * turned[c]);
        }
    }
    return gradient;
}

IrradianceHessian hessian_of(const Hemisphere& s) noexcept
{
    IrradianceHessian hessian;
    hessian.axis = s.frame.x;
    const double harmonic = harmonic_distance_m(s);
    if (!std::isfinite(harmonic))
        return hessian;
    constexpr double step_share = 0.1; // of the harmonic mean distance
    const double h = step_share * harmonic;
    const FacetedHemisphere facets(s);
    const auto e = [&](double x, double y) { return facets.irradiance({x * h, y * h, 0}); };
    const double here = e(0, 0);
    const double xx = (e(1, 0) - 2 * here + e(-1, 0)) / (h * h), yy = (e(0, 1) - 2 * here + e(0, -1)) / (h * h);
    const double xy = (e(1, 1) - e(-1, 1) - e(1, -1) + e(-1, -1)) / (4 * h * h);
    const double mean = 0.5 * (xx + yy), half = std::hypot(0.5 * (xx - yy), xy);
    double turn = 0.5 * std::atan2(2 * xy, xx - yy); // of mean + half
    hessian.value[0] = mean + half;
    hessian.value[1] = mean - half;
    if (std::fabs(hessian.value[1]) > std::fabs(hessian.value[0])) {
        std::swap(hessian.value[0], hessian.value[1]);
        turn += 0.5 * pi;
    }
    hessian.axis = s.frame.x * std::cos(turn) + s.frame.y * std::sin(turn);
    return hessian;
}

double harmonic_distance_m(const Hemisphere& s) noexcept
{
    double sum = 0;
    for (const double c : s.closeness_per_m)
        sum += c;
    return sum > 0 ? static_cast<double>(s.closeness_per_m.size()) / sum : infinity;
}

} // namespace lightwell
