#include "materials/emission.h"

#include <gtest/gtest.h>

#include <limits>

using namespace lightwell;

namespace {

const Spectrum warm{3, 2, 1};

Direction tilted(double angle_deg)
{
    const double t = angle_deg * radians_per_degree;
    return {std::sin(t), 0, -std::cos(t)};
}

} // namespace

TEST(Emission, LampsSendFromTheFrontOnly)
{
    for (const Material& m : {Material{Light{warm}}, Material{Illum{warm, "void"}}, Material{Glow{warm, 0}},
                              Material{Spotlight{warm, 360, {0, 0, -1}}}}) {
        EXPECT_EQ(emitted_towards(m, 0.5, {0, 0, 1}), warm);
        EXPECT_EQ(emitted_towards(m, 1e-9, {0, 0, 1}), warm);
        EXPECT_TRUE(emitted_towards(m, 0, {0, 0, 1}).is_black());
        EXPECT_TRUE(emitted_towards(m, -0.5, {0, 0, 1}).is_black());
        EXPECT_TRUE(emitted_towards(m, std::numeric_limits<double>::quiet_NaN(), {0, 0, 1}).is_black());
    }
    EXPECT_TRUE(emitted_towards(Plastic{warm, 0, 0}, 1, {0, 0, 1}).is_black());
}

TEST(Emission, ASpotlightEndsAtHalfItsFullAngle)
{
    // The aim's length is the distance of the focal point and does not matter here.
    for (double full_angle : {1e-6, 1.0, 40.0, 180.0, 300.0}) {
        const Spotlight spot{warm, full_angle, {0, 0, -7}};
        EXPECT_EQ(emitted_towards(spot, 1, tilted(full_angle / 2 * (1 - 1e-6))), warm) << full_angle;
        EXPECT_TRUE(emitted_towards(spot, 1, tilted(full_angle / 2 * (1 + 1e-6))).is_black()) << full_angle;
    }
}
