#include "engine/scene/sector.h"

namespace lightwell {
namespace {

/// Of a vector across the axis, counter-clockwise from the start, in [0, 2 pi).
double angle_from_start(double along_x, double along_y) noexcept
{
    const double angle = std::atan2(along_y, along_x);
    return angle < 0 ? angle + 2 * pi : angle;
}

} // namespace

bool Sector::holds(const Direction& axis, const Vec3& across) const noexcept
{
    return is_whole() || angle_from_start(dot(across, start), dot(across, cross(axis, start))) <= sweep_rad;
}

Frame sector_frame(const Sector& sector, const Direction& axis) noexcept
{
    return sector.is_whole() ? frame_about(axis) : Frame{sector.start, cross(axis, sector.start), axis};
}

Sector image_of(const Sector& sector, const Direction& axis, const Affine& map, const Direction& image_axis) noexcept
{
    if (sector.is_whole())
        return sector;
    const Vec3 u = map.vector(sector.start), v = map.vector(cross(axis, sector.start));
    if (dot(cross(u, v), image_axis) >= 0)
        return {normalized(u), sector.sweep_rad};
    return {normalized(u * std::cos(sector.sweep_rad) + v * std::sin(sector.sweep_rad)), sector.sweep_rad};
}

Sector turned_over(const Sector& sector, const Direction& axis) noexcept
{
    return image_of(sector, axis, {}, -axis);
}

void extend_by_arc(Box& box, const Point& centre, const Direction& axis, double radius, const Sector& sector,
                   const Affine& map) noexcept
{
    const Frame frame = sector_frame(sector, axis);
    const Vec3 u = map.vector(frame.x * radius), v = map.vector(frame.y * radius);
    const Point middle = map.point(centre);
    if (sector.is_whole()) {
        const Vec3 reach{std::hypot(u.x, v.x), std::hypot(u.y, v.y), std::hypot(u.z, v.z)};
        box.extend(middle - reach);
        box.extend(middle + reach);
        return;
    }
    box.extend(middle + u);
    box.extend(middle + u * std::cos(sector.sweep_rad) + v * std::sin(sector.sweep_rad));
    // Along one coordinate the arc turns back where u cos(angle) + v sin(angle) is as large or as small as it gets.
    for (int i = 0; i < 3; ++i) {
        const double reach = std::hypot(u[i], v[i]);
        for (const double side : {1.0, -1.0})
            if (angle_from_start(side * u[i], side * v[i]) <= sector.sweep_rad) {
                Point turn = middle + u; // a point of the arc in the other coordinates
                turn[i] = middle[i] + side * reach;
                box.extend(turn);
            }
    }
}

} // namespace lightwell
