#pragma once

#include "engine/base/vector.h"

#include <string>
#include <vector>

namespace lightwell {

/// One side of a box, seen from inside: points corner + s u + t v with s, t in [0, 1].
struct RoomFace {
    std::string name;
    Point corner;
    Vec3 u, v;
    Direction normal; ///< inwards, along u x v

    std::vector<Point> corners(const Vec3& moved = {}) const
    {
        const Point c = corner + moved;
        return {c, c + u, c + u + v, c + v};
    }
};

/// floor, ceiling, x0, x1, y0, y1 of the box from the origin to `size`.
inline std::vector<RoomFace> room_faces(const Point& size)
{
    const Vec3 x{size.x, 0, 0}, y{0, size.y, 0}, z{0, 0, size.z};
    return {{"floor", {}, x, y, {0, 0, 1}}, {"ceiling", z, y, x, {0, 0, -1}}, {"x0", {}, y, z, {1, 0, 0}},
            {"x1", x, z, y, {-1, 0, 0}},    {"y0", {}, z, x, {0, 1, 0}},      {"y1", y, x, z, {0, -1, 0}}};
}

} // namespace lightwell
