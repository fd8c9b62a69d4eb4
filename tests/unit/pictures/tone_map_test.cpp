#include "engine/pictures/png.h"
#include "tests/unit/pictures/picture_fixtures.h"

#include <algorithm>
#include <cmath>

namespace lightwell {

using namespace test;

namespace {

Picture grey_picture(const std::vector<float>& values)
{
    Picture picture{static_cast<int>(values.size()), 1, {}, {}};
    for (const char* name : {"R", "G", "B"})
        picture.channels[name] = values;
    return picture;
}

} // namespace

TEST(ToneMap, GreyStaysGreyAndBrighterIsNeverDarker)
{
    std::vector<float> values;
    for (int i = 0; i < 1000; ++i)
        values.push_back(static_cast<float>(std::pow(10.0, -4 + i / 100.0)));
    const DisplayPicture shown = tone_mapped(grey_picture(values));
    int last = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_EQ(shown.rgb[3 * i], shown.rgb[3 * i + 1]);
        EXPECT_EQ(shown.rgb[3 * i], shown.rgb[3 * i + 2]);
        EXPECT_GE(int{shown.rgb[3 * i]}, last);
        last = shown.rgb[3 * i];
    }
    EXPECT_EQ(last, 255) << "the brightest thousandth is white";
}

/// Middle grey 0.18 is 0.18 (1 + 0.18 / 4) / 1.18 on the curve with white at 2, which sRGB encodes as 111.
TEST(ToneMap, AnEvenPictureIsShownAsMiddleGreyWhateverItsRadiance)
{
    for (const float radiance : {1e-6f, 1.0f, 1e6f}) {
        const DisplayPicture shown = tone_mapped(grey_picture(std::vector<float>(50, radiance)));
        EXPECT_NEAR(shown.rgb[30], 111, 1);
    }
}

TEST(ToneMap, BlackCornersAndTheSunDoNotChangeTheExposure)
{
    std::vector<float> room(1000, 1.0f), with_sun = room;
    std::fill_n(with_sun.begin(), 20, 1e7f);
    std::fill_n(with_sun.begin() + 20, 200, 0.0f);
    std::fill_n(with_sun.begin() + 220, 5, std::numeric_limits<float>::quiet_NaN());
    std::fill_n(with_sun.begin() + 225, 5, std::numeric_limits<float>::infinity());
    const DisplayPicture shown = tone_mapped(grey_picture(with_sun));
    EXPECT_NEAR(shown.rgb[3 * 500], tone_mapped(grey_picture(room)).rgb[3 * 500], 3);
    EXPECT_EQ(shown.rgb[0], 255);
    EXPECT_EQ(shown.rgb[3 * 30], 0);
    EXPECT_EQ(shown.rgb[3 * 222], 0) << "not a number is shown black";
    EXPECT_EQ(shown.rgb[3 * 227], 255);
}

TEST(ToneMap, SaturatedColoursKeepTheirHue)
{
    Picture picture{3, 1, {{"R", {0.5f, 0, 0}}, {"G", {0, 0.5f, 0}}, {"B", {0, 0, 0.5f}}}, {}};
    const DisplayPicture shown = tone_mapped(picture, 1);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            if (c != i) {
                EXPECT_GT(shown.rgb[3 * i + i], shown.rgb[3 * i + c]) << i << c;
            }
}

TEST(ToneMap, AGivenExposureIsUsed)
{
    // 0.25 * 2 = 0.5; white at 2: 0.5 (1 + 0.5 / 4) / 1.5 = 0.375, which sRGB encodes as 165.
    EXPECT_NEAR(tone_mapped(grey_picture({0.25f, 0.25f}), 2).rgb[0], 165, 1);
    EXPECT_NE(error_of([] { tone_mapped(grey_picture({1}), -1); }).find("exposure is -1"), std::string::npos);
    EXPECT_NE(error_of([] { tone_mapped(noise(2, 2, {"R", "G"})); }).find("no channel B"), std::string::npos);
}

TEST(ToneMap, ABlackPictureIsShownBlack)
{
    const DisplayPicture shown = tone_mapped(grey_picture(std::vector<float>(10, 0.0f)));
    EXPECT_EQ(std::count(shown.rgb.begin(), shown.rgb.end(), 0), 30);
}

} // namespace lightwell
