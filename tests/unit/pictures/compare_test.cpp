#include "engine/pictures/compare.h"
#include "tests/unit/pictures/picture_fixtures.h"

#include <cmath>

namespace lightwell {

using namespace test;

TEST(Compare, APictureEqualsItself)
{
    Picture picture = noise(9, 7, {"R", "G", "B", "Z"});
    picture.channels["Z"][3] = std::numeric_limits<float>::quiet_NaN();
    const Comparison result = compare(picture, picture);
    EXPECT_TRUE(result.identical);
    EXPECT_EQ(result.channels.at("R").relative_rms, 0);
    EXPECT_EQ(result.channels.at("R").mean_ratio, 1);
    EXPECT_EQ(result.channels.at("Z").compared, 62u);
    EXPECT_EQ(result.channels.at("Z").mismatched, 0u);
}

TEST(Compare, FiguresAgreeWithThoseWorkedOutByHand)
{
    Picture reference{2, 2, {}, {}}, picture{2, 2, {}, {}};
    reference.channels = {{"R", {1, 2, 3, 4}}, {"G", {1, 1, 1, 1}}, {"B", {0, 0, 0, 0}}};
    picture.channels = {{"R", {1, 2, 6, 4}}, {"G", {1, 1, 1, 1}}, {"B", {0, 0, 0, 0}}};
    const Comparison result = compare(picture, reference);
    const Difference& red = result.channels.at("R");
    EXPECT_DOUBLE_EQ(red.relative_rms, std::sqrt(9.0 / 30));
    EXPECT_DOUBLE_EQ(red.mean_ratio, 1.3);
    EXPECT_DOUBLE_EQ(red.worst, 3);
    EXPECT_EQ(red.worst_x, 0);
    EXPECT_EQ(red.worst_y, 1);
    EXPECT_EQ(result.channels.at("B").mean_ratio, 1) << "black compared with black";
    EXPECT_NEAR(result.luminance.worst, 179 * 0.265 * 3, 1e-9);
    EXPECT_FALSE(result.identical);
}

TEST(Compare, WhatIsNotANumberInOneOnlyIsCounted)
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), huge = std::numeric_limits<float>::infinity();
    Picture reference{4, 1, {{"Z", {1, nan, huge, 5}}}, {}}, picture{4, 1, {{"Z", {nan, nan, huge, 5}}}, {}};
    const Difference z = compare(picture, reference).channels.at("Z");
    EXPECT_EQ(z.mismatched, 1u);
    EXPECT_EQ(z.compared, 1u);
    EXPECT_EQ(z.relative_rms, 0);
}

TEST(Compare, MissingChannelsAreNamedAndOtherSizesRefused)
{
    const Picture a = noise(3, 3, {"R", "Z"}), b = noise(3, 3, {"R", "Y"});
    const Comparison result = compare(a, b);
    EXPECT_EQ(result.missing, std::vector<std::string>{"Y"});
    EXPECT_EQ(result.additional, std::vector<std::string>{"Z"});
    EXPECT_FALSE(result.identical);
    EXPECT_NE(error_of([&] { compare(a, noise(4, 3, {"R"})); }).find("sizes are 3 x 3 and 4 x 3"), std::string::npos);
}

} // namespace lightwell
