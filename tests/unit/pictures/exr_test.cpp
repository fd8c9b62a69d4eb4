#include "engine/pictures/exr.h"
#include "tests/unit/pictures/picture_fixtures.h"

#include <bit>
#include <cmath>
#include <csignal>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <sys/wait.h>

namespace lightwell {

using namespace test;

namespace {

std::filesystem::path fixtures()
{
    return shared_folder() / "fixtures" / "exr";
}

/// Reads, or is refused with an InputError; anything else is a failure.
bool reads_or_refuses(const std::filesystem::path& file)
{
    try {
        read_exr(file);
        return true;
    } catch (const InputError&) {
        return false;
    }
}

std::string little_endian(std::uint32_t number)
{
    std::string bytes(4, '\0');
    std::memcpy(bytes.data(), &number, 4);
    return bytes;
}

/// Puts other bytes over the value of an attribute of a written file.
std::string with_attribute(std::string bytes, const std::string& name_and_type, std::size_t offset,
                           const std::string& value)
{
    const std::size_t at = bytes.find(name_and_type);
    EXPECT_NE(at, std::string::npos);
    return bytes.replace(at + name_and_type.size() + 4 + offset, value.size(), value);
}

const std::string data_window("dataWindow\0box2i\0", 17);
const std::string tile_description("tiles\0tiledesc\0", 15);

} // namespace

TEST(Exr, EveryBitOfEveryChannelAndEveryHeaderEntrySurvives)
{
    const Folder folder;
    Picture picture = noise(131, 67, {"R", "G", "B", "Z", "N.X", "N.Y", "N.Z", "illuminance.Y", "error.Y", "odd name"});
    std::vector<float>& z = picture.channels["Z"];
    z[0] = std::numeric_limits<float>::quiet_NaN();
    z[1] = std::numeric_limits<float>::infinity();
    z[2] = -0.0f;
    z[3] = std::numeric_limits<float>::denorm_min();
    z[4] = std::numeric_limits<float>::max();
    picture.header = {{"VIEW", "-vtv -vp 1 2 3"},
                      {"settings", "{\"samples\": 64}\nline two"},
                      {"software", "Lightwell \xc3\xa4"},
                      {"empty", ""},
                      {"a name that is longer than the thirty-one bytes of old files", "x"}};
    write_exr(picture, folder / "p.exr");
    const Picture back = read_exr(folder / "p.exr");
    ASSERT_EQ(back.width, 131);
    ASSERT_EQ(back.height, 67);
    ASSERT_EQ(back.channels.size(), picture.channels.size());
    for (const auto& [name, values] : picture.channels)
        EXPECT_EQ(std::memcmp(values.data(), back.channels.at(name).data(), values.size() * sizeof(float)), 0) << name;
    for (const auto& [name, text] : picture.header)
        EXPECT_EQ(back.header.at(name), text);
    EXPECT_EQ(back.header.at("units.R"), "W/(m^2 sr)");
    EXPECT_EQ(back.header.at("units.illuminance.Y"), "lx");
    EXPECT_EQ(back.header.at("units.Z"), "m");
    EXPECT_FALSE(back.header.contains("units.odd name"));
    EXPECT_FALSE(back.header.contains("chromaticities")) << "only said when they are not the engine's";
}

TEST(Exr, TheFileStatesPrimariesWhiteAndIsTiled)
{
    const Folder folder;
    write_exr(noise(5, 4, {"R", "G", "B"}), folder / "p.exr");
    const std::string bytes = bytes_of(folder / "p.exr");
    const auto float_at = [&](const std::string& name, std::size_t index) {
        const std::size_t at = bytes.find(name);
        EXPECT_NE(at, std::string::npos) << name;
        float value = 0;
        std::memcpy(&value, bytes.data() + at + name.size() + 4 + 4 * index, 4);
        return value;
    };
    const std::string primaries("chromaticities\0chromaticities\0", 30), white("whiteLuminance\0float\0", 21);
    const std::array expected{0.64f, 0.33f, 0.29f, 0.60f, 0.15f, 0.06f, 1.0f / 3, 1.0f / 3};
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_EQ(float_at(primaries, i), expected[i]);
    EXPECT_EQ(float_at(white, 0), 179.0f);
    EXPECT_EQ(static_cast<unsigned char>(bytes[5]) & 2, 2) << "flag 0x200: tiled";
}

TEST(Exr, IdenticalPicturesGiveIdenticalFiles)
{
    const Folder folder;
    Picture picture = noise(200, 150, {"R", "G", "B", "Z"});
    picture.header["VIEW"] = "-vtv";
    write_exr(picture, folder / "first.exr");
    sleep(1); // a time in the file would show
    write_exr(picture, folder / "second.exr");
    EXPECT_EQ(bytes_of(folder / "first.exr"), bytes_of(folder / "second.exr"));
    EXPECT_EQ(folder.file_count(), 2u);
    write_exr(read_exr(folder / "first.exr"), folder / "third.exr");
    EXPECT_EQ(bytes_of(folder / "first.exr"), bytes_of(folder / "third.exr")) << "what was read writes the same file";
}

TEST(Exr, ForeignPrimariesAreNamedAndWrittenAgain)
{
    const std::filesystem::path carrots = fixtures() / "ScanLines_Carrots.exr";
    if (!std::filesystem::exists(carrots))
        GTEST_SKIP() << "the collection of foreign pictures is not here";
    const Folder folder;
    const Picture picture = read_exr(carrots);
    EXPECT_EQ(picture.header.at("chromaticities").substr(0, 7), "0.73470") << picture.header.at("chromaticities");
    write_exr(picture, folder / "again.exr");
    EXPECT_EQ(read_exr(folder / "again.exr").header.at("chromaticities"), picture.header.at("chromaticities"));
    EXPECT_EQ(read_exr(folder / "again.exr").header.at("whiteLuminance"), picture.header.at("whiteLuminance"));
}

TEST(Exr, ForeignPicturesHaveTheSizesChannelsAndMeansOfAnIndependentReader)
{
    std::ifstream manifest(fixtures() / "MANIFEST.json");
    if (!manifest)
        GTEST_SKIP() << "the collection of foreign pictures is not here";
    int compared = 0;
    const nlohmann::json list = nlohmann::json::parse(manifest);
    for (const nlohmann::json& entry : list["entries"]) {
        const std::string name = entry["file"];
        const nlohmann::json& truth = entry["ground_truth"];
        // One has its chroma at half resolution, which is refused; one was cut off after its first tile.
        if (name.starts_with("damaged") || truth.contains("error") || name.find("YC") != std::string::npos ||
            name == "openexr-test/tiled.exr")
            continue;
        SCOPED_TRACE(name);
        const Picture picture = read_exr(fixtures() / name);
        const nlohmann::json& window = truth["dataWindow"];
        EXPECT_EQ(picture.width, window[2].get<int>() - window[0].get<int>() + 1);
        EXPECT_EQ(picture.height, window[3].get<int>() - window[1].get<int>() + 1);
        EXPECT_EQ(picture.channels.size(), truth["channels"].size());
        const nlohmann::json statistics = truth.value("pixel_stats", nlohmann::json::object());
        for (const auto& [channel, expected] : statistics.items()) {
            double sum = 0, count = 0;
            for (const float value : picture.channels.at(channel))
                if (std::isfinite(value)) {
                    sum += static_cast<double>(value);
                    ++count;
                }
            EXPECT_NEAR(sum / count, expected["mean"].get<double>(),
                        1e-5 * std::fabs(expected["mean"].get<double>()) + 1e-7);
            ++compared;
        }
    }
    EXPECT_GE(compared, 15);
}

TEST(Exr, DamagedForeignFilesAreReadOrRefusedWithoutHarm)
{
    if (!std::filesystem::exists(fixtures() / "damaged"))
        GTEST_SKIP() << "the collection of damaged pictures is not here";
    int refused = 0, files = 0;
    for (const char* folder : {"damaged", "openexr-test"})
        for (const auto& entry : std::filesystem::directory_iterator(fixtures() / folder)) {
            SCOPED_TRACE(entry.path().string());
            ++files;
            refused += reads_or_refuses(entry.path()) ? 0 : 1;
        }
    EXPECT_GE(files, 40);
    EXPECT_GE(refused, 40);
}

TEST(Exr, EveryTruncationIsRefused)
{
    const Folder folder;
    write_exr(noise(70, 70, {"R", "G", "B"}), folder / "whole.exr");
    const std::string whole = bytes_of(folder / "whole.exr");
    for (std::size_t length = 0; length < whole.size(); length += length < 1000 ? 1 : 997) {
        write_bytes(folder / "cut.exr", whole.substr(0, length));
        EXPECT_NE(error_of([&] { read_exr(folder / "cut.exr"); }), "") << length;
    }
}

TEST(Exr, ChangedBytesNeverCrash)
{
    const Folder folder;
    Picture picture = noise(40, 33, {"R", "G", "illuminance.Y"});
    picture.header["VIEW"] = "-vtv";
    write_exr(picture, folder / "whole.exr");
    const std::string whole = bytes_of(folder / "whole.exr");
    RandomStream random(7);
    int refused = 0;
    for (int round = 0; round < 1000; ++round) {
        std::string changed = whole;
        for (int i = 0; i < 1 + round % 4; ++i) // most damage in the header, where it matters
            changed[random.bits() % (round % 3 == 0 ? whole.size() : 800)] = static_cast<char>(random.bits());
        write_bytes(folder / "changed.exr", changed);
        refused += reads_or_refuses(folder / "changed.exr") ? 0 : 1;
    }
    EXPECT_GT(refused, 300);
    EXPECT_LT(refused, 1000);
}

TEST(Exr, AbsurdSizesAreNamedBeforeAnythingIsAllocated)
{
    const Folder folder;
    write_exr(noise(5, 4, {"R"}), folder / "p.exr");
    const std::string bytes = bytes_of(folder / "p.exr");
    const auto refusal = [&](const std::string& attribute, std::size_t offset, const std::string& value) {
        write_bytes(folder / "bad.exr", with_attribute(bytes, attribute, offset, value));
        return error_of([&] { read_exr(folder / "bad.exr"); });
    };
    EXPECT_NE(refusal(data_window, 8, little_endian(0x7ffffffe)).find("size is 2147483647 x 4 pixels, expected 1 to"),
              std::string::npos);
    EXPECT_NE(refusal(data_window, 8, little_endian(0xfffffffe)).find("size is -1 x 4 pixels"), std::string::npos);
    EXPECT_NE(refusal(data_window, 8, little_endian(16383) + little_endian(16383)).find("cannot hold"),
              std::string::npos);
    EXPECT_NE(refusal(data_window, 8, little_endian(4095) + little_endian(4095)).find("table of its 4096 chunks"),
              std::string::npos);
    EXPECT_NE(refusal(tile_description, 0, little_endian(0)).find("tiles are 0 x 64"), std::string::npos);
    EXPECT_NE(refusal(tile_description, 0, little_endian(0x40000000)).find("tiles are 1073741824 x 64"),
              std::string::npos);
    EXPECT_NE(error_of([&] { read_exr(folder / "none.exr"); }).find("none.exr"), std::string::npos);
    write_bytes(folder / "text.exr", "this is no picture");
    EXPECT_NE(error_of([&] { read_exr(folder / "text.exr"); }).find("is not an OpenEXR file"), std::string::npos);
}

TEST(Exr, WhatCannotBeWrittenIsRefusedAndLeavesTheOldFile)
{
    const Folder folder;
    Picture picture = noise(5, 4, {"R"});
    write_exr(picture, folder / "p.exr");
    const std::string before = bytes_of(folder / "p.exr");
    Picture incomplete = picture;
    incomplete.channels["G"] = {1, 2, 3};
    EXPECT_NE(
        error_of([&] { write_exr(incomplete, folder / "p.exr"); }).find("channel \"G\" has 3 values, expected 20"),
        std::string::npos);
    for (const auto& [entry, value] :
         std::map<std::string, std::string>{{"chromaticities", "0.64 0.33 red"}, {"whiteLuminance", "-1"}}) {
        Picture colour = picture;
        colour.header[entry] = value;
        const std::string error = error_of([&] { write_exr(colour, folder / "p.exr"); });
        EXPECT_NE(error.find("p.exr: header entry " + entry + " is \"" + value + "\""), std::string::npos) << error;
    }
    Picture reserved = picture;
    reserved.header["channels"] = "three";
    EXPECT_NE(error_of([&] { write_exr(reserved, folder / "p.exr"); }).find("\"channels\""), std::string::npos);
    EXPECT_NE(error_of([&] { write_exr({}, folder / "p.exr"); }).find("0 x 0"), std::string::npos);
    EXPECT_NE(error_of([&] { write_exr(picture, folder / "no folder/p.exr"); }).find("does not exist"),
              std::string::npos);
    EXPECT_EQ(bytes_of(folder / "p.exr"), before);
    EXPECT_EQ(folder.file_count(), 1u) << "no temporary file is left";
}

/// A child that may write only 20,000 bytes to a file, as on a full disk.
TEST(Exr, AFullDiskIsReportedAndLeavesNothing)
{
    const Folder folder;
    const Picture picture = noise(300, 200, {"R", "G", "B"});
    const pid_t child = fork();
    if (child == 0) {
        signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{20000, 20000};
        setrlimit(RLIMIT_FSIZE, &limit);
        int refused = 0;
        try {
            write_exr(picture, folder / "p.exr");
        } catch (const InputError&) {
            ++refused;
        }
        try {
            GrowingPicture growing(folder / "q.exr", picture, 64);
            for (int x = 0; x < 256; x += 64)
                growing.put(x, 0, tile_of(picture, x, 0, 64));
        } catch (const InputError&) {
            ++refused;
        }
        _exit(refused);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 2);
    EXPECT_EQ(folder.file_count(), 1u) << "only the growing picture's work in progress";
    EXPECT_TRUE(std::filesystem::exists(folder / "q.partial.exr"));
}

} // namespace lightwell
