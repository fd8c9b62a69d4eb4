#include "engine/pictures/rgbe.h"
#include "tests/unit/pictures/picture_fixtures.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace lightwell {

using namespace test;

namespace {

using Bytes = std::array<std::uint8_t, 4>;

std::filesystem::path fixtures()
{
    return shared_folder() / "fixtures" / "hdr";
}

const std::string format_lines = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";

/// Six different pixels, as bytes, in the order a b c d e f.
std::string six_pixels()
{
    std::string bytes;
    for (int i = 0; i < 6; ++i)
        bytes += {static_cast<char>(10 * i + 128), 20, 30, static_cast<char>(129)};
    return bytes;
}

Picture read_text(const Folder& folder, const std::string& bytes)
{
    write_bytes(folder / "p.hdr", bytes);
    return read_rgbe(folder / "p.hdr");
}

Picture radiances(int width, int height, std::uint64_t seed)
{
    Picture picture{width, height, {}, {}};
    RandomStream random(seed);
    for (const char* name : {"R", "G", "B"})
        for (float& value : picture.add_channel(name))
            value = static_cast<float>(std::pow(10.0, 12 * random.next() - 6));
    return picture;
}

} // namespace

/// Bytes and values worked out by hand from Ward 1991, "Real Pixels".
TEST(Rgbe, EncodesAndDecodesTheKnownCases)
{
    struct Case {
        std::array<float, 3> radiance;
        Bytes bytes;
        std::array<float, 3> decoded;
    };
    const std::array cases{
        Case{{1, 1, 1}, {128, 128, 128, 129}, {1.00390625f, 1.00390625f, 1.00390625f}},
        Case{{0.5f, 0.25f, 0.125f}, {128, 64, 32, 128}, {0.501953125f, 0.251953125f, 0.126953125f}},
        Case{{0.001f, 0.002f, 0.003f}, {65, 131, 196, 120}, {0.0009994506836f, 0.002006530762f, 0.002998352051f}},
        Case{{100000, 10, 0.001f}, {195, 0, 0, 145}, {100096, 256, 256}},
        Case{{0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0}},
        Case{{1e-33f, 0, 0}, {0, 0, 0, 0}, {0, 0, 0}},
        Case{{179, 0.1f, 33}, {179, 0, 33, 136}, {179.5f, 0.5f, 33.5f}},
    };
    for (const Case& c : cases) {
        EXPECT_EQ(encode_rgbe(c.radiance[0], c.radiance[1], c.radiance[2]), c.bytes);
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_FLOAT_EQ(decode_rgbe(c.bytes)[i], c.decoded[i]);
    }
}

TEST(Rgbe, TheSharedListOfTechniquesAgrees)
{
    std::ifstream list(shared_folder() / "validation" / "techniques.json");
    if (!list)
        GTEST_SKIP() << "the list of techniques is not here";
    const nlohmann::json root = nlohmann::json::parse(list);
    int compared = 0;
    for (const nlohmann::json& technique : root.is_array()                   ? root
                                           : root.begin().value().is_array() ? root.begin().value()
                                                                             : root["entries"]) {
        if (technique.value("id", "") != "ext_rgbe")
            continue;
        for (const auto& [text, expected] : technique["expected"].items()) {
            std::array<float, 3> radiance{};
            ASSERT_EQ(std::sscanf(text.c_str(), "%f,%f,%f", &radiance[0], &radiance[1], &radiance[2]), 3);
            EXPECT_EQ(encode_rgbe(radiance[0], radiance[1], radiance[2]), expected["bytes"].get<Bytes>()) << text;
            for (std::size_t i = 0; i < 3; ++i)
                EXPECT_FLOAT_EQ(decode_rgbe(expected["bytes"].get<Bytes>())[i], expected["decoded"][i].get<float>())
                    << text;
            ++compared;
        }
    }
    EXPECT_GE(compared, 8);
}

TEST(Rgbe, WhatIsNotAFiniteRadianceBecomesTheNearestThatIs)
{
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), huge = std::numeric_limits<float>::infinity();
    EXPECT_EQ(encode_rgbe(nan, nan, nan), (Bytes{0, 0, 0, 0}));
    EXPECT_EQ(encode_rgbe(-1, -2, -3), (Bytes{0, 0, 0, 0}));
    EXPECT_EQ(encode_rgbe(nan, 1, -5), (Bytes{0, 128, 0, 129}));
    EXPECT_EQ(encode_rgbe(huge, 1, 0), (Bytes{255, 0, 0, 255}));
    EXPECT_EQ(encode_rgbe(std::numeric_limits<float>::max(), 0, 0), (Bytes{255, 0, 0, 255}));
}

