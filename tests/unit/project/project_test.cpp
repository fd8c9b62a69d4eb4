#include "engine/base/errors.h"
#include "importers/project/date_time.h"
#include "importers/project/project.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace lightwell {
namespace {

class ProjectFile : public testing::Test {
protected:
    void SetUp() override
    {
        folder_ = std::filesystem::path(testing::TempDir()) /
                  (std::string("project_") + testing::UnitTest::GetInstance()->current_test_info()->name());
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    Project read(const std::string& text)
    {
        std::ofstream(folder_ / "project.toml") << text;
        return read_project(folder_ / "project.toml");
    }
    /// The message for a bad project; empty when it was accepted.
    std::string complaint(const std::string& text)
    {
        try {
            read(text);
        } catch (const InputError& error) {
            return error.what();
        }
        return {};
    }
    std::filesystem::path folder_;
};

const std::string inputs = "[inputs]\nfiles = [\"a.dxf\"]\n";
const std::string place = "[place]\nlatitude = 52.5\nlongitude = 13.4\nutc_offset = 2\ntime = \"2026-06-21T12:30\"\n";

const char* const every_word = R"(
[inputs]
files = ["house.dxf", "trees/oak.obj"]
map = "map.toml"
unit = "mm"
up = "z"
extrude = ["A-WALL=2.8", "S-*=300cm"]
[place]
latitude = -33.9
longitude = 151.2
utc_offset = 10
north = 15
time = "2026-12-21T09:15:30"
[sky]
type = "intermediate"
sun = false
turbidity = 3
ground_reflectance = 0.1
[[view]]
name = "desk"
text = "-vtv -vp 1 2 3 -vd 0 1 0 -vu 0 0 1 -vh 60 -vv 40"
size = [800, 600]
[[view]]
position = [0, 0, 1.5]
target = [0, 10, 1.5]
kind = "angular"
[[grid]]
on = "layer:A-FLOR@0.75"
spacing = 0.25
name = "work plane"
[[grid]]
on = "file:points.txt"
[wish]
accuracy = 0.03
seed = 7
[output]
folder = "results"
png = false
hdr = true
)";

TEST_F(ProjectFile, EveryWordArrives)
{
    const Project project = read(every_word);
    ASSERT_EQ(project.inputs.files.size(), 2u);
    EXPECT_EQ(project.inputs.files[1], folder_ / "trees/oak.obj");
    EXPECT_EQ(project.inputs.map, folder_ / "map.toml");
    EXPECT_EQ(project.inputs.unit, "mm");
    EXPECT_EQ(project.inputs.up, "z");
    ASSERT_EQ(project.inputs.raised.size(), 2u);
    EXPECT_EQ(project.inputs.raised[1].layer, "S-*");
    EXPECT_EQ(project.inputs.raised[1].height_m, 3);
    ASSERT_TRUE(project.place);
    EXPECT_EQ(project.place->latitude_deg, -33.9);
    EXPECT_EQ(project.place->longitude_deg, 151.2);
    EXPECT_EQ(project.place->utc_offset_h, 10);
    EXPECT_EQ(project.place->month, 12);
    EXPECT_DOUBLE_EQ(project.place->hour, 9 + 15 / 60. + 30 / 3600.);
    EXPECT_EQ(project.north_deg, 15);
    ASSERT_TRUE(project.sky);
    EXPECT_EQ(project.sky->kind, CieSky::intermediate);
    EXPECT_FALSE(project.sky->with_sun);
    EXPECT_EQ(project.sky->turbidity, 3);
    EXPECT_EQ(project.sky->ground_reflectance, 0.1);
    ASSERT_EQ(project.views.size(), 2u);
    EXPECT_EQ(project.views[0].view.name, "desk");
    EXPECT_EQ(project.views[0].view.position, (Point{1, 2, 3}));
    EXPECT_EQ(project.views[0].view.horizontal, 60);
    EXPECT_EQ(project.views[0].width, 800);
    EXPECT_EQ(project.views[1].view.name, "view2");
    EXPECT_EQ(project.views[1].view.kind, View::Kind::angular);
    EXPECT_EQ(project.views[1].view.horizontal, 180);
    EXPECT_EQ(normalized(project.views[1].view.direction), (Direction{0, 1, 0}));
    ASSERT_EQ(project.grids.size(), 2u);
    EXPECT_EQ(project.grids[0].layer, "A-FLOR");
    EXPECT_EQ(project.grids[0].height_m, 0.75);
    EXPECT_EQ(project.grids[0].spacing_m, 0.25);
    EXPECT_EQ(project.grids[0].name, "work plane");
    EXPECT_EQ(project.grids[1].file, (folder_ / "points.txt").string());
    EXPECT_EQ(project.wish.accuracy, 0.03);
    EXPECT_FALSE(project.wish.samples);
    EXPECT_EQ(project.wish.seed, 7);
    EXPECT_EQ(project.output.folder, folder_ / "results");
    EXPECT_FALSE(project.output.png);
    EXPECT_TRUE(project.output.hdr);
}

TEST_F(ProjectFile, AViewHasShiftClippingAndLens)
{
    const Project project = read(R"([inputs]
files = ["house.dxf"]
[[view]]
position = [1, 2, 3]
target = [1, 5, 3]
kind = "cylindrical"
horizontal = 300
shift = 0.25
lift = -0.5
fore = 1
aft = 40
lens = 0.05
focus = 6
[[view]]
position = [0, 0, 0]
direction = [0, 1, 0]
kind = "planisphere"
)");
    const View& view = project.views[0].view;
    EXPECT_EQ(to_text(view),
              "-vtc -vp 1 2 3 -vd 0 3 0 -vu 0 0 1 -vh 300 -vv 45 -vs 0.25 -vl -0.5 -vo 1 -va 40 -pd 0.05 -pf 6");
    EXPECT_EQ(to_text(project.views[1].view),
              "-vts -vp 0 0 0 -vd 0 1 0 -vu 0 0 1 -vh 180 -vv 180 -vs 0 -vl 0 -vo 0 -va 0");
    EXPECT_NE(complaint(inputs + "[[view]]\ntext = \"-vtv\"\nlens = 1\n").find("lens stands beside text"),
              std::string::npos);
    EXPECT_NE(complaint(inputs + "[[view]]\nposition = [0, 0, 0]\ntarget = [0, 1, 0]\nkind = \"round\"\n")
                  .find("cylindrical"),
              std::string::npos);
    EXPECT_NE(complaint(inputs + "[[view]]\nposition = [0, 0, 0]\ntarget = [0, 1, 0]\nlens = -1\n").find("lens"),
              std::string::npos);
}

TEST_F(ProjectFile, WithoutAPlaceThereIsElectricLightOnlyAndWithOneAClearSky)
{
    EXPECT_FALSE(read(inputs).sky);
    EXPECT_FALSE(read(inputs + "[sky]\ntype = \"none\"\n").sky);
    EXPECT_FALSE(read(inputs + place + "[sky]\ntype = \"none\"\n").sky);
    const Project clear = read(inputs + place);
    ASSERT_TRUE(clear.sky);
    EXPECT_EQ(clear.sky->kind, CieSky::clear);
    EXPECT_TRUE(clear.sky->with_sun);
    EXPECT_FALSE(read(inputs + place + "[sky]\ntype = \"overcast\"\n").sky->with_sun);
}

TEST_F(ProjectFile, ComplaintsNameTheLineAndTheWayOut)
{
    struct Bad {
        std::string text;
        const char *place, *words;
    };
    const std::string head = inputs + place; // 7 lines
    for (const Bad& bad : std::vector<Bad>{
             {"", "project.toml", "[inputs]"},
             {"[inputs]\nmap = \"m\"\n", "project.toml:1", "files"},
             {"[inputs]\nfiles = 3\n", "project.toml:2", "files is 3"},
             {"[inputs\n", "project.toml:1", "TOML"},
             {inputs + "unit = \"furlong\"\n", "project.toml:3", "furlong"},
             {inputs + "up = \"x\"\n", "project.toml:3", "\"y\" or \"z\""},
             {inputs + "layers = 1\n", "project.toml:3", "unknown word \"layers\""},
             {inputs + "[viwe]\n", "project.toml:3", "nearest: view"},
             {inputs + "[place]\nlatitude = 95\n", "project.toml:4", "-90 to 90"},
             {inputs + "[place]\nlatitude = nan\n", "project.toml:4", "nan"},
             {inputs + "[place]\nlatitude = 5\n", "project.toml:3", "longitude"},
             {inputs + "[place]\nlatitude = 5\nlongitude = 5\ntime = \"2026-02-30T12:00\"\n", "project.toml:6",
              "2026-02-30"},
             {inputs + "[place]\nlatitude = 5\nlongitude = 5\ntime = \"2026-02-03T12:00\"\n", "project.toml:3",
              "utc_offset"},
             {inputs + "[place]\nlatitude = 5\nlongitude = 5\nutc_offset = 1\ntime = \"2026-02-03T12:00+02:00\"\n",
              "project.toml:6", "but the time says 2"},
             {inputs + "[sky]\ntype = \"clear\"\n", "project.toml:3", "[place]"},
             {head + "[sky]\ntype = \"cloudy\"\n", "project.toml:9", "overcast"},
             {head + "[sky]\ntype = \"overcast\"\nsun = true\n", "project.toml:10", "hides the sun"},
             {head + "[sky]\nground_reflectance = 1.5\n", "project.toml:9", "0 to 1"},
             {head + "[[view]]\nposition = [0, 0, 0]\n", "project.toml:8", "direction or a target"},
             {head + "[[view]]\nposition = [0, 0]\n", "project.toml:9", "three finite numbers"},
             {head + "[[view]]\nposition = [0, 0, 0]\ndirection = [0, 0, 1]\nup = [0, 0, 1]\n", "project.toml:8", "up"},
             {head + "[[view]]\ntext = \"-vtv -vp 0 0 zero\"\n", "project.toml:9", ""},
             {head + "[[view]]\ntext = \"-vtv -vp 0 0 0 -vd 0 1 0\"\nup = [0, 0, 1]\n", "project.toml:10", "text"},
             {head + "[[view]]\nposition = [0, 0, 0]\ndirection = [0, 1, 0]\nsize = [1e9, 10]\n", "project.toml:11",
              "pixels"},
             {head + "[[grid]]\non = \"floor\"\n", "project.toml:9", "layer:"},
             {head + "[[grid]]\non = \"layer:A@0.7\"\nspacing = 0\n", "project.toml:10", "spacing"},
             {head + "[wish]\ntime = \"soon\"\n", "project.toml:9", "expected \"60s\""},
             {head + "[wish]\ntime = \"-1s\"\n", "project.toml:9", "expected \"60s\""},
             {head + "[wish]\ntime = 60\n", "project.toml:9", ""},
             {head + "[wish]\nquality = 2\n", "project.toml:9", ""},
             {head + "[wish]\nquality = \"best\"\n", "project.toml:9", "expected \"draft\""},
             {head + "[wish]\ntime = \"60s\"\nquality = \"fine\"\n", "project.toml:10", "keep one"},
             {head + "[wish]\naccuracy = 0\n", "project.toml:9", "accuracy is 0"},
             {head + "[wish]\nsamples = 2.5\n", "project.toml:9", "whole number"},
             {head + "[wish]\naccuracy = 0.1\nsamples = 4\n", "project.toml:10", "keep one"},
             {head + "[output]\npng = \"yes\"\n", "project.toml:9", "true or false"},
         }) {
        const std::string message = complaint(bad.text);
        EXPECT_NE(message.find(bad.place), std::string::npos) << bad.text << "\n-> " << message;
        EXPECT_NE(message.find(bad.words), std::string::npos) << bad.text << "\n-> " << message;
    }
}

TEST_F(ProjectFile, AMissingFileIsNamed)
{
    EXPECT_THROW(read_project(folder_ / "absent.toml"), InputError);
    EXPECT_THROW(read_project(folder_), InputError);
}

TEST(SampleProjects, AreAllAccepted)
{
    std::size_t projects = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(LIGHTWELL_ROOT "/samples")) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with("project") || entry.path().extension() != ".toml")
            continue;
        ++projects;
        SCOPED_TRACE(entry.path().string());
        Project project;
        EXPECT_NO_THROW(project = read_project(entry.path()));
        for (const std::filesystem::path& file : project.inputs.files)
            EXPECT_TRUE(std::filesystem::exists(file)) << file;
        EXPECT_TRUE(project.inputs.map.empty() || std::filesystem::exists(project.inputs.map)) << project.inputs.map;
        EXPECT_GE(project.views.size() + project.grids.size(), 1u);
    }
    EXPECT_GE(projects, 1u);
}

