#include "importers/export/dxf_insert.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

/// What an INSERT means, by the words of the format: scale, turn about z, object axes.
Affine meaning(const DxfInsert& insert)
{
    const Vec3 z = normalized(insert.extrusion);
    const bool along = std::fabs(z.x) < 1.0 / 64 && std::fabs(z.y) < 1.0 / 64;
    const Vec3 x = normalized(cross(along ? Vec3{0, 1, 0} : Vec3{0, 0, 1}, z)), y = cross(z, x);
    const double c = std::cos(insert.turn_deg * pi / 180), s = std::sin(insert.turn_deg * pi / 180);
    const Vec3 place = x * insert.place.x + y * insert.place.y + z * insert.place.z;
    return {(x * c + y * s) * insert.scale.x, (y * c - x * s) * insert.scale.y, z * insert.scale.z, place};
}

TEST(DxfInserts, SayEveryMapThatDoesNotShear)
{
    for (const double turn : {0.0, 0.3, 1.9, -2.8})
        for (const Vec3 axis_angles : {Vec3{0, 0, 0}, Vec3{0.01, 0, 0}, Vec3{1.2, 0.4, 0}, Vec3{pi, 0, 0}})
            for (const Vec3 scale : {Vec3{1, 1, 1}, Vec3{-1, 1, 1}, Vec3{2, 3, -0.5}, Vec3{-1, -1, -1}}) {
                Affine map = compose(Affine::rotate(0, axis_angles.x), Affine::rotate(1, axis_angles.y));
                map = compose(compose(map, Affine::rotate(2, turn)), Affine::scale(scale));
                map.translation = {1e6, -20, 3};
                const auto insert = insert_of(map);
                ASSERT_TRUE(insert) << turn << ' ' << axis_angles.x << ' ' << scale.x;
                const Affine said = meaning(*insert);
                for (const auto& [a, b] : {std::pair{said.x, map.x}, std::pair{said.y, map.y}, std::pair{said.z, map.z},
                                           std::pair{said.translation, map.translation}})
                    EXPECT_LE(length(a - b), 1e-12 * length(b));
            }
}

TEST(DxfInserts, CannotSayAShear)
{
    EXPECT_FALSE(insert_of({{1, 0, 0}, {0.2, 1, 0}, {0, 0, 1}, {}}));
    EXPECT_FALSE(insert_of({{1, 0, 0}, {0, 1, 0}, {0, 0.1, 1}, {}}));
}

} // namespace
} // namespace lightwell
