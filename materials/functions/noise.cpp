#include "materials/functions/noise.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace lightwell {
namespace {

/// Perlin's permutation of 0 to 255.
constexpr std::uint8_t permutation[256] = {
    151, 160, 137, 91,  90,  15,  131, 13,  201, 95,  96,  53,  194, 233, 7,   225, 140, 36,  103, 30,  69,  142,
    8,   99,  37,  240, 21,  10,  23,  190, 6,   148, 247, 120, 234, 75,  0,   26,  197, 62,  94,  252, 219, 203,
    117, 35,  11,  32,  57,  177, 33,  88,  237, 149, 56,  87,  174, 20,  125, 136, 171, 168, 68,  175, 74,  165,
    71,  134, 139, 48,  27,  166, 77,  146, 158, 231, 83,  111, 229, 122, 60,  211, 133, 230, 220, 105, 92,  41,
    55,  46,  245, 40,  244, 102, 143, 54,  65,  25,  63,  161, 1,   216, 80,  73,  209, 76,  132, 187, 208, 89,
    18,  169, 200, 196, 135, 130, 116, 188, 159, 86,  164, 100, 109, 198, 173, 186, 3,   64,  52,  217, 226, 250,
    124, 123, 5,   202, 38,  147, 118, 126, 255, 82,  85,  212, 207, 206, 59,  227, 47,  16,  58,  17,  182, 189,
    28,  42,  223, 183, 170, 213, 119, 248, 152, 2,   44,  154, 163, 70,  221, 153, 101, 155, 167, 43,  172, 9,
    129, 22,  39,  253, 19,  98,  108, 110, 79,  113, 224, 232, 178, 185, 112, 104, 218, 246, 97,  228, 251, 34,
    242, 193, 238, 210, 144, 12,  191, 179, 162, 241, 81,  51,  145, 235, 249, 14,  239, 107, 49,  192, 214, 31,
    181, 199, 106, 157, 184, 84,  204, 176, 115, 121, 50,  45,  127, 4,   150, 254, 138, 236, 205, 93,  222, 114,
    67,  29,  24,  72,  243, 141, 128, 195, 78,  66,  215, 61,  156, 180};

std::uint8_t permuted(unsigned index) noexcept
{
    return permutation[index & 255];
}

/// Towards one of the twelve edges of a cube; four are there twice.
Vec3 edge_direction(unsigned hash) noexcept
{
    const unsigned h = hash & 15;
    const double first = (h & 1) != 0 ? -1 : 1, second = (h & 2) != 0 ? -1 : 1;
    if (h < 4)
        return {first, second, 0};
    if (h < 8)
        return {first, 0, second};
    if (h == 12 || h == 14)
        return {second, first, 0};
    return {0, first, second};
}

double blend(double t) noexcept
{
    return t * t * t * (t * (t * 6 - 15) + 10);
}

double blend_slope(double t) noexcept
{
    return 30 * t * t * (t * (t - 2) + 1);
}

/// Whole part as an integer that wraps, so that coordinates of any size are defined.
unsigned cell_of(double floor) noexcept
{
    constexpr double period = 256;
    return static_cast<unsigned>(floor - period * std::floor(floor / period));
}

/// Pseudo-random number in (-1, 1] of an integer; overflow wraps.
double chance(std::int64_t seed) noexcept
{
    std::uint64_t s = static_cast<std::uint64_t>(seed);
    s = (s << 13) ^ s;
    constexpr double half_range = 1073741824;
    return 1 - static_cast<double>((s * (s * s * 15731 + 789221) + 1376312589) & 0x7fffffff) / half_range;
}

struct Cell {
    std::int64_t at[3]; ///< in steps
    double chance_part() const noexcept { return chance(17 * at[0] + 23 * at[1] + 29 * at[2]); }
};

/// Mean of the corners of the cube that differ from `corner` in the axes of `free` only.
double mean_over(const std::array<double, 8>& corners, unsigned corner, unsigned free) noexcept
{
    double sum = 0;
    int count = 0;
    for (unsigned c = 0; c < 8; ++c)
        if (((c ^ corner) & ~free & 7) == 0) {
            sum += corners[c];
            ++count;
        }
    return sum / count;
}

} // namespace

