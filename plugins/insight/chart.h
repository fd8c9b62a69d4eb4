#pragma once

#include <string>
#include <vector>

namespace lightwell {

struct ChartPoint {
    double x = 0, y = 0;
    std::string label; ///< beside the point; empty: none
    bool ringed = false;
};
struct ChartSeries {
    std::string name;
    std::vector<ChartPoint> points;
    bool joined = true; ///< by a line
};
/// A horizontal line across the chart.
struct ChartLevel {
    double y = 0;
    std::string label;
};

/// Points in a frame with labelled axes.
struct Chart {
    std::string title, x_label, y_label; ///< with their units
    bool log_x = false, log_y = false;
    std::vector<ChartSeries> series;
    std::vector<ChartLevel> levels;
    bool diagonal = false; ///< y = x: expected against found
    std::string note;      ///< below the chart
};

/// The chart as SVG, 960 x 640, its letters large enough to be read at half that size. What cannot be drawn (not
/// finite, or not above 0 on a logarithmic axis) is left out.
std::string chart_svg(const Chart& chart);
/// Text within SVG or HTML: `&`, `<`, `>` and quotes written out.
std::string escaped_markup(const std::string& text);

} // namespace lightwell
