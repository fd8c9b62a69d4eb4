#include "engine/base/errors.h"
#include "engine/pictures/image_file.h"
#include "engine/pictures/png.h"
#include "tests/unit/pictures/picture_fixtures.h"

namespace lightwell {

using namespace test;

namespace {

const std::filesystem::path two_halves = LIGHTWELL_ROOT "/tests/fixtures/pictures/two_halves.jpg";

} // namespace

TEST(ImageFile, APngGivesTheBytesThatWereWrittenAndIsOpaque)
{
    const Folder folder;
    const DisplayPicture picture{2, 1, {255, 128, 7, 0, 1, 2}};
    write_png(picture, folder / "a.png");
    const ImageFile image = read_image(bytes_of(folder / "a.png"), "a.png");
    EXPECT_EQ(image.width, 2);
    EXPECT_EQ(image.height, 1);
    EXPECT_EQ(image.rgba, (std::vector<std::uint8_t>{255, 128, 7, 255, 0, 1, 2, 255}));
}

TEST(ImageFile, AJpegOfTwoColoursHasThemInItsHalves)
{
    const ImageFile image = read_image(bytes_of(two_halves), "two_halves.jpg");
    ASSERT_EQ(image.width, 32);
    ASSERT_EQ(image.height, 16);
    ASSERT_EQ(image.rgba.size(), 4u * 32 * 16);
    for (std::size_t i = 0; i < 32 * 16; ++i) {
        const bool left = i % 32 < 16;
        EXPECT_NEAR(image.rgba[4 * i], left ? 200 : 50, 2);
        EXPECT_NEAR(image.rgba[4 * i + 1], 50, 2);
        EXPECT_NEAR(image.rgba[4 * i + 2], left ? 50 : 200, 2);
        EXPECT_EQ(image.rgba[4 * i + 3], 255);
    }
}

TEST(ImageFile, DamagedJpegsAreReadOrRefusedButNeverCrash)
{
    const std::string whole = bytes_of(two_halves);
    std::size_t read = 0, refused = 0;
    for (std::size_t at = 0; at < whole.size(); ++at) {
        std::string changed = whole;
        changed[at] = static_cast<char>(changed[at] ^ 0xff);
        for (const std::string& bytes : {changed, whole.substr(0, at)}) {
            try {
                const ImageFile image = read_image(bytes, "x.jpg");
                EXPECT_EQ(image.rgba.size(), 4 * static_cast<std::size_t>(image.width * image.height));
                ++read;
            } catch (const InputError&) {
                ++refused;
            }
        }
    }
    EXPECT_GT(read, 0u);
    EXPECT_GT(refused, 100u);
}

TEST(ImageFile, AnotherFormatIsNamedAsSuch)
{
    try {
        read_image("GIF89a", "wall.gif");
        FAIL() << "expected an error";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("wall.gif: is neither PNG nor JPEG"), std::string::npos);
    }
}

} // namespace lightwell
