#include "engine/base/transform.h"

#include "engine/base/errors.h"

namespace lightwell {

Affine Affine::rotate(int axis, double angle_rad) noexcept
{
    double s = std::sin(angle_rad), c = std::cos(angle_rad);
    // A quarter turn typed as 90 degrees must not shear a building by 6e-17.
    const double quarters = angle_rad / (pi / 2);
    if (quarters == std::nearbyint(quarters)) {
        s = std::nearbyint(s);
        c = std::nearbyint(c);
    }
    if (axis == 0)
        return {{1, 0, 0}, {0, c, s}, {0, -s, c}, {}};
    if (axis == 1)
        return {{c, 0, -s}, {0, 1, 0}, {s, 0, c}, {}};
    return {{c, s, 0}, {-s, c, 0}, {0, 0, 1}, {}};
}

Affine compose(const Affine& second, const Affine& first) noexcept
{
    return {second.vector(first.x), second.vector(first.y), second.vector(first.z), second.point(first.translation)};
}

Affine inverse(const Affine& map)
{
    const double determinant = map.determinant();
    if (!(std::fabs(determinant) > 0) || !std::isfinite(determinant) || !is_finite(map.translation))
        throw InputError{"transform", "the map is singular or not finite", "use scales that are finite and not zero"};
    // Rows of the inverse are the cross products of the columns.
    const Vec3 r0 = cross(map.y, map.z) / determinant;
    const Vec3 r1 = cross(map.z, map.x) / determinant;
    const Vec3 r2 = cross(map.x, map.y) / determinant;
    Affine result{{r0.x, r1.x, r2.x}, {r0.y, r1.y, r2.y}, {r0.z, r1.z, r2.z}, {}};
    result.translation = -result.vector(map.translation);
    return result;
}

Direction transform_normal(const Affine& map, const Direction& normal) noexcept
{
    // Cofactor matrix times normal = determinant * inverse transpose * normal.
    const Vec3 image = cross(map.y, map.z) * normal.x + cross(map.z, map.x) * normal.y + cross(map.x, map.y) * normal.z;
    return normalized(map.determinant() < 0 ? -image : image);
}

double similarity_scale(const Affine& map, double tolerance) noexcept
{
    const double xx = dot(map.x, map.x), yy = dot(map.y, map.y), zz = dot(map.z, map.z);
    const double slack = 2 * tolerance * xx;
    const bool similar = std::fabs(yy - xx) <= slack && std::fabs(zz - xx) <= slack &&
                         std::fabs(dot(map.x, map.y)) <= slack && std::fabs(dot(map.y, map.z)) <= slack &&
                         std::fabs(dot(map.z, map.x)) <= slack;
    return similar ? std::sqrt(xx) : 0;
}

Box transform_box(const Affine& map, const Box& box) noexcept
{
    Box image;
    if (!box.empty())
        for (int i = 0; i < 8; ++i)
            image.extend(map.point(box.corner(i)));
    return image;
}

} // namespace lightwell