TEST(DateTimes, AreReadAsIso8601WritesThem)
{
    const auto noon = parse_date_time("2026-06-21T12:00");
    ASSERT_TRUE(noon);
    EXPECT_EQ(noon->year, 2026);
    EXPECT_EQ(noon->day, 21);
    EXPECT_EQ(noon->hour, 12);
    EXPECT_FALSE(noon->utc_offset_h);
    EXPECT_DOUBLE_EQ(*parse_date_time("2026-06-21T12:00:36-03:30")->utc_offset_h, -3.5);
    EXPECT_DOUBLE_EQ(parse_date_time("2026-06-21T12:00:36-03:30")->hour, 12.01);
    EXPECT_EQ(*parse_date_time("2026-06-21 12:00Z")->utc_offset_h, 0);
    EXPECT_EQ(*parse_date_time("2026-06-21T12:00+0545")->utc_offset_h, 5.75);
    EXPECT_TRUE(parse_date_time("2024-02-29T00:00"));
    for (const char* bad : {"", "noon", "2026-06-21", "2026-06-21T24:00", "2026-13-01T00:00", "2025-02-29T00:00",
                            "2026-06-21T12:60", "2026-06-21T12", "2026-06-21T12:00:61", "2026-06-21T12:00+99:00",
                            "2026-06-21T12:00junk", "26-06-21T12:00", "2026-00-10T10:00", "2026-06-21T12:00+"})
        EXPECT_FALSE(parse_date_time(bad)) << bad;
}

