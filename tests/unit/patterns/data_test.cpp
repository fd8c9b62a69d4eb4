#include "engine/base/errors.h"
#include "engine/pictures/png.h"
#include "engine/pictures/rgbe.h"
#include "materials/patterns/spectral_colour.h"
#include "tests/unit/patterns/pattern_text.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

TEST(PatternData, ValuesBetweenAndBeyondTheTable)
{
    const DataTable table = DataTable::parse("# a comment\n2\n0 1 2\n0 0 3\n 1 10 100\n0 1 2\n10 11 12\n", "t.dat");
    const auto at = [&](double x, double y) {
        const double coordinates[] = {x, y};
        return table.at(coordinates);
    };
    EXPECT_DOUBLE_EQ(at(0, 1), 0);
    EXPECT_DOUBLE_EQ(at(1, 100), 12);
    EXPECT_DOUBLE_EQ(at(0, 5.5), 0.5);
    EXPECT_DOUBLE_EQ(at(0.5, 55), 6.5);
    // One step further the line goes on; then what it has reached falls off with the distance.
    EXPECT_DOUBLE_EQ(at(2, 1), 20);
    EXPECT_DOUBLE_EQ(at(3, 1), 10);
    EXPECT_DOUBLE_EQ(at(-1, 1), -10);
    EXPECT_DOUBLE_EQ(at(-2, 1), -5);
    EXPECT_EQ(at(NAN, 1), 0);
}

TEST(PatternData, FallingCoordinatesAreAllowed)
{
    const DataTable table = DataTable::parse("1 0 0 3 5 3 2 10 20 30", "t.dat");
    const double x = 4, y = 2.5;
    EXPECT_DOUBLE_EQ(table.at(&x), 15);
    EXPECT_DOUBLE_EQ(table.at(&y), 25);
    const DataTable even = DataTable::parse("1 90 0 3 1 2 3", "t.dat");
    const double z = 22.5;
    EXPECT_DOUBLE_EQ(even.at(&z), 2.5);
}

