#include "materials/material.h"

#include "engine/base/errors.h"

#include <gtest/gtest.h>

#include <limits>

using namespace lightwell;

namespace {

const double nan_value = std::numeric_limits<double>::quiet_NaN();

std::string complaint(const Material& material)
{
    try {
        validate_material(material, "room.rad:7: \"m\"");
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

} // namespace

TEST(Material, OrdinaryMaterialsAreAccepted)
{
    const Spectrum grey = Spectrum::grey(0.5);
    for (const Material& m :
         {Material{Plastic{grey, 0, 0}}, Material{Plastic{Spectrum::grey(1), 1, 1}}, Material{Metal{grey, 0.9, 0.1}},
          Material{Trans{grey, 0, 0, 1, 1}}, Material{Dielectric{Spectrum::grey(1), 1.5, 0}},
          Material{Dielectric{Spectrum::grey(0.5), 0.7, -20}}, Material{Glass{{}, 1.52}}, Material{Mirror{grey}},
          Material{Light{{1e9, 0, 0}}}, Material{Illum{grey, "void"}}, Material{Glow{grey, -1}},
          Material{Spotlight{grey, 360, {0, 0, -3}}}})
        EXPECT_EQ(complaint(m), "") << type_name(m);
}

TEST(Material, AComplaintNamesPlaceValueBoundAndWayOut)
{
    EXPECT_EQ(complaint(Plastic{{0.5, 1.25, 0.5}, 0, 0}),
              "room.rad:7: \"m\": green reflectance is 1.25, expected in [0, 1]; a surface cannot give back more light "
              "than it gets");
    EXPECT_EQ(complaint(Glass{Spectrum::grey(0.9), 0}),
              "room.rad:7: \"m\": refractive index is 0, expected > 0; glass has 1.52, water 1.33");
}

TEST(Material, EveryNumberIsCheckedAgainstNanAndItsRange)
{
    const Spectrum grey = Spectrum::grey(0.5);
    for (double bad : {nan_value, -1e-9, 1 + 1e-9, infinity}) {
        EXPECT_NE(complaint(Plastic{{grey.r, grey.g, bad}, 0, 0}), "");
        EXPECT_NE(complaint(Plastic{grey, bad, 0}), "");
        EXPECT_NE(complaint(Plastic{grey, 0, bad}), "");
        EXPECT_NE(complaint(Metal{grey, bad, 0}), "");
        EXPECT_NE(complaint(Metal{grey, 0, bad}), "");
        EXPECT_NE(complaint(Metal{{bad, 0, 0}, 0, 0}), "");
        EXPECT_NE(complaint(Trans{grey, 0, 0, bad, 0}), "");
        EXPECT_NE(complaint(Trans{grey, 0, 0, 0, bad}), "");
        EXPECT_NE(complaint(Trans{grey, bad, 0, 0, 0}), "");
        EXPECT_NE(complaint(Dielectric{{bad, 1, 1}, 1.5, 0}), "");
        EXPECT_NE(complaint(Glass{{1, bad, 1}, 1.5}), "");
        EXPECT_NE(complaint(Mirror{{1, 1, bad}}), "");
    }
    for (double bad : {nan_value, -1.0, infinity}) {
        EXPECT_NE(complaint(Dielectric{grey, bad, 0}), "");
        EXPECT_NE(complaint(Glass{grey, bad}), "");
        EXPECT_NE(complaint(Light{{bad, 0, 0}}), "");
        EXPECT_NE(complaint(Illum{{0, bad, 0}, ""}), "");
        EXPECT_NE(complaint(Glow{{0, 0, bad}, 0}), "");
        EXPECT_NE(complaint(Spotlight{{0, 0, bad}, 30, {0, 0, 1}}), "");
        EXPECT_NE(complaint(Spotlight{grey, bad, {0, 0, 1}}), "");
    }
    EXPECT_NE(complaint(Dielectric{grey, 1.5, nan_value}), "");
    EXPECT_NE(complaint(Dielectric{grey, 1.5, -750}), "");
    EXPECT_NE(complaint(Glow{grey, nan_value}), "");
    EXPECT_NE(complaint(Spotlight{grey, 0, {0, 0, 1}}), "");
    EXPECT_NE(complaint(Spotlight{grey, 361, {0, 0, 1}}), "");
    EXPECT_NE(complaint(Spotlight{grey, 30, {0, 0, 0}}), "");
    EXPECT_NE(complaint(Spotlight{grey, 30, {0, infinity, 0}}), "");
}

TEST(Material, TypeWordsAreThoseOfTheSceneLanguage)
{
    EXPECT_EQ(type_name(Plastic{}), "plastic");
    EXPECT_EQ(type_name(Metal{}), "metal");
    EXPECT_EQ(type_name(Trans{}), "trans");
    EXPECT_EQ(type_name(Dielectric{}), "dielectric");
    EXPECT_EQ(type_name(Glass{}), "glass");
    EXPECT_EQ(type_name(Mirror{}), "mirror");
    EXPECT_EQ(type_name(Light{}), "light");
    EXPECT_EQ(type_name(Illum{}), "illum");
    EXPECT_EQ(type_name(Glow{}), "glow");
    EXPECT_EQ(type_name(Spotlight{}), "spotlight");
}

TEST(Material, OnlyTheFourLampsEmit)
{
    const Spectrum s{1, 2, 3};
    for (const Material& m :
         {Material{Light{s}}, Material{Illum{s, ""}}, Material{Glow{s, 0}}, Material{Spotlight{s}}}) {
        EXPECT_TRUE(is_emitter(m));
        EXPECT_EQ(emitted_radiance(m), s);
        EXPECT_TRUE(typical_reflectance(m).is_black());
    }
    for (const Material& m : {Material{Plastic{}}, Material{Metal{}}, Material{Trans{}}, Material{Dielectric{}},
                              Material{Glass{}}, Material{Mirror{}}}) {
        EXPECT_FALSE(is_emitter(m));
        EXPECT_TRUE(emitted_radiance(m).is_black());
    }
}

TEST(Material, TypicalReflectanceIsThatUnderDiffuseLight)
{
    EXPECT_NEAR(typical_reflectance(Plastic{Spectrum::grey(0.5), 0.1, 0}).g, 0.55, 1e-15);
    EXPECT_NEAR(typical_reflectance(Metal{Spectrum::grey(0.8), 0.9, 0}).g, 0.8, 1e-15);
    EXPECT_NEAR(typical_reflectance(Trans{Spectrum::grey(0.8), 0, 0, 0.5, 0}).g, 0.4, 1e-15);
    // Hemispherical Fresnel reflectance for an index of 1.52: 0.0947.
    EXPECT_NEAR(typical_reflectance(Dielectric{Spectrum::grey(1), 1.52, 0}).g, 0.09470692699, 2e-4);
}
