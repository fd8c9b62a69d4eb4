#pragma once

#include "engine/base/box.h"
#include "engine/base/frame.h"
#include "engine/base/transform.h"

namespace lightwell {

/// How much of a full turn about its axis a round surface covers.
struct Sector {
    Direction start{};         ///< unit vector across the axis; of a whole turn it says nothing
    double sweep_rad = 2 * pi; ///< (0, 2 pi], counter-clockwise about the axis

    bool is_whole() const noexcept { return sweep_rad >= 2 * pi; }
    /// Share of the full turn.
    double share() const noexcept { return is_whole() ? 1 : sweep_rad / (2 * pi); }
    /// Whether a vector from the axis points into it.
    /// @param axis  unit vector
    bool holds(const Direction& axis, const Vec3& across) const noexcept;
};

/// z along the axis, x where the sector starts; of a whole turn any frame about the axis.
Frame sector_frame(const Sector& sector, const Direction& axis) noexcept;
/// The sector of the image, for maps under which circles across the axis stay circles.
/// @param image_axis  of the image, whose front may be the other side of the turned axis
Sector image_of(const Sector& sector, const Direction& axis, const Affine& map, const Direction& image_axis) noexcept;
/// The same sector about the opposite axis.
Sector turned_over(const Sector& sector, const Direction& axis) noexcept;
/// Adds the image of an arc about the axis to a box. Error: 4 ulp of the coordinates
void extend_by_arc(Box& box, const Point& centre, const Direction& axis, double radius, const Sector& sector,
                   const Affine& map = {}) noexcept;

} // namespace lightwell
