#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/pictures/png.h"
#include "importers/file_texture.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

TEST(FileTexture, TheMeanOfBlackAndWhitePixelsIsTakenInLinearLight)
{
    const std::filesystem::path file = std::filesystem::temp_directory_path() / "lightwell_mean.png";
    write_png({4, 1, {255, 255, 255, 0, 0, 0, 0, 0, 0, 188, 188, 188}}, file);
    FileTexture texture;
    texture.file = file;
    const PictureMeans means = picture_means(texture, "mean.png");
    std::filesystem::remove(file);
    // sRGB 188 is ((188 / 255 + 0.055) / 1.055)^2.4 = 0.502886 in linear light (IEC 61966-2-1)
    EXPECT_NEAR(means.colour.g, (1 + 0.502886) / 4, 1e-6);
    EXPECT_NEAR(means.plain.g, (255.0 + 188) / (4 * 255), 1e-12);
    EXPECT_DOUBLE_EQ(means.opacity, 1);
    EXPECT_DOUBLE_EQ(means.share_kept(0.5, 1), 1);
    EXPECT_DOUBLE_EQ(means.share_kept(0.5, 0.4), 0);
}

TEST(FileTexture, TheSliceOfAFileThatHoldsThePictureIsFound)
{
    const std::filesystem::path file = std::filesystem::temp_directory_path() / "lightwell_slice.png";
    write_png({1, 1, {255, 0, 0}}, file);
    const std::string png(MappedFile(file).bytes());
    write_text_atomically(file, "0123456789" + png + "tail");
    FileTexture texture;
    texture.file = file;
    texture.offset = 10;
    texture.length = png.size();
    EXPECT_DOUBLE_EQ(picture_means(texture, "slice").colour.r, 1);
    EXPECT_DOUBLE_EQ(picture_means(texture, "slice").colour.g, 0);
    texture.length = 1000000;
    EXPECT_THROW(picture_means(texture, "slice"), InputError);
    std::filesystem::remove(file);
    EXPECT_THROW(picture_means(texture, "slice"), InputError);
}

} // namespace
} // namespace lightwell
