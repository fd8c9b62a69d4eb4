#pragma once

#include "engine/scene/surface.h"

#include <vector>

namespace lightwell {

/// Whether surfaces lie in one plane, and which way they face: what a luminaire's aim is taken from.
class Facing {
public:
    void add(const Part& part, const Surface& surface, const Affine& to_world);
    /// Polygons and meshes whose fronts all face one way.
    bool is_flat() const;
    /// Downwards; surfaces nearly upright send their light to the front.
    Direction aim() const;
    /// Along the longer side of the smallest rectangle about them that has a side along an edge.
    Vec3 along() const;

private:
    void add(const Point* points, std::size_t count, const Affine& to_world);
    double extent(const Direction& direction) const;

    Vec3 area_{};
    double total_m2_ = 0;
    bool round_ = false;
    std::vector<Point> points_;
    std::vector<Vec3> edges_;
};

} // namespace lightwell
