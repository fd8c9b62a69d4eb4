#pragma once

#include "engine/base/transform.h"

#include <optional>

namespace lightwell {

/// A map as an INSERT of DXF says it: extrusion direction, place, turn about it, and scales.
struct DxfInsert {
    Vec3 extrusion{0, 0, 1};
    Point place; ///< object coordinates
    double turn_deg = 0;
    Vec3 scale{1, 1, 1};
};

/// The axes of object coordinates for an extrusion direction (a unit vector).
/// Source  Autodesk DXF reference, "Arbitrary axis algorithm"
Affine object_axes_of(const Vec3& extrusion);

/// Nothing for a map that shears: no INSERT can say it.
/// Error   1e-12 relative
std::optional<DxfInsert> insert_of(const Affine& map);

} // namespace lightwell
