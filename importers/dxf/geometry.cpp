#include "importers/dxf/geometry.h"

#include "engine/scene/surface.h"

#include <algorithm>

namespace lightwell::dxf {

Affine object_axes(const Vec3& extrusion)
{
    constexpr double near_z = 1.0 / 64; // the algorithm's own bound
    Vec3 z = normalized(extrusion);
    if (z == Vec3{})
        z = {0, 0, 1};
    const bool along_z = std::fabs(z.x) < near_z && std::fabs(z.y) < near_z;
    const Vec3 x = normalized(cross(along_z ? Vec3{0, 1, 0} : Vec3{0, 0, 1}, z));
    return {x, normalized(cross(z, x)), z, {}};
}

Vec3 Arc::outward(double fraction) const
{
    const double angle_rad = start_rad + fraction * sweep_rad;
    return {std::cos(angle_rad), std::sin(angle_rad), 0};
}

Sector Arc::sector(const Affine& axes) const
{
    return {axes.vector(outward(sweep_rad > 0 ? 0 : 1)), std::fabs(sweep_rad)};
}

Point Arc::at(double fraction) const
{
    return centre + outward(fraction) * radius;
}

Arc arc_of_bulge(const Point& from, const Point& to, double bulge)
{
    const Vec3 chord = to - from;
    const double chord_length = length(chord);
    const Vec3 left = Vec3{-chord.y, chord.x, 0} / chord_length;
    const double centre_height = chord_length * (1 - bulge * bulge) / (4 * bulge);
    Arc arc;
    arc.centre = (from + to) * 0.5 + left * centre_height;
    arc.radius = chord_length * (1 + bulge * bulge) / (4 * std::fabs(bulge));
    arc.start_rad = std::atan2(from.y - arc.centre.y, from.x - arc.centre.x);
    arc.sweep_rad = 4 * std::atan(bulge);
    return arc;
}

int chord_count(double radius, double sweep_rad, double tolerance)
{
    constexpr int most_per_turn = 4096, fewest_per_turn = 8;
    const double ratio = std::clamp(1 - tolerance / radius, -1.0, 1.0);
    const double widest_rad = std::clamp(2 * std::acos(ratio), 2 * pi / most_per_turn, 2 * pi / fewest_per_turn);
    return std::max(
        1, static_cast<int>(std::ceil(std::fabs(sweep_rad) / widest_rad - 1e-9))); // 1e-9: rounding of a whole turn
}

double chord_error(double radius, double sweep_rad, int chords)
{
    const double s = std::sin(sweep_rad / (4 * chords)); // 1 - cos(x) = 2 sin^2(x / 2), which keeps its digits
    return 2 * radius * s * s;
}

double distance_from_plane(std::span<const Point> corners)
{
    if (corners.size() < 4)
        return 0;
    const Vec3 normal = normalized(polygon_area_vector(corners.data(), corners.size()));
    Point centre;
    for (const Point& corner : corners)
        centre += corner / static_cast<double>(corners.size());
    double distance = 0;
    for (const Point& corner : corners)
        distance = std::fmax(distance, std::fabs(dot(normal, corner - centre)));
    return distance;
}

} // namespace lightwell::dxf
