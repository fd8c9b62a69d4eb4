#include "engine/base/errors.h"
#include "engine/base/random.h"
#include "engine/scene/scene.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

Direction across(const Direction& axis, double angle)
{
    const Frame frame = frame_about(axis);
    return frame.x * std::cos(angle) + frame.y * std::sin(angle);
}

/// A point of an arc, by a rotation of the start about the axis (Rodrigues), which the code under test does not use.
Vec3 turned(const Direction& axis, const Direction& start, double angle)
{
    return start * std::cos(angle) + cross(axis, start) * std::sin(angle) +
           axis * (dot(axis, start) * (1 - std::cos(angle)));
}

Affine any_map(RandomStream& random, bool similar)
{
    Affine map = compose(Affine::rotate(0, 6 * random.next()), Affine::rotate(1, 6 * random.next()));
    const double side = random.next() < 0.5 ? -1 : 1;
    map = compose(map, Affine::scale(similar ? Vec3{side * 2, 2, 2} : Vec3{side * (0.2 + random.next()), 2, 0.7}));
    map.translation = {random.next(), -3, random.next()};
    return map;
}

TEST(Sectors, BoundsHoldTheArcAndAreTouchedByIt)
{
    RandomStream random(11);
    constexpr int steps = 20000;
    for (int i = 0; i < 40; ++i) {
        const Direction axis = normalized({random.next() - 0.5, random.next() - 0.5, random.next() - 0.5});
        const Ring ring{{1, 2, 3}, axis, 0.5, 2, {across(axis, 6 * random.next()), 0.05 + 6.2 * random.next()}};
        const Affine map = any_map(random, false);
        Part part;
        part.add_ring(ring, void_modifier, "r");
        const Box box = surface_bounds(part, part.surfaces[0], map);
        Box expected;
        for (int k = 0; k <= steps; ++k) {
            const Vec3 out = turned(axis, ring.sector.start, ring.sector.sweep_rad * k / steps);
            expected.extend(map.point(ring.centre + out * ring.inner_radius));
            expected.extend(map.point(ring.centre + out * ring.outer_radius));
        }
        // Between two steps an arc of radius 4 rises by r (step / 2)^2 / 2 at most.
        const double within = 4 * std::pow(ring.sector.sweep_rad / steps, 2);
        EXPECT_LE(max_abs(box.low - expected.low), within) << i;
        EXPECT_LE(max_abs(box.high - expected.high), within) << i;
    }
}

TEST(Sectors, ImagesUnderMirroredMapsHoldTheImagesOfTheirPoints)
{
    RandomStream random(12);
    for (int i = 0; i < 200; ++i) {
        const Direction axis = normalized({random.next() - 0.5, random.next() - 0.5, random.next() - 0.5});
        const Sector sector{across(axis, 6 * random.next()), 0.05 + 6.2 * random.next()};
        const Affine map = any_map(random, true);
        const Direction image_axis = transform_normal(map, axis);
        const Sector image = image_of(sector, axis, map, image_axis);
        EXPECT_EQ(image.sweep_rad, sector.sweep_rad);
        for (int k = 0; k < 50; ++k) {
            const double angle = 2 * pi * random.next();
            const Vec3 out = turned(axis, sector.start, angle);
            const bool inside = angle <= sector.sweep_rad;
            EXPECT_EQ(sector.holds(axis, out), inside);
            EXPECT_EQ(image.holds(image_axis, map.vector(out)), inside);
            EXPECT_EQ(turned_over(sector, axis).holds(-axis, out), inside);
        }
    }
}

TEST(Sectors, AreasAreTheirShareOfTheTurn)
{
    Part part;
    part.add_ring({{}, {0, 0, 1}, 1, 3, {{1, 0, 0}, pi / 3}}, void_modifier, "r");
    part.add_cone({{{0, 0, 0}, {0, 0, 3}}, {4, 0}, {{0, 1, 0}, pi / 2}}, Shape::cone, void_modifier, "c");
    EXPECT_NEAR(surface_area_m2(part, part.surfaces[0]), (9 - 1) * pi / 6, 1e-14);
    EXPECT_NEAR(surface_area_m2(part, part.surfaces[1]), pi * 4 * 5 / 4, 1e-13); // slant 5, a quarter of the turn
}

TEST(Sectors, ThatAreNoneAreRefusedWithTheNumber)
{
    const auto refusal = [](const Sector& sector) {
        Scene scene;
        scene.root.add_ring({{}, {0, 0, 1}, 0, 1, sector}, void_modifier, "plate");
        try {
            validate(scene);
        } catch (const InputError& error) {
            return std::string{error.what()};
        }
        return std::string{};
    };
    EXPECT_EQ(refusal({{1, 0, 0}, 1}), "");
    EXPECT_EQ(refusal({}), "");
    EXPECT_NE(refusal({{1, 0, 0}, 0}).find("sweep is 0"), std::string::npos);
    EXPECT_NE(refusal({{1, 0, 0}, -1}).find("sweep is -1"), std::string::npos);
    EXPECT_NE(refusal({{1, 0, 0}, std::nan("")}).find("sweep is nan"), std::string::npos);
    EXPECT_NE(refusal({{0, 0, 1}, 1}).find("along the axis"), std::string::npos);
    EXPECT_NE(refusal({{2, 0, 0}, 1}).find("length 2"), std::string::npos);
}

} // namespace
} // namespace lightwell
