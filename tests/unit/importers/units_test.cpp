#include "engine/base/errors.h"
#include "importers/units.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightwell {
namespace {

TEST(Units, NamesMeanTheirLengthInMetres)
{
    EXPECT_EQ(parse_unit("mm").value, 0.001);
    EXPECT_EQ(parse_unit("Millimetre").value, 0.001);
    EXPECT_EQ(parse_unit(" cm ").value, 0.01);
    EXPECT_EQ(parse_unit("m").value, 1);
    EXPECT_EQ(parse_unit("km").value, 1000);
    EXPECT_EQ(parse_unit("in").value, 0.0254);
    EXPECT_EQ(parse_unit("FEET").value, 0.3048);
    EXPECT_EQ(parse_unit("yd").value, 0.9144);
    EXPECT_EQ(parse_unit("0.02").value, 0.02);
}

TEST(Units, WhatIsNoUnitIsRefusedWithTheList)
{
    for (const char* bad : {"", "furlong", "0", "-1", "nan", "inf", "1e300", "1e-300", "1 m"})
        EXPECT_THROW(parse_unit(bad), InputError) << bad;
    try {
        parse_unit("furlong");
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("furlong"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("mm, cm, dm, m"), std::string::npos) << error.what();
    }
}

TEST(Units, InsunitsFollowTheReference)
{
    // Autodesk DXF reference, $INSUNITS.
    const double expected[] = {0,       0.0254, 0.3048, 1609.344, 1e-3, 1e-2, 1,  1000, 2.54e-8,
                               2.54e-5, 0.9144, 1e-10,  1e-9,     1e-6, 0.1,  10, 100,  1e9};
    for (int code = 0; code < 18; ++code)
        EXPECT_DOUBLE_EQ(unit_of_insunits(code).value, expected[code]) << code;
    EXPECT_NEAR(unit_of_insunits(18).value, 149597870700.0, 1);
    EXPECT_NEAR(unit_of_insunits(21).value, 0.3048006096, 1e-10);
    EXPECT_NEAR(unit_of_insunits(22).value * 12, unit_of_insunits(21).value, 1e-15);
    EXPECT_NEAR(unit_of_insunits(23).value, 3 * unit_of_insunits(21).value, 1e-15);
    EXPECT_NEAR(unit_of_insunits(24).value, 5280 * unit_of_insunits(21).value, 1e-10);
    for (const int unknown : {-1, 25, 1000, -2147483647})
        EXPECT_EQ(unit_of_insunits(unknown).value, 0);
}

TEST(Units, NamesReadBackToTheSameLength)
{
    for (int code = 1; code <= 24; ++code) {
        const MetresPerUnit unit = unit_of_insunits(code);
        EXPECT_EQ(parse_unit(unit_name(unit)).value, unit.value) << unit_name(unit);
    }
    EXPECT_EQ(unit_name(MetresPerUnit{0.001}), "mm");
    EXPECT_EQ(unit_name(MetresPerUnit{0.3048}), "ft");
}

TEST(Units, YUpFilesAreTurnedSoThatTheirYIsUp)
{
    const Affine z_up = to_metres_z_up(MetresPerUnit{0.001}, false);
    EXPECT_EQ(z_up.point({1000, 2000, 3000}), (Point{1, 2, 3}));
    const Affine y_up = to_metres_z_up(MetresPerUnit{0.001}, true);
    EXPECT_EQ(y_up.point({1000, 2000, 3000}), (Point{1, -3, 2}));
    EXPECT_GT(y_up.determinant(), 0) << "no mirror";
}

} // namespace
} // namespace lightwell
