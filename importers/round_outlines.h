#pragma once

#include "engine/scene/surface.h"

#include <set>

namespace lightwell {

/// Corners of a part of a cone's side or of a ring, as if its arcs were chords: counter-clockwise seen from the front.
/// @param from, to  shares of its sector, 0 <= from < to <= 1
std::vector<Point> outline_of_round(const Part& part, const Surface& surface, double from, double to);

/// An order of points, so that they can be looked up; equal only when all coordinates are.
struct PointOrder {
    bool operator()(const Point& a, const Point& b) const noexcept
    {
        return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
    }
};

/// One place for corners that only rounding tells apart: those of round parts are worked out, those of polygons drawn.
class SharedCorners {
public:
    void add(const Point& corner) { corners_.insert(corner); }
    /// The known corner next to this one within rounding, else this one, which is known from then on.
    Point shared(const Point& corner);

private:
    std::set<Point, PointOrder> corners_;
};

} // namespace lightwell
