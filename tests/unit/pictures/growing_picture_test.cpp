#include "engine/pictures/exr.h"
#include "tests/unit/pictures/picture_fixtures.h"

#include <csignal>
#include <cstring>
#include <sys/wait.h>
#include <thread>

namespace lightwell {

using namespace test;

namespace {

constexpr int tile_size = 32;

/// 200 x 136: edge tiles are smaller on both sides (7 x 5 tiles).
Picture whole_picture()
{
    Picture picture = noise(200, 136, {"R", "G", "B", "illuminance.Y"});
    picture.header["settings"] = "samples 64";
    return picture;
}

std::vector<std::pair<int, int>> places_in(const Picture& picture)
{
    std::vector<std::pair<int, int>> places;
    for (int y = 0; y < picture.height; y += tile_size)
        for (int x = 0; x < picture.width; x += tile_size)
            places.emplace_back(x, y);
    return places;
}

bool same_bits(const Picture& a, const Picture& b)
{
    if (a.width != b.width || a.height != b.height || a.channels.size() != b.channels.size())
        return false;
    for (const auto& [name, values] : a.channels)
        if (std::memcmp(values.data(), b.channels.at(name).data(), values.size() * sizeof(float)) != 0)
            return false;
    return true;
}

/// A child writes `count` tiles in an unordered sequence and is then killed outright, without a chance to clean up.
void write_tiles_and_die(const std::filesystem::path& file, const Picture& picture, std::size_t count)
{
    const pid_t child = fork();
    if (child == 0) {
        GrowingPicture growing(file, picture, tile_size);
        const auto places = places_in(picture);
        for (std::size_t i = 0; i < count; ++i) {
            const auto [x, y] = places[i * 17 % places.size()];
            growing.put(x, y, tile_of(picture, x, y, tile_size));
        }
        kill(getpid(), SIGKILL);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
}

} // namespace

TEST(GrowingPicture, AKilledRunLeavesEveryFinishedTileAndTheNextTakesThemOver)
{
    const Folder folder;
    const Picture picture = whole_picture();
    write_tiles_and_die(folder / "out.exr", picture, 13);
    EXPECT_FALSE(std::filesystem::exists(folder / "out.exr"));
    EXPECT_TRUE(std::filesystem::exists(folder / "out.partial.exr"));

    GrowingPicture next(folder / "out.exr", picture, tile_size);
    EXPECT_EQ(next.resumed_tiles(), 13u);
    int stored = 0;
    for (const auto& [x, y] : places_in(picture))
        if (const std::optional<Picture> tile = next.stored(x, y)) {
            EXPECT_TRUE(same_bits(*tile, tile_of(picture, x, y, tile_size)));
            ++stored;
        } else {
            next.put(x, y, tile_of(picture, x, y, tile_size));
        }
    EXPECT_EQ(stored, 13);
    next.finish(picture);
    EXPECT_TRUE(same_bits(read_exr(folder / "out.exr"), picture));
    EXPECT_EQ(folder.file_count(), 1u) << "the partial file is gone";
}

TEST(GrowingPicture, ThreeKillsInARowLoseNothing)
{
    const Folder folder;
    const Picture picture = whole_picture();
    for (const std::size_t count : {5u, 9u, 20u}) { // each child repeats what is there and goes further
        write_tiles_and_die(folder / "out.exr", picture, count);
        EXPECT_EQ(GrowingPicture(folder / "out.exr", picture, tile_size).resumed_tiles(), count);
    }
}

TEST(GrowingPicture, ATornTileIsComputedAgainAndTheOthersAreKept)
{
    const Folder folder;
    const Picture picture = whole_picture();
    write_tiles_and_die(folder / "out.exr", picture, 10);
    const std::string bytes = bytes_of(folder / "out.partial.exr");
    write_bytes(folder / "out.partial.exr", bytes.substr(0, bytes.size() - 100));
    EXPECT_EQ(GrowingPicture(folder / "out.exr", picture, tile_size).resumed_tiles(), 9u);
}

TEST(GrowingPicture, APartOfALargerPictureGoesOnOnlyAsTheSamePart)
{
    const Folder folder;
    Picture picture = whole_picture();
    picture.place = {13, 40, 500, 300};
    write_tiles_and_die(folder / "out.exr", picture, 9);
    Picture other = picture;
    other.place.x = 14;
    GrowingPicture next(folder / "out.exr", picture, tile_size);
    EXPECT_EQ(next.resumed_tiles(), 9u);
    for (const auto& [x, y] : places_in(picture)) {
        const std::optional<Picture> tile = next.stored(x, y);
        EXPECT_TRUE(!tile || same_bits(*tile, tile_of(picture, x, y, tile_size)));
    }
    next.finish(picture);
    EXPECT_TRUE(same_bits(read_exr(folder / "out.exr"), picture));
    EXPECT_EQ(read_exr(folder / "out.exr").place, picture.place);
    write_tiles_and_die(folder / "out.exr", picture, 9);
    EXPECT_EQ(GrowingPicture(folder / "out.exr", other, tile_size).resumed_tiles(), 0u);
}

TEST(GrowingPicture, APartAsLargeAsTheWholeGoesOn)
{
    const Folder folder;
    Picture picture = whole_picture();
    picture.place = {0, 0, picture.width, picture.height};
    write_tiles_and_die(folder / "out.exr", picture, 9);
    EXPECT_EQ(GrowingPicture(folder / "out.exr", picture, tile_size).resumed_tiles(), 9u);
}

TEST(GrowingPicture, TheFinalFileDoesNotDependOnHowItGrew)
{
    const Folder folder;
    const Picture picture = whole_picture();
    write_tiles_and_die(folder / "resumed.exr", picture, 20);
    GrowingPicture(folder / "resumed.exr", picture, tile_size).finish(picture);
    GrowingPicture(folder / "straight.exr", picture, tile_size).finish(picture);
    write_exr(picture, folder / "plain.exr");
    EXPECT_EQ(bytes_of(folder / "resumed.exr"), bytes_of(folder / "straight.exr"));
    EXPECT_EQ(bytes_of(folder / "resumed.exr"), bytes_of(folder / "plain.exr"));
}

TEST(GrowingPicture, OtherSettingsSizeChannelsOrTilesBeginAnew)
{
    const Picture picture = whole_picture();
    Picture other_settings = picture, other_size = noise(201, 136, {"R", "G", "B", "illuminance.Y"}),
            other_channels = picture;
    other_settings.header["settings"] = "samples 65";
    other_size.header = picture.header;
    other_channels.channels.erase("B");
    for (const Picture* changed : {&other_settings, &other_size, &other_channels}) {
        const Folder folder;
        write_tiles_and_die(folder / "out.exr", picture, 8);
        EXPECT_EQ(GrowingPicture(folder / "out.exr", *changed, tile_size).resumed_tiles(), 0u);
    }
    const Folder folder;
    write_tiles_and_die(folder / "out.exr", picture, 8);
    EXPECT_EQ(GrowingPicture(folder / "out.exr", picture, tile_size / 2).resumed_tiles(), 0u);
    write_bytes(folder / "out.partial.exr", "not a picture at all");
    EXPECT_EQ(GrowingPicture(folder / "out.exr", picture, tile_size).resumed_tiles(), 0u);
}

TEST(GrowingPicture, DamageInThePartialFileNeverCrashes)
{
    const Folder folder;
    const Picture picture = whole_picture();
    write_tiles_and_die(folder / "out.exr", picture, 12);
    const std::string bytes = bytes_of(folder / "out.partial.exr");
    RandomStream random(3);
    for (int round = 0; round < 200; ++round) {
        std::string changed = bytes;
        changed[random.bits() % bytes.size()] ^= static_cast<char>(1 + random.bits() % 255);
        write_bytes(folder / "out.partial.exr", changed);
        const GrowingPicture growing(folder / "out.exr", picture, tile_size);
        EXPECT_LE(growing.resumed_tiles(), 12u);
    }
}

TEST(GrowingPicture, ThreadsMayPutTilesAtOnce)
{
    const Folder folder;
    const Picture picture = whole_picture();
    {
        GrowingPicture growing(folder / "out.exr", picture, tile_size);
        std::vector<std::thread> threads;
        for (std::size_t t = 0; t < 4; ++t)
            threads.emplace_back([&, t] {
                const auto places = places_in(picture);
                for (std::size_t i = t; i < places.size(); i += 4)
                    growing.put(places[i].first, places[i].second,
                                tile_of(picture, places[i].first, places[i].second, tile_size));
            });
        for (std::thread& thread : threads)
            thread.join();
    }
    EXPECT_TRUE(same_bits(read_exr(folder / "out.partial.exr"), picture)) << "a complete partial file is a picture";
}

TEST(GrowingPicture, WrongTilesAreRefused)
{
    const Folder folder;
    const Picture picture = whole_picture();
    GrowingPicture growing(folder / "out.exr", picture, tile_size);
    const Picture tile = tile_of(picture, 0, 0, tile_size);
    EXPECT_NE(error_of([&] { growing.put(16, 0, tile); }).find("is not a place where a tile"), std::string::npos);
    EXPECT_NE(error_of([&] { growing.put(224, 0, tile); }).find("is not a place where a tile"), std::string::npos);
    EXPECT_NE(error_of([&] { growing.put(192, 0, tile); }).find("is 32 x 32 pixels, expected 8 x 32"),
              std::string::npos);
    Picture without = tile;
    without.channels.erase("G");
    EXPECT_NE(error_of([&] { growing.put(0, 0, without); }).find("has no channel \"G\""), std::string::npos);
    EXPECT_NE(error_of([&] {
                  GrowingPicture(folder / "empty.exr", Picture{8, 8, {}, {}}, tile_size);
              }).find("has no channel"),
              std::string::npos);
    growing.finish(picture);
    EXPECT_NE(error_of([&] { growing.put(0, 0, tile); }).find("already finished"), std::string::npos);
    EXPECT_NE(
        error_of([&] { GrowingPicture(folder / "no folder/out.exr", picture, tile_size); }).find("does not exist"),
        std::string::npos);
    EXPECT_NE(error_of([&] { GrowingPicture(folder / "out.exr", picture, 0); }).find("tile size is 0"),
              std::string::npos);
}

} // namespace lightwell
