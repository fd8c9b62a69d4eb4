#pragma once

#include "engine/base/random.h"
#include "engine/sampling/statistics.h"
#include "engine/sampling/warps.h"
#include "materials/bsdf.h"

#include <algorithm>
#include <cmath>
#include <vector>

/// \file Measures of a model of scattering: chi-square of its samples against its density, and albedo.
namespace lightwell {

inline Direction at(double polar_deg, double azimuth_deg = 0)
{
    const double t = polar_deg * radians_per_degree, p = azimuth_deg * radians_per_degree;
    return {std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)};
}

inline const std::vector<double> angles_deg{0, 30, 60, 80, 89, 89.99};

/// Cells of equal solid angle over the sphere: 16 heights, 16 azimuths.
inline constexpr int rows = 16, columns = 16;

inline std::size_t cell_of(const Direction& d)
{
    const int row = std::clamp(static_cast<int>((d.z + 1) / 2 * rows), 0, rows - 1);
    const double turn = std::atan2(d.y, d.x) / (2 * pi) + 0.5;
    return row * columns + std::clamp(static_cast<int>(turn * columns), 0, columns - 1);
}

/// Integral of the density over each cell, by a midpoint rule.
inline std::vector<double> shares_of(const Bsdf& bsdf, const Direction& to_viewer)
{
    // At 88 degrees a highlight of roughness 0.1 is 7 mrad wide in azimuth.
    const int fine = bsdf.lobes().glossy ? 96 : 16;
    std::vector<double> shares(rows * columns);
    const double element_sr = 4 * pi / (rows * columns * fine * fine);
    for (int i = 0; i < rows * fine; ++i)
        for (int j = 0; j < columns * fine; ++j) {
            const double z = (i + 0.5) / (rows * fine) * 2 - 1, r = std::sqrt(1 - z * z);
            const double azimuth = ((j + 0.5) / (columns * fine) - 0.5) * 2 * pi;
            shares[(i / fine) * columns + j / fine] +=
                element_sr * bsdf.density_per_sr(to_viewer, {r * std::cos(azimuth), r * std::sin(azimuth), z});
        }
    return shares;
}

struct Histogram {
    std::vector<double> counts = std::vector<double>(rows * columns);
    double lost = 0; ///< absorbed, or in a delta lobe
    int draws = 0;
};

inline constexpr int draws = 200000;

inline Histogram histogram_of(const Bsdf& bsdf, const Direction& to_viewer, int count = draws)
{
    Histogram found;
    found.draws = count;
    RandomStream random(11);
    for (int i = 0; i < count; ++i) {
        const double choice = random.next();
        const auto s = bsdf.sample(to_viewer, choice, random.square());
        if (!s || s->delta)
            ++found.lost;
        else
            ++found.counts[cell_of(s->to_light)];
    }
    return found;
}

/// Chi-square of sample() against density(); what is not scattered is one more cell.
/// @param error  makes the density of every other column too large and of the others too small, relative
inline double probability(const Histogram& found, std::vector<double> shares, double error = 0)
{
    std::vector<double> counts = found.counts;
    double rest = 1;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            double& share = shares[row * columns + column];
            share *= 1 + (column % 2 ? error : -error);
            rest -= share;
            share *= found.draws;
        }
    shares.push_back(std::max(0.0, rest) * found.draws);
    counts.push_back(found.lost);
    return chi_square_probability(counts, shares);
}

/// Mean of the weights: the albedo under uniform light, each channel.
inline Spectrum albedo(const Bsdf& bsdf, const Direction& to_viewer, int count = 20000)
{
    Spectrum sum;
    RandomStream random(3);
    for (int i = 0; i < count; ++i) {
        const double choice = random.next();
        if (const auto s = bsdf.sample(to_viewer, choice, random.square()))
            sum += s->weight;
    }
    return sum / count;
}

} // namespace lightwell
