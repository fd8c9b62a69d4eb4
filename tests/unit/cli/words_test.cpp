#include "engine/base/errors.h"
#include "plugins/cli/options.h"
#include "plugins/cli/sky_words.h"

#include <CLI/CLI.hpp>
#include <gtest/gtest.h>

namespace lightwell {
namespace {

PlaceAndTime time_of(const std::string& text)
{
    PlaceAndTime when;
    parse_time(text, when);
    return when;
}

TEST(TimeWords, AreReadWithTheirOffsetFromUtc)
{
    const PlaceAndTime when = time_of("2026-03-21T12:30+01:00");
    EXPECT_EQ(when.year, 2026);
    EXPECT_EQ(when.month, 3);
    EXPECT_EQ(when.day, 21);
    EXPECT_DOUBLE_EQ(when.hour, 12.5);
    EXPECT_DOUBLE_EQ(when.utc_offset_h, 1);
    EXPECT_DOUBLE_EQ(time_of("2026-03-21T12:30-0330").utc_offset_h, -3.5);
    EXPECT_DOUBLE_EQ(time_of("2026-03-21T12:30Z").utc_offset_h, 0);
    EXPECT_DOUBLE_EQ(time_of("2026-03-21T06:00:36Z").hour, 6.01);
    EXPECT_EQ(time_of("2024-02-29T00:00Z").day, 29);
}

TEST(TimeWords, ThatNameNoMomentAreRejectedWithTheForm)
{
    for (const char* text :
         {"", "noon", "2026-03-21", "2026-03-21T12:30", "2026-02-29T12:00Z", "2026-13-01T12:00Z", "2026-03-21T24:00Z",
          "2026-03-21T12:60Z", "2026-03-21T12:00+15:00", "2026-03-21T12:00+01:60", "2026-03-21T12:00Zulu",
          "2026-03-21T12:00 +01:00", "2026-03-21T12:00+01:00x", "-026-03-21T12:00Z", "2026-03-21T12:00*01:00"}) {
        SCOPED_TRACE(text);
        try {
            time_of(text);
            ADD_FAILURE() << "accepted";
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find("2026-03-21T12:00+01:00"), std::string::npos) << error.what();
        }
    }
}

TEST(PlaceWords, AreLatitudeAndLongitudeInRange)
{
    PlaceAndTime when;
    parse_place("-33.9, 151.2", when);
    EXPECT_DOUBLE_EQ(when.latitude_deg, -33.9);
    EXPECT_DOUBLE_EQ(when.longitude_deg, 151.2);
    for (const char* text : {"", "52.5", "52.5,13.4,0", "91,0", "0,181", "nan,0", "a,b"})
        EXPECT_THROW(parse_place(text, when), InputError) << text;
}

/// Berlin, equinox, clock time 12:00 in winter time: the sun passes south at 12:14, at altitude 90 - 52.5 + 0.0.
/// Source  equation of time on 21 March -7.3 min, longitude 13.4: 12:00 + 7.3 min + (15 - 13.4) * 4 min
TEST(SkyWords, PutTheSunWhereTheAlmanacDoes)
{
    SkyWords words;
    words.type = "clear";
    words.place = "52.5,13.4";
    words.time = "2026-03-21T12:14+01:00";
    const DescribedSky south = sky_of(words);
    EXPECT_NEAR(south.model.to_sun.x, 0, 0.01);
    EXPECT_NEAR(south.model.to_sun.z, std::sin(37.8 * radians_per_degree), 0.01);
    EXPECT_LT(south.model.to_sun.y, 0);
    EXPECT_TRUE(south.model.with_sun);
    words.north_deg = 90; // north is -x, so south is +x
    EXPECT_GT(sky_of(words).model.to_sun.x, 0.75);
    words.type = "clear-no-sun";
    EXPECT_FALSE(sky_of(words).model.with_sun);
}

TEST(SkyWords, GeneralSkiesHaveAsMuchLightAsTheSkyTheyTakeAfter)
{
    SkyWords words;
    words.place = "52.5,13.4";
    words.time = "2026-03-21T12:14+01:00";
    for (const auto& [type, like] : {std::pair("cie-1", "overcast"), {"cie-8", "intermediate"}, {"cie-12", "clear"}}) {
        words.type = type;
        const DescribedSky sky = sky_of(words);
        ASSERT_TRUE(sky.general) << type;
        EXPECT_NE(sky.description.find("sky " + std::string(type).substr(4) + ", sun at"), std::string::npos);
        words.type = like;
        const SkyModel model = sky_of(words).model;
        EXPECT_DOUBLE_EQ(sky.general->ground, model.ground) << type;
        EXPECT_DOUBLE_EQ(sky.general->sun_radiance, model.with_sun ? model.sun_radiance : 0) << type;
    }
    words.type = "cie-5"; // uniform: its radiance is the irradiance over pi
    Scene scene;
    const DescribedSky uniform = sky_of(words);
    add_described_sky(scene, uniform);
    ASSERT_EQ(scene.root.surfaces.size(), 2u); // no sun
    words.type = "overcast";                   // whose mean is 7/9 of the zenith
    EXPECT_NEAR(uniform.general->normalization * uniform.general->shape.relative(1, 1),
                sky_of(words).model.zenith * 7 / 9, 1e-3 * sky_of(words).model.zenith);
    words.type = "cie-12";
    Scene sunny;
    add_described_sky(sunny, sky_of(words));
    EXPECT_EQ(sunny.root.surfaces.size(), 3u);
    for (const char* bad : {"cie-0", "cie-16", "cie-", "cie-1x"}) {
        words.type = bad;
        EXPECT_THROW(sky_of(words), InputError) << bad;
    }
}

TEST(EffortWords, AcceptPercentAndFractions)
{
    EXPECT_DOUBLE_EQ(parse_accuracy("5%"), 0.05);
    EXPECT_DOUBLE_EQ(parse_accuracy("0.02"), 0.02);
    for (const char* text : {"", "%", "0", "0%", "-1%", "100%", "1", "nan", "5%%", "inf", "five"})
        EXPECT_THROW(parse_accuracy(text), CLI::ValidationError) << text;
}

TEST(SizeWords, AreTwoNumbersOfPixels)
{
    EXPECT_EQ(parse_size("960x540"), std::pair(960, 540));
    EXPECT_EQ(parse_size("1x32768"), std::pair(1, 32768));
    for (const char* text : {"", "960", "960x", "x540", "0x10", "10x-1", "32769x1", "1x2x3", "9e2x5", "99999999999x1"})
        EXPECT_THROW(parse_size(text), CLI::ValidationError) << text;
}

} // namespace
} // namespace lightwell
