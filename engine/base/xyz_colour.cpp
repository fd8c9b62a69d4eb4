#include "engine/base/xyz_colour.h"

namespace lightwell {
namespace {

Vec3 of_chromaticity(double x, double y) noexcept
{
    return {x / y, 1, (1 - x - y) / y};
}

/// The rows of the map from X, Y, Z to the engine's primaries, up to a factor each.
struct FromXyz {
    Vec3 r, g, b;
};
FromXyz from_xyz() noexcept
{
    // The engine's primaries, see engine/base/spectrum.h.
    const Vec3 red = of_chromaticity(.64, .33), green = of_chromaticity(.29, .60), blue = of_chromaticity(.15, .06);
    const double volume = dot(red, cross(green, blue));
    return {cross(green, blue) / volume, cross(blue, red) / volume, cross(red, green) / volume};
}

} // namespace

Spectrum colour_of_xyz(const Vec3& xyz) noexcept
{
    static const FromXyz rows = from_xyz();
    const auto channel = [&](const Vec3& row) { return dot(row, xyz) / (row.x + row.y + row.z); };
    return {channel(rows.r), channel(rows.g), channel(rows.b)};
}

} // namespace lightwell
