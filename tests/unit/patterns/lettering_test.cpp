#include "engine/base/errors.h"
#include "tests/unit/patterns/pattern_text.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

/// One square letter from 51 to 204 in both directions, a fifth to four fifths; and a blank.
constexpr const char* square_font = "32 0\n79 4  51 51 204 51 204 204 51 204 # O\n";

class LetteringTest : public testing::Test {
protected:
    LetteringTest() { folder_.write("square.fnt", square_font); }

    double at(const std::vector<std::string>& words, double x, double y, double spacing = 0) const
    {
        std::vector<double> numbers{0, 1, 0, 1, 0, 0, 0, -1, 0, 5, 2};
        if (spacing != 0)
            numbers.push_back(spacing);
        PatternPlace place;
        place.position = {x, y, 3};
        return folder_.pattern("brighttext", words, numbers)->at(place).g;
    }
    PatternFolder folder_;
};

TEST_F(LetteringTest, LettersStandInTheirCells)
{
    const std::vector<std::string> words{"square.fnt", ".", "O", "O"};
    EXPECT_EQ(at(words, 0.5, 0.5), 5);
    EXPECT_EQ(at(words, 0.21, 0.21), 5);
    EXPECT_EQ(at(words, 0.19, 0.5), 2);
    EXPECT_EQ(at(words, 0.5, 0.81), 2);
    EXPECT_EQ(at(words, 1.5, 0.5), 2); // the blank
    EXPECT_EQ(at(words, 2.5, 0.5), 5);
    EXPECT_EQ(at(words, 0.5, -0.5), 2);
    EXPECT_EQ(at(words, -0.5, 0.5), 2);
}

TEST_F(LetteringTest, LinesOfAFileRunDown)
{
    folder_.write("lines.txt", "O\n\nOO\n");
    const std::vector<std::string> words{"square.fnt", "lines.txt"};
    EXPECT_EQ(at(words, 0.5, 0.5), 5);
    EXPECT_EQ(at(words, 0.5, -0.5), 2);
    EXPECT_EQ(at(words, 1.5, -1.5), 5);
    EXPECT_EQ(at(words, 1.5, 0.5), 2);
}

TEST_F(LetteringTest, SpacingSetsTheGapsAndKeepsTheMeanWidth)
{
    // Outlines of 0.6 and gaps of 0.4 make cells of 1; all is scaled so that 0.6 + 0.4 takes one character.
    const std::vector<std::string> words{"square.fnt", ".", "OO"};
    EXPECT_EQ(at(words, 0.39, 0.5, -0.4), 2);
    EXPECT_EQ(at(words, 0.41, 0.5, -0.4), 5);
    EXPECT_EQ(at(words, 0.99, 0.5, -0.4), 5);
    EXPECT_EQ(at(words, 1.01, 0.5, -0.4), 2);
    EXPECT_EQ(at(words, 1.41, 0.5, -0.4), 5);
    // Half the gap: cells of 0.8 fill a character, outlines take three quarters of it.
    EXPECT_EQ(at(words, 0.24, 0.5, -0.2), 2);
    EXPECT_EQ(at(words, 0.26, 0.5, -0.2), 5);
    EXPECT_EQ(at(words, 0.99, 0.5, -0.2), 5);
}

TEST_F(LetteringTest, ColoursAndMixturesUseTheSameLetters)
{
    PatternPlace place;
    place.position = {0.5, 0.5, 0};
    const std::vector<double> frame{0, 1, 0, 1, 0, 0, 0, -1, 0};
    EXPECT_EQ(folder_.pattern("mixtext", {"square.fnt", ".", "O"}, frame)->at(place).r, 1);
    std::vector<double> colours = frame;
    colours.insert(colours.end(), {1, 2, 3, 4, 5, 6});
    EXPECT_EQ(folder_.pattern("colortext", {"square.fnt", ".", "O"}, colours)->at(place), (Spectrum{1, 2, 3}));
}

TEST_F(LetteringTest, AMissingFontIsReplacedByOurOwn)
{
    int inked = 0;
    for (double x = 0.02; x < 1; x += 0.04)
        for (double y = 0.02; y < 1; y += 0.04)
            inked += at({"nowhere.fnt", ".", "H"}, x, y) == 5 ? 1 : 0;
    EXPECT_GT(inked, 50); // of 625: strokes of a letter
    EXPECT_LT(inked, 350);
}

TEST_F(LetteringTest, DamagedFontsAreNamedWithTheirLine)
{
    const auto message = [](const std::string& text) -> std::string {
        try {
            PolygonFont::parse(text, "bad.fnt");
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    };
    EXPECT_EQ(message("65 2 1 1 2 2\n300 0"),
              "bad.fnt:2: the code of a character is \"300\", expected a whole number from 0 to 255");
    EXPECT_EQ(message("65 900000"),
              "bad.fnt:1: the number of its corners is \"900000\", expected a whole number from 0 to 32767");
    EXPECT_NE(message("65 4 1 1 2").find("y of a corner"), std::string::npos);
    EXPECT_THROW(folder_.pattern("brighttext", {"square.fnt", ".", "O"}, {0, 0, 0, 1, 0, 0, 2, 0, 0, 1, 0}),
                 InputError);
    EXPECT_THROW(folder_.pattern("brighttext", {"square.fnt", ".", "O"}, {0, 0, 0}), InputError);
}

} // namespace
} // namespace lightwell
