#pragma once

#include "importers/dxf/shapes.h"

#include <optional>
#include <vector>

namespace lightwell::dxf {

/// A closed boundary in the plane of its area.
struct Loop {
    std::vector<Point> points; ///< z = 0; the last is not the first
    struct Circle {
        Point centre;
        double radius;
    };
    std::optional<Circle> circle; ///< the boundary is this circle, and `points` only stand for it
};

/// Which loops bound an area when several lie inside each other.
enum class Islands {
    alternate, ///< each second one is a hole
    outermost, ///< only between the outermost ones and those directly inside
    ignored    ///< all is filled that lies in an outermost one
};

/// A loop with the loops that are cut out of it.
struct FilledLoop {
    std::size_t outline;
    std::vector<std::size_t> holes;
};

/// @param loops  do not cross each other; each with an area
std::vector<FilledLoop> nested(const std::vector<Loop>& loops, Islands islands);

/// The corners of a loop, turned so that they run counter-clockwise or clockwise.
std::vector<Point> turned(const Loop& loop, bool counter_clockwise);

/// One outline, counter-clockwise, with its holes joined to it by seams that do not cross other holes.
std::vector<Point> joined(const std::vector<Loop>& loops, const FilledLoop& filled);

} // namespace lightwell::dxf
