#pragma once

#include "engine/base/box.h"
#include "engine/base/vector.h"

namespace lightwell {

/// Affine map p -> columns * p + translation; mirrored, non-uniform and sheared maps included.
struct Affine {
    Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}; ///< images of the unit vectors (columns of the matrix)
    Vec3 translation{};

    bool operator==(const Affine&) const noexcept = default;

    Vec3 vector(const Vec3& v) const noexcept { return x * v.x + y * v.y + z * v.z; }
    Point point(const Point& p) const noexcept { return vector(p) + translation; }
    double determinant() const noexcept { return dot(x, cross(y, z)); }

    static Affine translate(const Vec3& by) noexcept { return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, by}; }
    static Affine scale(const Vec3& by) noexcept { return {{by.x, 0, 0}, {0, by.y, 0}, {0, 0, by.z}, {}}; }
    static Affine scale(double by) noexcept { return scale(Vec3{by, by, by}); }
    /// Right-handed rotation by angle_rad about coordinate axis 0, 1 or 2; quarter turns are exact.
    static Affine rotate(int axis, double angle_rad) noexcept;
};

/// The map that applies `first` and then `second`.
Affine compose(const Affine& second, const Affine& first) noexcept;
/// @throws InputError when the map is singular or not finite
Affine inverse(const Affine& map);
/// Normal of the image of a plane with this normal (inverse transpose times determinant sign), unit length.
/// A mirrored map keeps the side: the image normal points to the image of the side it pointed to.
Direction transform_normal(const Affine& map, const Direction& normal) noexcept;
/// The uniform scale of the map when it is a similarity (rotation, mirroring, uniform scale) within `tolerance`
/// relative, else 0.
double similarity_scale(const Affine& map, double tolerance = 1e-9) noexcept;
/// The smallest box around the image of a box.
Box transform_box(const Affine& map, const Box& box) noexcept;

} // namespace lightwell