NoiseValue gradient_noise_at(const Point& at) noexcept
{
    NoiseValue sum;
    if (!is_finite(at))
        return sum;
    const double floors[3] = {std::floor(at.x), std::floor(at.y), std::floor(at.z)};
    const double offset[3] = {at.x - floors[0], at.y - floors[1], at.z - floors[2]};
    for (unsigned corner = 0; corner < 8; ++corner) {
        double weight[3], slope[3];
        Vec3 from_corner;
        unsigned cell[3];
        for (int axis = 0; axis < 3; ++axis) {
            const bool high = (corner >> axis & 1) != 0;
            const double t = offset[axis];
            weight[axis] = high ? blend(t) : 1 - blend(t);
            slope[axis] = high ? blend_slope(t) : -blend_slope(t);
            from_corner[axis] = high ? t - 1 : t;
            cell[axis] = cell_of(floors[axis]) + (high ? 1u : 0u);
        }
        const Vec3 towards = edge_direction(permuted(permuted(permuted(cell[0]) + cell[1]) + cell[2]));
        const double height = dot(towards, from_corner);
        sum.value += weight[0] * weight[1] * weight[2] * height;
        sum.gradient += towards * (weight[0] * weight[1] * weight[2]);
        sum.gradient +=
            Vec3{slope[0] * weight[1] * weight[2], weight[0] * slope[1] * weight[2], weight[0] * weight[1] * slope[2]} *
            height;
    }
    return sum;
}

double fractal_noise_at(const Point& at) noexcept
{
    constexpr double smallest = 5e-4; // of a unit, as the recorded values have it
    constexpr double farthest = 1e12; // beyond which such steps are lost in double precision
    if (!(max_abs(at) < farthest))
        return 0;
    std::int64_t size = static_cast<std::int64_t>(1 / smallest);
    Cell low{}; // corner of the cube that holds the point
    std::int64_t point[3];
    for (int axis = 0; axis < 3; ++axis) {
        point[axis] = static_cast<std::int64_t>(static_cast<double>(size) * at[axis]);
        low.at[axis] = static_cast<std::int64_t>(static_cast<double>(size) * std::floor(at[axis]));
    }
    std::array<double, 8> corners;
    for (unsigned c = 0; c < 8; ++c) {
        Cell corner = low;
        for (int axis = 0; axis < 3; ++axis)
            corner.at[axis] += (c >> axis & 1) != 0 ? size : 0;
        corners[c] = corner.chance_part();
    }
    for (;;) {
        const double mean = std::accumulate(corners.begin(), corners.end(), 0.0) * 0.125;
        size /= 2;
        if (size == 0)
            return mean;
        // The eighth that holds the point keeps one corner; its others lie in the middle of edges, faces and the cube.
        unsigned kept = 0;
        for (int axis = 0; axis < 3; ++axis)
            if (point[axis] > low.at[axis] + size)
                kept |= 1u << axis;
        const std::array<double, 8> before = corners;
        for (unsigned moved = 1; moved < 8; ++moved) { // axes along which the new corner differs from the kept one
            Cell corner = low;
            for (int axis = 0; axis < 3; ++axis) {
                const bool middle = (moved >> axis & 1) != 0;
                corner.at[axis] += middle ? size : (kept >> axis & 1) != 0 ? 2 * size : 0;
            }
            corners[kept ^ moved] =
                mean_over(before, kept, moved) + static_cast<double>(size) * smallest * corner.chance_part();
        }
        for (int axis = 0; axis < 3; ++axis)
            if ((kept >> axis & 1) != 0)
                low.at[axis] += size;
    }
}

} // namespace lightwell
