#include "importers/layered_materials.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

/// What Trans sends back diffusely and what it lets through unscattered (material.h), photopic.
double diffuse_of(const Trans& m)
{
    return photopic(m.colour) * (1 - m.specularity) * (1 - m.transmission);
}
double passed_by(const Trans& m)
{
    return photopic(m.colour) * (1 - m.specularity) * m.transmission * m.transmitted_specular;
}

TEST(LayeredMaterials, APartlyOpenSurfaceReflectsAndPassesItsShares)
{
    for (const double opacity : {0.0, 0.25, 0.5, 0.9, 1.0})
        for (const Spectrum& colour : {Spectrum{0.8, 0.1, 0.3}, Spectrum{}, Spectrum::grey(1)}) {
            const Plastic covered{colour, 0.04, 0.1};
            const Trans open = partly_open(covered, opacity);
            EXPECT_NO_THROW(validate_material(open, "open"));
            EXPECT_NEAR(diffuse_of(open), opacity * 0.96 * photopic(colour), 1e-12);
            EXPECT_NEAR(passed_by(open), 1 - opacity, 1e-12);
            EXPECT_NEAR(open.specularity, opacity * 0.04, 1e-15);
        }
}

TEST(LayeredMaterials, ACoatAddsFourPercentAndTakesItFromTheRest)
{
    const Plastic coated = with_coat({{0.5, 0.5, 0.5}, 0.04, 0.25}, 1, 0.01);
    EXPECT_NEAR(coated.specularity, 0.0784, 1e-12); // 1 - 0.96^2
    EXPECT_NEAR(coated.colour.g * (1 - coated.specularity), 0.5 * 0.96 * 0.96, 1e-12);
    EXPECT_NEAR(coated.roughness, 0.13, 1e-12); // both highlights weigh the same
    const Plastic none = with_coat({{0.5, 0.5, 0.5}, 0, 0}, 0, 0.5);
    EXPECT_EQ(none.specularity, 0);
}

TEST(LayeredMaterials, SheenAddsTheMeanReflectanceOfItsFibresAndMakesNoEnergy)
{
    // Numerical integration (48 x 48 x 96 directions) of the published distribution: 0.1703 at roughness 0.5.
    const Plastic cloth = with_sheen({{0, 0, 0}, 0, 0}, {1, 1, 1}, 0.5);
    EXPECT_NEAR(cloth.colour.g, 0.1703, 0.003);
    const Plastic white = with_sheen({{1, 1, 1}, 0, 0}, {1, 1, 1}, 1);
    EXPECT_NEAR(white.colour.g, 1, 1e-12);
}

} // namespace
} // namespace lightwell
