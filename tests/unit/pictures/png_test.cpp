#include "engine/pictures/png.h"
#include "tests/unit/pictures/picture_fixtures.h"

namespace lightwell {

using namespace test;

namespace {

DisplayPicture any_picture(int width, int height)
{
    DisplayPicture picture{width, height, {}};
    RandomStream random(2);
    for (int i = 0; i < 3 * width * height; ++i)
        picture.rgb.push_back(static_cast<std::uint8_t>(random.bits()));
    return picture;
}

} // namespace

TEST(Png, EveryByteComesBackAndFilesAreTheSameEachTime)
{
    const Folder folder;
    const DisplayPicture picture = any_picture(61, 35);
    write_png(picture, folder / "a.png");
    write_png(picture, folder / "b.png");
    const DisplayPicture back = read_png(folder / "a.png");
    EXPECT_EQ(back.width, 61);
    EXPECT_EQ(back.height, 35);
    EXPECT_EQ(back.rgb, picture.rgb);
    EXPECT_EQ(bytes_of(folder / "a.png"), bytes_of(folder / "b.png"));
    EXPECT_NE(bytes_of(folder / "a.png").find("sRGB"), std::string::npos);
}

TEST(Png, TruncatedChangedAndAbsurdFilesAreRefused)
{
    const Folder folder;
    write_png(any_picture(20, 20), folder / "p.png");
    const std::string whole = bytes_of(folder / "p.png");
    for (std::size_t length = 0; length < whole.size() - 12; length += 11) { // the last 12 bytes only mark the end
        write_bytes(folder / "cut.png", whole.substr(0, length));
        EXPECT_NE(error_of([&] { read_png(folder / "cut.png"); }), "") << length;
    }
    RandomStream random(4);
    for (int round = 0; round < 1000; ++round) {
        std::string changed = whole;
        changed[random.bits() % whole.size()] = static_cast<char>(random.bits());
        write_bytes(folder / "changed.png", changed);
        try {
            EXPECT_EQ(read_png(folder / "changed.png").rgb.size() % 3, 0u);
        } catch (const InputError&) {
            continue;
        }
    }
}

TEST(Png, WhatCannotBeWrittenIsRefused)
{
    const Folder folder;
    EXPECT_NE(error_of([&] {
                  write_png({2, 2, {1, 2, 3}}, folder / "p.png");
              }).find("has 3 bytes, expected 12"),
              std::string::npos);
    EXPECT_NE(error_of([&] { write_png({0, 2, {}}, folder / "p.png"); }).find("0 x 2"), std::string::npos);
    EXPECT_NE(error_of([&] {
                  write_png({1, 1, {1, 2, 3}}, folder / "none/p.png");
              }).find("does not exist"),
              std::string::npos);
    EXPECT_EQ(folder.file_count(), 0u);
}

} // namespace lightwell
