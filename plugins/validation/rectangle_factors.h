#pragma once

#include "engine/base/vector.h"

namespace lightwell {

/// A rectangle whose sides run along the axes; it has no extent along the axis of its normal.
struct AxisRectangle {
    Point low, high;
    int axis; ///< of its normal: 0, 1, 2
};

/// Area of one times its form factor to the other, m^2: the same both ways. The fronts face each other, and nothing
/// stands between.
/// Error: 1e-12 of the larger area, by cancellation
/// Source  Howell catalogue, C-13 and C-16 (rectangles in any place, in parallel and perpendicular planes)
double exchange_area(const AxisRectangle& one, const AxisRectangle& other);

} // namespace lightwell
