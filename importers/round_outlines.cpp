#include "importers/round_outlines.h"

#include <algorithm>

namespace lightwell {

std::vector<Point> outline_of_round(const Part& part, const Surface& surface, double from, double to)
{
    const Sector& sector = sector_of(part, surface);
    const auto arc_point = [&](const Frame& frame, const Point& centre, double radius, double share) {
        const double angle = share * sector.sweep_rad;
        return centre + (frame.x * std::cos(angle) + frame.y * std::sin(angle)) * radius;
    };
    if (surface.shape == Shape::ring) {
        const Ring& ring = part.rings[surface.index];
        const Frame frame = sector_frame(sector, ring.normal);
        std::vector<Point> corners{arc_point(frame, ring.centre, ring.outer_radius, from),
                                   arc_point(frame, ring.centre, ring.outer_radius, to)};
        if (ring.inner_radius > 0)
            corners.push_back(arc_point(frame, ring.centre, ring.inner_radius, to));
        corners.push_back(arc_point(frame, ring.centre, ring.inner_radius, from));
        return corners;
    }
    const Cone& cone = part.cones[surface.index];
    const Frame frame = sector_frame(sector, normalized(cone.ends[1] - cone.ends[0]));
    std::vector<Point> corners{
        arc_point(frame, cone.ends[0], cone.radii[0], from), arc_point(frame, cone.ends[0], cone.radii[0], to),
        arc_point(frame, cone.ends[1], cone.radii[1], to), arc_point(frame, cone.ends[1], cone.radii[1], from)};
    if (surface.shape == Shape::cup || surface.shape == Shape::tube)
        std::reverse(corners.begin(), corners.end());
    return corners;
}

Point SharedCorners::shared(const Point& corner)
{
    constexpr double rounding = 1e-9; // relative: several steps of transforms between both
    const double within = rounding * std::fmax(1, max_abs(corner));
    for (auto near = corners_.lower_bound(corner - Vec3{within, infinity, infinity});
         near != corners_.end() && near->x <= corner.x + within; ++near)
        if (max_abs(*near - corner) <= within)
            return *near;
    corners_.insert(corner);
    return corner;
}

} // namespace lightwell
