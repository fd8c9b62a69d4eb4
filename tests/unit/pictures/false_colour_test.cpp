#include "engine/pictures/colour_map.h"
#include "engine/pictures/font.h"
#include "engine/pictures/legend.h"
#include "tests/unit/pictures/picture_fixtures.h"

#include <algorithm>
#include <cmath>

namespace lightwell {

using namespace test;

namespace {

constexpr float none = std::numeric_limits<float>::quiet_NaN();
using Colour = std::array<std::uint8_t, 3>;

Colour pixel(const DisplayPicture& picture, int x, int y)
{
    const auto at = static_cast<std::size_t>(3 * (y * picture.width + x));
    return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}

long count_of(const DisplayPicture& picture, Colour colour)
{
    long count = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            count += pixel(picture, x, y) == colour ? 1 : 0;
    return count;
}

Scale scale_from(double low, double high, bool logarithmic = false)
{
    Scale scale;
    scale.low = low;
    scale.high = high;
    scale.logarithmic = logarithmic;
    return scale;
}

} // namespace

TEST(ColourMap, LightnessRisesInEqualStepsFromEndToEnd)
{
    for (int i = 0; i <= 100; ++i) // 14 and 94 are the ends; one step of 8 bits is up to 0.4
        EXPECT_NEAR(lightness_of(map_colour(i / 100.0)), 14 + 80 * i / 100.0, 0.4) << i;
    double last = -1;
    for (int i = 0; i <= 250; ++i) {
        const double lightness = lightness_of(map_colour(i / 250.0));
        EXPECT_GT(lightness, last) << i;
        last = lightness;
    }
}

/// Values of CIE L* for sRGB greys from the definition: 119 is mid grey, L* = 50.03.
TEST(ColourMap, LightnessIsThatOfCie)
{
    EXPECT_NEAR(lightness_of({0, 0, 0}), 0, 1e-9);
    EXPECT_NEAR(lightness_of({255, 255, 255}), 100, 1e-4);
    EXPECT_NEAR(lightness_of({119, 119, 119}), 50.03, 0.01);
    EXPECT_NEAR(lightness_of({255, 0, 0}), 53.24, 0.01);
}

TEST(ColourMap, NeighboursNeverJump)
{
    for (int i = 0; i < 400; ++i) {
        const Colour a = map_colour(i / 400.0), b = map_colour((i + 1) / 400.0);
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_LE(std::abs(a[c] - b[c]), 4) << i;
    }
    EXPECT_EQ(map_colour(-5), map_colour(0));
    EXPECT_EQ(map_colour(7), map_colour(1));
    EXPECT_EQ(map_colour(std::nan("")), map_colour(0));
}

TEST(Legend, NumbersAreThoseThatAPersonWouldChoose)
{
    using Numbers = std::vector<double>;
    EXPECT_EQ(legend_numbers(scale_from(0, 1000), 8), (Numbers{0, 200, 400, 600, 800, 1000}));
    EXPECT_EQ(legend_numbers(scale_from(0, 1000), 4), (Numbers{0, 500, 1000}));
    EXPECT_EQ(legend_numbers(scale_from(0, 730), 8), (Numbers{0, 100, 200, 300, 400, 500, 600, 700}));
    EXPECT_EQ(legend_numbers(scale_from(0, 0.3), 4), (Numbers{0, 0.1, 0.2, 0.3}));
    EXPECT_EQ(legend_numbers(scale_from(-1.5, 1.5), 7), (Numbers{-1.5, -1, -0.5, 0, 0.5, 1, 1.5}));
    EXPECT_EQ(legend_numbers(scale_from(10, 1000, true), 8), (Numbers{10, 20, 50, 100, 200, 500, 1000}));
    EXPECT_EQ(legend_numbers(scale_from(10, 1000, true), 4), (Numbers{10, 100, 1000}));
    EXPECT_EQ(legend_numbers(scale_from(1e-6, 1e9, true), 6), (Numbers{1e-6, 1e-3, 1, 1e3, 1e6, 1e9}));
    EXPECT_EQ(legend_numbers(scale_from(100, 300, true), 5), (Numbers{100, 150, 200, 250, 300}));
}

TEST(Legend, NumbersAreRoundInsideTheScaleAndFewForAnyEnds)
{
    RandomStream random(8);
    for (int i = 0; i < 2000; ++i) {
        const double high = std::pow(10.0, 30 * random.next() - 15),
                     low = random.next() < 0.5 ? 0 : high * random.next() * 0.9;
        const int most = 2 + static_cast<int>(10 * random.next());
        const std::vector<double> numbers = legend_numbers(scale_from(low, high), most);
        ASSERT_LE(static_cast<int>(numbers.size()), most);
        for (const double number : numbers) {
            ASSERT_GE(number, low - 1e-8 * high);
            ASSERT_LE(number, high * (1 + 1e-8));
        }
        if (low == 0) { // then every number is a few digits long
            for (const double number : numbers)
                ASSERT_LE(number_text(number).size(), 9u) << number_text(number);
            ASSERT_GE(numbers.size(), 1u);
        }
    }
}

TEST(Legend, TheUpperEndIsARoundNumberAboveThe99thPercentile)
{
    std::vector<float> values;
    for (int i = 0; i < 1000; ++i)
        values.push_back(static_cast<float>(i)); // 99th percentile 990
    values.push_back(5e6f);                      // a sun patch
    values.push_back(none);
    FalseColour options;
    const Scale scale = choose_scale(values, options);
    EXPECT_EQ(scale.high, 1000);
    EXPECT_EQ(scale.low, 0);
    EXPECT_TRUE(scale.has_more && scale.has_none && !scale.has_less);
    EXPECT_EQ(choose_scale({0.031f, 0.02f}, options).high, 0.04);
    EXPECT_EQ(choose_scale({117}, options).high, 120);
    EXPECT_EQ(choose_scale({0, 0}, options).high, 1) << "a dark field still has a scale";
    EXPECT_EQ(choose_scale({none}, options).high, 1);
    options.logarithmic = true;
    EXPECT_DOUBLE_EQ(choose_scale(values, options).low, 1) << "three decades";
    options.low = 50;
    EXPECT_TRUE(choose_scale(values, options).has_less);
}

TEST(Legend, NumbersAreWrittenPlainly)
{
    EXPECT_EQ(number_text(0), "0");
    EXPECT_EQ(number_text(750), "750");
    EXPECT_EQ(number_text(100000), "100000");
    EXPECT_EQ(number_text(0.05), "0.05");
    EXPECT_EQ(number_text(-2.5), "-2.5");
    EXPECT_EQ(number_text(2e9), "2e9");
    EXPECT_EQ(number_text(5e12), "5e12");
    EXPECT_EQ(number_text(1e-7), "1e-07");
}

TEST(FalseColour, EveryCellHasTheColourOfItsValueAndNothingIsGrey)
{
    FalseColour options;
    options.high = 1000;
    options.title = "Work plane";
    // 300 x 300 pixels of map: larger than the smallest, so cells keep the size that was asked for.
    const DisplayPicture picture = false_colour({0, 500, 1000, none}, 2, 2, options, 150);
    for (const double value : {0.0, 500.0, 1000.0})
        EXPECT_GE(count_of(picture, map_colour(value / 1000)), 150 * 150) << value;
    EXPECT_GE(count_of(picture, {222, 222, 222}), 150 * 150);
    EXPECT_LE(count_of(picture, {222, 222, 222}), 150 * 150 + 1000) << "beside the cell only the legend's swatch";
    const DisplayPicture full = false_colour({0, 500, 1000, 10}, 2, 2, options, 150);
    EXPECT_EQ(count_of(full, {222, 222, 222}), 0);
}

TEST(FalseColour, LogarithmicPlacesAreThoseOfTheLogarithm)
{
    FalseColour options;
    options.low = 1;
    options.high = 10000;
    options.logarithmic = true;
    const DisplayPicture picture = false_colour({100, 100, 100, -5}, 2, 2, options, 150);
    EXPECT_GE(count_of(picture, map_colour(0.5)), 3 * 150 * 150);
    EXPECT_GE(count_of(picture, map_colour(0)), 150 * 150);
}

TEST(FalseColour, NothingReachesTheMarginWhateverTheMapAndTheTexts)
{
    const std::string word(70, 'W');
    for (const int width : {1, 3, 40, 1000})
        for (const int height : {1, 5, 400})
            for (const std::string& text :
                 {std::string(), std::string("Office"), word + " " + word + " long title\nsecond line"}) {
                FalseColour options;
                options.title = options.caption = text;
                options.unit = "cd/m\xc2\xb2";
                std::vector<float> values(static_cast<std::size_t>(width * height), 12345678.0f);
                values[0] = none;
                values.back() = -3;
                const DisplayPicture picture = false_colour(values, width, height, options);
                EXPECT_GE(picture.width, 240);
                EXPECT_GE(picture.height, 160);
                for (int y = 0; y < picture.height; ++y)
                    for (int x = 0; x < picture.width; ++x)
                        if (x < 15 || y < 15 || x >= picture.width - 15 || y >= picture.height - 15) {
                            ASSERT_EQ(pixel(picture, x, y), (Colour{255, 255, 255}))
                                << width << " x " << height << " " << text << ": " << x << ", " << y;
                        }
            }
}

TEST(FalseColour, WhatCannotBeDrawnIsRefusedByName)
{
    FalseColour options;
    EXPECT_NE(error_of([&] {
                  false_colour({1, 2, 3}, 2, 2, options);
              }).find("has 3 values, expected 2 x 2"),
              std::string::npos);
    EXPECT_NE(error_of([&] { false_colour({}, 0, 0, options); }).find("0 x 0"), std::string::npos);
    EXPECT_NE(error_of([&] { false_colour({1}, 1, 1, options, 0); }).find("a cell is 0 pixels"), std::string::npos);
    EXPECT_NE(error_of([&] { false_colour({1}, 1, 1, options, 100000); }).find("a cell is 100000 pixels"),
              std::string::npos);
    options.low = 5;
    options.high = 5;
    EXPECT_NE(error_of([&] { false_colour({1}, 1, 1, options); }).find("from 5 to 5"), std::string::npos);
    options.high = std::nan("");
    EXPECT_NE(error_of([&] { false_colour({1}, 1, 1, options); }).find("from 5 to nan"), std::string::npos);
    options = {};
    options.low = -1;
    options.high = 10;
    options.logarithmic = true;
    EXPECT_NE(error_of([&] { false_colour({1}, 1, 1, options); }).find("logarithmic"), std::string::npos);
}

TEST(FalseColour, InfiniteValuesTakeTheEndsOfTheScale)
{
    constexpr float huge = std::numeric_limits<float>::infinity();
    const DisplayPicture picture = false_colour({huge, -huge, 1, 2}, 2, 2, {}, 150);
    EXPECT_GE(count_of(picture, map_colour(1)), 2 * 150 * 150) << "infinity, and 2, the upper end";
    EXPECT_GE(count_of(picture, map_colour(0)), 150 * 150);
}

TEST(Font, LettersAreDrawnWhereAskedAtTheScaleAsked)
{
    DisplayPicture picture{20, 20, std::vector<std::uint8_t>(1200, 255)};
    draw_text(picture, 2, 3, "L", 2, {0, 0, 0}); // 7 rows of a stem and 4 more columns of foot, four pixels each
    EXPECT_EQ(count_of(picture, {0, 0, 0}), (7 + 4) * 4);
    EXPECT_EQ(pixel(picture, 2, 3), (Colour{0, 0, 0}));
    EXPECT_EQ(pixel(picture, 11, 16), (Colour{0, 0, 0}));
    EXPECT_EQ(pixel(picture, 12, 16), (Colour{255, 255, 255}));
    draw_text(picture, -500, 15, "clipped everywhere", 3, {9, 9, 9});
}

TEST(Font, EveryPrintableCharacterHasAShapeOfItsOwn)
{
    std::map<std::string, std::string> shapes;
    std::vector<std::string> texts{"\xc2\xb2", "\xc2\xb0",     "\xc2\xb1",    "\xc2\xb5",
                                   "\xc3\x97", "\xe2\x89\xa5", "\xe2\x89\xa4"};
    for (char c = '!'; c <= '~'; ++c)
        texts.emplace_back(1, c);
    texts.emplace_back("\xe4\xb8\x80"); // has no glyph: the empty box
    for (const std::string& text : texts) {
        DisplayPicture picture{6, 9, std::vector<std::uint8_t>(162, 255)};
        draw_text(picture, 0, 0, text, 1, {0, 0, 0});
        EXPECT_GT(count_of(picture, {0, 0, 0}), 0) << text;
        const auto [known, fresh] = shapes.try_emplace(std::string(picture.rgb.begin(), picture.rgb.end()), text);
        EXPECT_TRUE(fresh) << text << " looks like " << known->second;
    }
}

TEST(Font, LinesAreBrokenAtBlanksAndNeverTooWide)
{
    EXPECT_EQ(wrapped("one two three", 7 * 6, 1), (std::vector<std::string>{"one two", "three"}));
    EXPECT_EQ(wrapped("abcdefghij", 4 * 6, 1), (std::vector<std::string>{"abcd", "efgh", "ij"}));
    EXPECT_EQ(wrapped("a\nb", 100, 1), (std::vector<std::string>{"a", "b"}));
    EXPECT_TRUE(wrapped("", 100, 1).empty());
    for (const std::string& line : wrapped("average 412 lx, minimum 3 lx, uniformity 0.3 of a long room", 130, 2))
        EXPECT_LE(text_width(line, 2), 130);
}

} // namespace lightwell