TEST(DateTimes, ZonesOfTheDatabaseKnowTheirSummerTime)
{
    if (!std::filesystem::exists("/usr/share/zoneinfo/Europe/Berlin"))
        GTEST_SKIP() << "the database of zones is not installed";
    const auto offset = [](const std::string& text) { return parse_date_time(text).value().utc_offset_h.value(); };
    EXPECT_EQ(offset("2026-01-15T12:00[Europe/Berlin]"), 1);
    EXPECT_EQ(offset("2026-07-15T12:00:30[Europe/Berlin]"), 2);
    EXPECT_EQ(offset("2026-07-15T12:00[America/St_Johns]"), -2.5);
    EXPECT_EQ(offset("2049-01-15T12:00[Asia/Kathmandu]"), 5.75);
    EXPECT_EQ(offset("2026-10-25T02:30[Europe/Berlin]"), 2); // comes twice: the first of the two
    for (const char* bad :
         {"2026-03-29T02:30[Europe/Berlin]", "2026-01-15T12:00[Europe/Atlantis]", "2026-01-15T12:00[../../etc/passwd]",
          "2026-01-15T12:00[]", "2026-01-15T12:00[Europe/Berlin", "2026-01-15T12:00[/usr/share/zoneinfo/Europe/Berlin]",
          "2026-01-15T12:00[Europe]"})
        EXPECT_FALSE(parse_date_time(bad)) << bad;
}

} // namespace
} // namespace lightwell