TEST(Rgbe, TheErrorIsBelowOne256thOfTheBrightestChannel)
{
    RandomStream random(5);
    for (int i = 0; i < 20000; ++i) {
        const double scale = std::pow(10.0, 30 * random.next() - 20);
        const std::array<float, 3> c{static_cast<float>(scale * random.next()),
                                     static_cast<float>(scale * random.next()), static_cast<float>(scale)};
        const Bytes bytes = encode_rgbe(c[0], c[1], c[2]);
        const std::array<float, 3> back = decode_rgbe(bytes);
        for (std::size_t k = 0; k < 3; ++k)
            ASSERT_LE(std::fabs(back[k] - c[k]), c[2] / 256 * 1.000001f);
        ASSERT_EQ(encode_rgbe(back[0], back[1], back[2]), bytes) << "decoded values encode to the same bytes";
    }
}

TEST(Rgbe, PicturesOfEveryWidthComeBackAsEncoded)
{
    const Folder folder;
    for (const int width : {1, 7, 8, 127, 128, 129, 300, 32767, 32768}) {
        Picture picture = radiances(width, 3, 11);
        std::vector<float>& red = picture.channels["R"]; // a long run beside noise
        for (std::size_t i = 0; i < red.size() / 2; ++i)
            for (const char* name : {"R", "G", "B"})
                picture.channels[name][i] = 2;
        write_rgbe(picture, folder / "p.hdr");
        const Picture back = read_rgbe(folder / "p.hdr");
        ASSERT_EQ(back.width, width);
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < width; ++x) {
                const std::array<float, 3> expected =
                    decode_rgbe(encode_rgbe(picture.at("R", x, y), picture.at("G", x, y), picture.at("B", x, y)));
                ASSERT_EQ(back.at("R", x, y), expected[0]) << width << ": " << x << ", " << y;
                ASSERT_EQ(back.at("G", x, y), expected[1]);
                ASSERT_EQ(back.at("B", x, y), expected[2]);
            }
    }
}

TEST(Rgbe, EvenPicturesArePacked)
{
    const Folder folder;
    Picture picture{1000, 100, {}, {}};
    for (const char* name : {"R", "G", "B"})
        picture.add_channel(name).assign(100000, 1.0f);
    write_rgbe(picture, folder / "p.hdr");
    // 8 runs of up to 127 pixels in each of 4 components, 2 bytes a run, after 4 bytes: 68 bytes a line.
    EXPECT_LE(std::filesystem::file_size(folder / "p.hdr"), 100u * 68 + 100);
}

TEST(Rgbe, AllEightOrientationsAreTurnedUpright)
{
    // The upright picture is  a b c / d e f  (3 wide, 2 high). Where each file order puts the pixels:
    const std::map<std::string, std::string> expected{
        {"-Y 2 +X 3", "abcdef"}, {"-Y 2 -X 3", "cbafed"}, {"+Y 2 +X 3", "defabc"}, {"+Y 2 -X 3", "fedcba"},
        {"+X 3 -Y 2", "acebdf"}, {"-X 3 -Y 2", "ecafdb"}, {"+X 3 +Y 2", "bdface"}, {"-X 3 +Y 2", "fdbeca"}};
    const Folder folder;
    for (const auto& [resolution, upright] : expected) {
        SCOPED_TRACE(resolution);
        const Picture picture = read_text(folder, format_lines + resolution + "\n" + six_pixels());
        ASSERT_EQ(picture.width, 3);
        ASSERT_EQ(picture.height, 2);
        std::string found;
        for (const float value : picture.channels.at("R"))
            found += static_cast<char>('a' + std::lround((value * 128 - 128.5f) / 10));
        EXPECT_EQ(found, upright);
    }
}

TEST(Rgbe, OldRunsRepeatThePixelBefore)
{
    const Folder folder;
    std::string pixels{char(128), char(128), char(128), char(129)};
    pixels += {1, 1, 1, 4, 1, 1, 1, 1}; // 4 + 256 more
    pixels += {char(200), char(200), char(200), char(129), 1, 1, 1, 2};
    const Picture picture = read_text(folder, format_lines + "-Y 1 +X 264\n" + pixels);
    for (int x = 0; x < 264; ++x)
        EXPECT_EQ(picture.at("R", x, 0), x < 261 ? 1.00390625f : 200.5f / 128) << x;
}

