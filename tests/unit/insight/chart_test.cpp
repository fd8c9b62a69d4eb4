#include "plugins/insight/chart.h"
#include "plugins/insight/validation_report.h"

#include <gtest/gtest.h>

#include <limits>

namespace lightwell {
namespace {

std::size_t count_of(const std::string& text, const std::string& part)
{
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++found;
    return found;
}

Chart two_points()
{
    Chart chart;
    chart.title = "A & B";
    chart.x_label = "time (s)";
    chart.y_label = "error (%)";
    chart.log_x = chart.log_y = true;
    chart.series = {{"first", {{1, 10, "ten", true}, {100, 1, ""}}, true}};
    return chart;
}

TEST(Chart, HasItsAxesLabelsAndMarks)
{
    const std::string svg = chart_svg(two_points());
    EXPECT_NE(svg.find("A &amp; B"), std::string::npos);
    EXPECT_NE(svg.find("time (s)"), std::string::npos);
    EXPECT_NE(svg.find("error (%)"), std::string::npos);
    EXPECT_EQ(count_of(svg, "r=\"6\""), 3u); // two marks and the one beside the name
    EXPECT_EQ(count_of(svg, "r=\"13\""), 1u);
    EXPECT_EQ(count_of(svg, "<svg"), count_of(svg, "</svg>"));
}

/// Twice the time and twice the error lie a quarter and a half of the way along their decades.
TEST(Chart, PlacesPointsByTheirLogarithm)
{
    Chart chart = two_points();
    chart.series = {{"one", {{1, 1, ""}, {10, 1, ""}, {100, 1, ""}}, false}};
    const std::string svg = chart_svg(chart);
    std::vector<double> places;
    for (std::size_t at = svg.find("cx=\""); at != std::string::npos; at = svg.find("cx=\"", at + 1))
        places.push_back(std::stod(svg.substr(at + 4)));
    ASSERT_GE(places.size(), 3u);
    EXPECT_NEAR(places[1] - places[0], places[2] - places[1], 0.2);
    EXPECT_GT(places[1], places[0]);
}

TEST(Chart, LeavesOutWhatCannotBeDrawnAndNeverWritesNan)
{
    Chart chart = two_points();
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    chart.series[0].points.insert(chart.series[0].points.end(),
                                  {{nan, 1, "a"}, {1, inf, "b"}, {0, 1, "c"}, {1, -1, "d"}});
    const std::string svg = chart_svg(chart);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    EXPECT_EQ(count_of(svg, "r=\"6\""), 3u);
    chart.series.clear();
    EXPECT_NE(chart_svg(chart).find("</svg>"), std::string::npos);
}

TEST(ValidationPage, ShowsRowsThatFailAndEscapesTheirNames)
{
    ValidationRow good, bad;
    good.case_id = "cl_good";
    good.expected = good.found = 10;
    good.tolerance = 1;
    good.passed = true;
    bad = good;
    bad.case_id = "cl_<bad>";
    bad.found = 12;
    bad.passed = false;
    bad.reason = "deviates";
    const std::string page = validation_html({good, bad}, "Quick look");
    EXPECT_NE(page.find("1 of 2 rows passed"), std::string::npos);
    EXPECT_NE(page.find("cl_&lt;bad&gt;"), std::string::npos);
    EXPECT_EQ(page.find("cl_<bad>"), std::string::npos);
    EXPECT_EQ(count_of(page, "class=\"bad\""), 1u);
    EXPECT_EQ(count_of(page, "<svg"), 2u);
    EXPECT_NE(validation_html({}, "nothing").find("0 of 0"), std::string::npos);
}

} // namespace
} // namespace lightwell