std::string message_of(const std::string& text)
{
    try {
        DataTable::parse(text, "bad.dat");
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

TEST(PatternData, DamageIsNamedWithItsLine)
{
    EXPECT_EQ(message_of(""), "bad.dat:1: the file ends before the number of dimensions; the file may be cut off");
    EXPECT_EQ(message_of("9"), "bad.dat:1: the number of dimensions is 9, expected a whole number from 1 to 8");
    EXPECT_EQ(message_of("1\n0 1 x"),
              "bad.dat:2: the number of values along a dimension is \"x\", expected a finite number");
    EXPECT_EQ(message_of("1\n0 1 2\n3 nan"), "bad.dat:3: a value is \"nan\", expected a finite number");
    EXPECT_EQ(message_of("1\n0 1 2\n3"), "bad.dat:3: the file ends before a value; the file may be cut off");
    EXPECT_EQ(message_of("1\n0 0 3\n1 2 2"), "bad.dat:3: coordinate 2 after 2: they go neither up nor down");
    EXPECT_NE(message_of("2\n0 1 100000\n0 1 100000\n1 2 3").find("more than the file holds"), std::string::npos);
    EXPECT_NE(message_of("1\n0 0 100000000\n1 2").find("the file ends before a coordinate"), std::string::npos);
}

TEST(PatternData, BrightdataAndColordataLookUpByFormula)
{
    const PatternFolder folder;
    folder.write("ramp.dat", "1\n0 10 2\n0 100\n");
    folder.write("flat.dat", "1\n0 10 2\n7 7\n");
    PatternPlace place;
    place.position = {2, 0, 0};
    EXPECT_DOUBLE_EQ(folder.pattern("brightdata", {"noneg", "ramp.dat", ".", "Px * 2"})->at(place).b, 40);
    EXPECT_DOUBLE_EQ(folder.pattern("brightdata", {"noneg", "ramp.dat", ".", "Px", "-t", "1", "0", "0"})->at(place).b,
                     10);
    folder.write("f.cal", "mix(r, g, b) = r + 10 * g + 100 * b; twice(v) = 2 * v;");
    const auto colour =
        folder.pattern("colordata", {"twice", "twice", "mix", "ramp.dat", "flat.dat", "ramp.dat", "f.cal", "Px"});
    const Spectrum found = colour->at(place);
    EXPECT_DOUBLE_EQ(found.r, 40);
    EXPECT_DOUBLE_EQ(found.g, 14);
    EXPECT_DOUBLE_EQ(found.b, 20 + 70 + 2000);
}

TEST(PatternData, PicturesAreOneUnitAlongTheirShorterSide)
{
    const PatternFolder folder;
    Picture picture{4, 2, {}, {}, {}};
    for (const char* channel : {"R", "G", "B"})
        picture.add_channel(channel);
    for (int i = 0; i < 8; ++i)
        picture.channels["R"][static_cast<std::size_t>(i)] = static_cast<float>(1 << i);
    write_rgbe(picture, folder.path("p.hdr"));
    const auto at = [&](double u, double v) {
        PatternPlace place;
        place.position = {u, v, 0};
        return folder.pattern("colorpict", {"red", "green", "blue", "p.hdr", ".", "Px", "Py"})->at(place).r;
    };
    EXPECT_NEAR(at(0.25, 0.75), 1, 0.01); // middle of the upper left pixel
    EXPECT_NEAR(at(1.75, 0.25), 128, 0.5);
    EXPECT_NEAR(at(0.5, 0.75), 1.5, 0.02);
    EXPECT_NEAR(at(0.25, 0.5), 8.5, 0.1);
}

/// Stored values are what patterns multiply by, however the picture was exposed (recorded behaviour of `colorpict`).
TEST(PatternData, TheExposureOfAPictureDoesNotChangeAPattern)
{
    const PatternFolder folder;
    Picture picture{2, 2, {}, {{"EXPOSURE", "4"}}, {}};
    for (const char* channel : {"R", "G", "B"})
        for (float& value : picture.add_channel(channel))
            value = 0.125F;
    write_rgbe(picture, folder.path("p.hdr"));
    PatternPlace place;
    place.position = {0.5, 0.5, 0};
    EXPECT_NEAR(folder.pattern("colorpict", {"red", "green", "blue", "p.hdr", ".", "Px", "Py"})->at(place).g, 0.5,
                0.01);
}

TEST(PatternData, DisplayPicturesAreDecoded)
{
    const PatternFolder folder;
    write_png({2, 2, {128, 128, 128, 255, 255, 255, 0, 0, 0, 128, 128, 128}}, folder.path("p.png"));
    PatternPlace place;
    place.position = {0.25, 0.75, 0};
    EXPECT_NEAR(folder.pattern("colorpict", {"red", "green", "blue", "p.png", ".", "Px", "Py"})->at(place).g, 0.21586,
                1e-4);
}

/// Colours recorded from another program, which calculates with 18 bands; lines of a few bands agree to what those
/// blur.
TEST(PatternData, SpectraHaveTheColoursThatWereRecorded)
{
    const PatternFolder folder;
    const struct {
        std::vector<double> numbers;
        Spectrum colour;
    } recorded[] = {{{380, 780, 1, 1, 0, 0}, {0, 0.943, 0.997}},
                    {{400, 700, 0, 1, 0, 0, 0}, {0, 0.142, 0.438}},
                    {{380, 780, 1, 0, 0, 0}, {0.0075, 0, 0.0400}}};
    for (const auto& [numbers, colour] : recorded) {
        const Spectrum found = folder.pattern("spectrum", {}, numbers)->at({});
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(found[channel], colour[channel], 0.06) << numbers.size() << ' ' << channel;
    }
}

/// A colour that the primaries cannot mix keeps its brightness and loses saturation.
TEST(PatternData, SingleWavelengthsKeepTheirBrightnessWithinThePrimaries)
{
    Spectrum all;
    for (const SpectralWeight& w : spectral_weights()) {
        const Spectrum held = within_primaries(w.weight);
        EXPECT_GE(std::min({held.r, held.g, held.b}), 0) << w.wavelength_nm;
        EXPECT_NEAR(photopic(held), std::max(photopic(w.weight), 0.0), 1e-12) << w.wavelength_nm;
        all += w.weight;
    }
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(all[channel], 1, 1e-12);
    EXPECT_EQ(within_primaries({0.2, 0.3, 0.4}), (Spectrum{0.2, 0.3, 0.4}));
    EXPECT_TRUE(within_primaries({-1, 0, 0.1}).is_black());
}

/// Two pixels of four bands from 780 to 380 nm, exposed twofold, which patterns leave as it is: one even, one red
/// alone.
std::string spectral_picture()
{
    std::string text = "#?RADIANCE\nNCOMP=4\nWAVELENGTH_SPLITS= 780 588 480 380\nFORMAT=Radiance_spectra\n"
                       "EXPOSURE=2\n\n-Y 1 +X 2\n";
    const unsigned char pixels[] = {100, 100, 100, 100, 129, 0, 200, 0, 0, 129};
    text.append(reinterpret_cast<const char*>(pixels), sizeof pixels);
    return text;
}

TEST(PatternData, PicturesOfSpectraAreReducedToTheirColours)
{
    const PatternFolder folder;
    folder.write("p.hsr", spectral_picture());
    const auto at = [&](double u) {
        PatternPlace place;
        place.position = {u, 0.5, 0};
        return folder.pattern("specpict", {"noneg", "p.hsr", ".", "Px", "Py"})->at(place);
    };
    // 100.5 / 256 * 2^(129 - 128), the same at all wavelengths.
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(at(0.5)[channel], 100.5 / 128, 2e-3);
    // 580 to 680 nm is red.
    EXPECT_GT(at(1.5).r, 1.2);
    EXPECT_GT(at(1.5).r, 3 * at(1.5).g);
    EXPECT_LT(at(1.5).b, 0.1);
}

TEST(PatternData, DamagedPicturesOfSpectraAreRefusedWithTheirByte)
{
    const PatternFolder folder;
    const std::string good = spectral_picture();
    const auto refused = [&](const std::string& bytes) -> std::string {
        folder.write("p.hsr", bytes);
        try {
            folder.pattern("specpict", {"noneg", "p.hsr", ".", "Px", "Py"});
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    };
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        return text.replace(text.find(from), from.size(), to);
    };
    EXPECT_NE(refused(good.substr(0, good.size() - 1)).find("the picture ends before its last line"),
              std::string::npos);
    EXPECT_NE(refused(with("+X 2", "+X 999999999")).find("999999999 x 1 pixels"), std::string::npos);
    EXPECT_NE(refused(with("NCOMP=4", "NCOMP=-4")).find("pixels of -4 components"), std::string::npos);
    EXPECT_NE(refused(with("-Y 1", "+Y 1")).find("no size"), std::string::npos);
    EXPECT_NE(refused(with("780 588", "0 588")).find("do not fall"), std::string::npos);
    for (std::size_t cut = 0; cut < good.size(); ++cut)
        EXPECT_NE(refused(good.substr(0, cut)), "accepted");
}

TEST(PatternData, MissingAndDamagedFilesAreNamed)
{
    const PatternFolder folder;
    const auto refused = [&](const std::string& type, const std::vector<std::string>& words) -> std::string {
        try {
            folder.pattern(type, words);
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    };
    folder.write("no.hdr", "this is no picture");
    folder.write("bad.cal", "a = 1;\nb = (;");
    EXPECT_NE(refused("brightdata", {"noneg", "no.dat", ".", "Px"}).find("a data file \"no.dat\" is not found"),
              std::string::npos);
    EXPECT_NE(refused("colorpict", {"red", "green", "blue", "no.hdr", ".", "Px", "Py"}).find("no picture of a kind"),
              std::string::npos);
    EXPECT_NE(refused("brightfunc", {"a", "bad.cal"}).find("bad.cal:2: expected a number"), std::string::npos);
    EXPECT_NE(refused("brightfunc", {"a", "none.cal"}).find("function file \"none.cal\" is not found"),
              std::string::npos);
    EXPECT_NE(refused("brightfunc", {"a"}).find("the words end before a function file"), std::string::npos);
    EXPECT_NE(refused("brightfunc", {"nothing", "."}).find("nothing is not defined"), std::string::npos);
    EXPECT_NE(refused("colorfunc", {"1 +", "2", "3", "."}).find("scene.rad:3"), std::string::npos);
}

} // namespace
} // namespace lightwell