TEST(Rgbe, ForeignPicturesHaveTheValuesOfAnIndependentReader)
{
    std::ifstream manifest(fixtures() / "MANIFEST.json");
    if (!manifest)
        GTEST_SKIP() << "the collection of foreign pictures is not here";
    int compared = 0;
    const nlohmann::json list = nlohmann::json::parse(manifest);
    for (const nlohmann::json& entry : list["entries"]) {
        const std::string name = entry["file"];
        const nlohmann::json& truth = entry["ground_truth"];
        SCOPED_TRACE(name);
        if (truth.contains("error")) {
            EXPECT_NE(error_of([&] { read_rgbe(fixtures() / name); }).find("resolution line"), std::string::npos);
            continue;
        }
        const Picture picture = read_rgbe(fixtures() / name);
        const auto stated = picture.header.find("EXPOSURE");
        const double exposure = stated == picture.header.end() ? 1 : std::stod(stated->second);
        for (std::size_t c = 0; c < 3; ++c) {
            const std::vector<float>& values = picture.channels.at(std::array{"R", "G", "B"}[c]);
            ASSERT_EQ(values.size(), truth["pixels"].get<std::size_t>());
            double sum = 0;
            for (const float value : values)
                sum += static_cast<double>(value) * exposure;
            const double mean = truth["mean"][c];
            EXPECT_NEAR(sum / static_cast<double>(values.size()), mean, 1e-5 * mean + 1e-9);
            EXPECT_NEAR(static_cast<double>(*std::max_element(values.begin(), values.end())) * exposure,
                        truth["max"][c].get<double>(), 1e-5 * truth["max"][c].get<double>());
            ++compared;
        }
    }
    EXPECT_EQ(compared, 36 - 3);
}

TEST(Rgbe, ForeignPicturesKeepTheirPixelsAndHeaderLinesWhenWrittenAgain)
{
    if (!std::filesystem::exists(fixtures()))
        GTEST_SKIP() << "the collection of foreign pictures is not here";
    const Folder folder;
    for (const char* name :
         {"pinterp.hdr", "podlife.pic", "Earth.pic", "v_gradient.hdr", "ref_sky_suns.hdr", "rgb.hdr"}) {
        SCOPED_TRACE(name);
        const Picture picture = read_rgbe(fixtures() / name);
        write_rgbe(picture, folder / "again.hdr");
        const Picture again = read_rgbe(folder / "again.hdr");
        EXPECT_EQ(again.header, picture.header);
        EXPECT_EQ(again.channels, picture.channels);
        write_rgbe(again, folder / "third.hdr");
        EXPECT_EQ(bytes_of(folder / "third.hdr"), bytes_of(folder / "again.hdr"));
    }
}

TEST(Rgbe, ExposuresMultiplyAndAreDividedOut)
{
    const Folder folder;
    const std::string pixel{char(128), char(128), char(128), char(129)};
    const Picture picture =
        read_text(folder, "#?RADIANCE\nrpict -vp 0 0 0 scene.oct\nVIEW= -vtv -vp 0 0 0\n\tEXPOSURE=100\n"
                          "EXPOSURE=4\nEXPOSURE= 0.5\nCOLORCORR= 1 2 4\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n" +
                              pixel);
    EXPECT_FLOAT_EQ(picture.at("R", 0, 0), 1.00390625f / 2) << "4 * 0.5; the indented line belongs to an ancestor";
    EXPECT_FLOAT_EQ(picture.at("G", 0, 0), 1.00390625f / 4);
    EXPECT_FLOAT_EQ(picture.at("B", 0, 0), 1.00390625f / 8);
    EXPECT_EQ(picture.header.at("EXPOSURE"), "2");
    EXPECT_EQ(picture.header.at("VIEW"), "-vtv -vp 0 0 0");
    EXPECT_EQ(picture.header.at("history"),
              "rpict -vp 0 0 0 scene.oct\nVIEW= -vtv -vp 0 0 0\n\tEXPOSURE=100\nEXPOSURE=4\n"
              "EXPOSURE= 0.5\nCOLORCORR= 1 2 4");
    write_rgbe(picture, folder / "again.hdr");
    EXPECT_EQ(bytes_of(folder / "again.hdr"), bytes_of(folder / "p.hdr")) << "the same bytes, every line in its place";
}

