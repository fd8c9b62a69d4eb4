#include "importers/export/dxf_insert.h"

namespace lightwell {
namespace {

Affine image_of(const DxfInsert& insert)
{
    const Affine turned =
        compose(object_axes_of(insert.extrusion), Affine::rotate(2, insert.turn_deg * radians_per_degree));
    Affine map = compose(turned, Affine::scale(insert.scale));
    map.translation = object_axes_of(insert.extrusion).point(insert.place);
    return map;
}

bool same(const Affine& a, const Affine& b)
{
    constexpr double tolerance = 1e-13; // of the lengths: what rounding in a few steps leaves
    const auto close = [](const Vec3& u, const Vec3& v) {
        return length(u - v) <= tolerance * (length(u) + length(v));
    };
    return close(a.x, b.x) && close(a.y, b.y) && close(a.z, b.z) && close(a.translation, b.translation);
}

} // namespace

Affine object_axes_of(const Vec3& extrusion)
{
    constexpr double near_z = 1.0 / 64;
    const bool along_z = std::fabs(extrusion.x) < near_z && std::fabs(extrusion.y) < near_z;
    const Vec3 x = normalized(cross(along_z ? Vec3{0, 1, 0} : Vec3{0, 0, 1}, extrusion));
    return {x, normalized(cross(extrusion, x)), extrusion, {}};
}

std::optional<DxfInsert> insert_of(const Affine& map)
{
    // Both directions are tried: an upright insert then keeps the extrusion +z, and a mirrored one a negative scale.
    for (const double side : {1.0, -1.0}) {
        DxfInsert insert;
        const double height = length(map.z);
        insert.extrusion = map.z * (side / height);
        const Affine axes = object_axes_of(insert.extrusion);
        const Vec3 x{dot(axes.x, map.x), dot(axes.y, map.x), 0};
        insert.turn_deg = std::atan2(x.y, x.x) / radians_per_degree;
        const Affine turned = compose(axes, Affine::rotate(2, insert.turn_deg * radians_per_degree));
        insert.scale = {length(map.x), std::copysign(length(map.y), dot(turned.y, map.y)), side * height};
        insert.place = {dot(axes.x, map.translation), dot(axes.y, map.translation), dot(axes.z, map.translation)};
        if (insert.extrusion.z >= 0 || side < 0)
            return same(image_of(insert), map) ? std::optional<DxfInsert>{insert} : std::nullopt;
    }
    return std::nullopt;
}

} // namespace lightwell
