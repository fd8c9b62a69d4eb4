#pragma once

#include "engine/sampling/warps.h"
#include "engine/scene/scene.h"

#include <string>
#include <vector>

namespace lightwell {

/// A glazed opening: a parallelogram around a flat pane.
struct Portal {
    Point corner;
    Vec3 edge_x, edge_y;
    Point centre;
    Direction normal;
    double area_m2;
    double radius_m; ///< of a ball about the centre that holds it

    /// Uniform in area.
    SampledDirection sample(const Point& from, UnitSquare u) const noexcept;
    /// Density of sample() in a direction; 0 where it misses the portal.
    double density_per_sr(const Point& from, const Direction& direction) const noexcept;
};

/// The largest flat panes of glass, largest first.
/// @param modifiers  of the panes that are meant; none: all
std::vector<Portal> find_portals(const Scene& scene, const std::vector<std::string>& modifiers = {});

} // namespace lightwell