TEST(Rgbe, AnotherExposureIsStatedByOneMoreLine)
{
    const Folder folder;
    Picture picture = radiances(9, 2, 3);
    picture.header = {{"history", "rpict scene.oct\nEXPOSURE=4"},
                      {"EXPOSURE", "0.5"},
                      {"SOFTWARE", "Lightwell"},
                      {"settings", "a\nb"}};
    write_rgbe(picture, folder / "p.hdr");
    const std::string bytes = bytes_of(folder / "p.hdr");
    EXPECT_EQ(bytes.substr(0, bytes.find("\n\n")),
              "#?RADIANCE\nrpict scene.oct\nEXPOSURE=4\nSOFTWARE= Lightwell\nsettings= a b\n"
              "EXPOSURE= 0.125\nFORMAT=32-bit_rle_rgbe");
    const Picture back = read_rgbe(folder / "p.hdr");
    EXPECT_EQ(back.header.at("EXPOSURE"), "0.5");
    const auto brightest = [](const Picture& p) {
        return std::max({p.at("R", 3, 1), p.at("G", 3, 1), p.at("B", 3, 1)});
    };
    EXPECT_NEAR(brightest(back) / brightest(picture), 1, 1.0 / 256 + 1e-6) << "absolute radiance comes back";
}

TEST(Rgbe, BadFilesAreRefusedByName)
{
    const Folder folder;
    const auto refusal = [&](const std::string& bytes) { return error_of([&] { read_text(folder, bytes); }); };
    const auto says = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
    EXPECT_TRUE(says(refusal(""), "is not a Radiance picture"));
    EXPECT_TRUE(says(refusal("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n"), "is not a Radiance picture"));
    EXPECT_TRUE(says(refusal(format_lines), "resolution line is \"\""));
    EXPECT_TRUE(says(refusal(format_lines + "-Y 4 +Y 5\n"), "resolution line is \"-Y 4 +Y 5\""));
    EXPECT_TRUE(says(refusal(format_lines + "-Y -4 +X 5\n"), "resolution line"));
    EXPECT_TRUE(says(refusal(format_lines + "-Y 100000 +X 100000\n"), "size is 100000 x 100000 pixels"));
    EXPECT_TRUE(says(refusal(format_lines + "-Y 1 +X 268435456\n"), "cannot hold"));
    EXPECT_TRUE(says(refusal(format_lines + "-Y 99999999999999999999 +X 1\n"), "resolution line"));
    EXPECT_TRUE(says(refusal("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\nabcd"), "format is 32-bit_rle_xyze"));
    EXPECT_TRUE(says(refusal("#?RADIANCE\nEXPOSURE=0\n\n-Y 1 +X 1\nabcd"), "EXPOSURE=0"));
    EXPECT_TRUE(says(refusal("#?RADIANCE\nEXPOSURE=bright\n\n-Y 1 +X 1\nabcd"), "EXPOSURE=bright"));
    EXPECT_TRUE(says(refusal("#?RADIANCE\nCOLORCORR=1 2\n\n-Y 1 +X 1\nabcd"), "COLORCORR=1 2"));
    EXPECT_TRUE(says(refusal(format_lines + "-Y 1 +X 2\nabcdabc"), "ends in the pixels of scan line 0"));
    EXPECT_TRUE(says(refusal(format_lines + "-Y 1 +X 2\n\1\1\1\1"), "a run passes the end"));
    EXPECT_TRUE(says(refusal(format_lines + std::string("-Y 1 +X 8\n\2\2\0\11", 14)), "claims 9 pixels, expected 8"));
    EXPECT_TRUE(says(refusal(format_lines + std::string("-Y 1 +X 8\n\2\2\0\10\0", 15)), "a run passes the end"))
        << "empty run";
    EXPECT_TRUE(says(refusal(format_lines + std::string("-Y 1 +X 8\n\2\2\0\10\x89\1", 16)), "a run passes the end"));
}

TEST(Rgbe, TruncatedAndChangedFilesNeverCrash)
{
    const Folder folder;
    Picture picture = radiances(40, 20, 3);
    picture.header["VIEW"] = "-vtv";
    write_rgbe(picture, folder / "whole.hdr");
    const std::string whole = bytes_of(folder / "whole.hdr");
    for (std::size_t length = 0; length < whole.size(); length += 7)
        EXPECT_NE(error_of([&] { read_text(folder, whole.substr(0, length)); }), "");
    RandomStream random(9);
    int refused = 0;
    for (int round = 0; round < 1000; ++round) {
        std::string changed = whole;
        changed[random.bits() % (round % 2 == 0 ? whole.size() : 100)] = static_cast<char>(random.bits());
        try {
            read_text(folder, changed);
        } catch (const InputError&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 100);
}

TEST(Rgbe, APictureWithoutColourIsRefused)
{
    const Folder folder;
    EXPECT_NE(error_of([&] {
                  write_rgbe(noise(4, 4, {"R", "G", "Z"}), folder / "p.hdr");
              }).find("no channel B"),
              std::string::npos);
    EXPECT_EQ(folder.file_count(), 0u);
}

} // namespace lightwell
