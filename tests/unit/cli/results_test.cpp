#include "plugins/cli/map_files.h"
#include "plugins/cli/picture_files.h"
#include "plugins/cli/provenance.h"
#include "plugins/cli/terminal.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

TEST(MapSummary, IsTheArithmeticOfThePoints)
{
    GridResult result;
    result.values = {Illuminance{100}, Illuminance{300}, Illuminance{500}};
    result.standard_errors = {Illuminance{3}, Illuminance{4}, Illuminance{12}};
    result.mean_standard_error = Illuminance{6};
    const MapSummary s = summarize(result);
    EXPECT_DOUBLE_EQ(s.mean, 300);
    EXPECT_DOUBLE_EQ(s.minimum, 100);
    EXPECT_DOUBLE_EQ(s.maximum, 500);
    EXPECT_DOUBLE_EQ(s.uniformity, 1.0 / 3);
    EXPECT_DOUBLE_EQ(s.mean_error, 6);
    result.values.assign(3, Illuminance{0});
    EXPECT_DOUBLE_EQ(summarize(result).uniformity, 0);
}

TEST(PictureSize, KeepsPixelsSquareWithinTheGivenSize)
{
    View view;
    view.horizontal = 90;
    view.vertical = 90;
    PictureSettings settings;
    settings.width = 960;
    settings.height = 540;
    fit_to_view(view, settings);
    EXPECT_EQ(settings.width, 540);
    EXPECT_EQ(settings.height, 540);
    view.vertical = 2 * std::atan(0.5) / radians_per_degree; // half as high as wide
    settings.width = 100;
    settings.height = 100;
    fit_to_view(view, settings);
    EXPECT_EQ(settings.width, 100);
    EXPECT_EQ(settings.height, 50);
}

TEST(Terminal, SaysDurationsInTheirUsualUnits)
{
    EXPECT_EQ(duration_text(0.44), "0.4 s");
    EXPECT_EQ(duration_text(59.4), "59 s");
    EXPECT_EQ(duration_text(185), "3 min 05 s");
    EXPECT_EQ(duration_text(7800), "2 h 10 min");
    EXPECT_EQ(duration_text(-1), "0.0 s");
}

TEST(RunRecord, StandsBesideTheResultUnderItsName)
{
    EXPECT_EQ(run_record_name("out/room.exr"), "out/room.run.json");
    EXPECT_EQ(run_record_name("a.b.csv"), "a.b.run.json");
}

} // namespace
} // namespace lightwell
