#include "plugins/insight/chart.h"

#include "engine/pictures/legend.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace lightwell {
namespace {

constexpr double width = 960, height = 640, left = 112, right = 250, top = 64, bottom = 112;
constexpr double plot_width = width - left - right, plot_height = height - top - bottom;
/// Told apart by people who do not see all colours, and by the shape of their marks.
/// Source  Okabe, Ito 2008
constexpr const char* colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"};
constexpr std::size_t colour_count = std::size(colours);

/// From values to places along one axis.
class Axis {
public:
    Axis(double low, double high, bool logarithmic) : logarithmic_(logarithmic)
    {
        if (!(low <= high))
            low = high = 1;
        scale_.logarithmic = logarithmic;
        if (logarithmic) {
            constexpr double margin = 1.3;
            scale_.low = low / margin;
            scale_.high = high * margin;
        } else {
            const double margin = std::fmax(0.05 * (high - low), high == low ? 0.5 : 0);
            scale_.low = low >= 0 && low < 0.3 * high ? 0 : low - margin;
            scale_.high = high + margin;
        }
    }
    /// 0 at the low end, 1 at the high one.
    double place(double value) const { return scale_.place(value); }
    bool shows(double value) const
    {
        return std::isfinite(value) && (!logarithmic_ || value > 0) && place(value) >= -1e-9 &&
               place(value) <= 1 + 1e-9;
    }
    std::vector<double> ticks() const
    {
        std::vector<double> found;
        for (const double tick : legend_numbers(scale_, 9))
            if (shows(tick))
                found.push_back(tick);
        return found;
    }

private:
    Scale scale_;
    bool logarithmic_;
};

/// Lowest and highest of what can be drawn.
class Span {
public:
    void take(double value, bool logarithmic)
    {
        if (std::isfinite(value) && (!logarithmic || value > 0)) {
            low_ = std::min(low_, value);
            high_ = std::max(high_, value);
        }
    }
    Axis axis(bool logarithmic) const { return {low_, high_, logarithmic}; }

private:
    double low_ = std::numeric_limits<double>::infinity(), high_ = -std::numeric_limits<double>::infinity();
};

std::string text(double x, double y, const std::string& words, int size, const char* anchor, const char* more = "")
{
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, size,
                       anchor, more, escaped_markup(words));
}

std::string line(double x0, double y0, double x1, double y1, const char* style)
{
    return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", x0, y0, x1, y1, style);
}

/// A mark of its own for each series: circle, square, diamond, triangle, in turn.
std::string mark(double x, double y, std::size_t series)
{
    const char* colour = colours[series % colour_count];
    constexpr double r = 6;
    switch (series % 4) {
    case 0:
        return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"/>\n", x, y, r, colour);
    case 1:
        return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n", x - r, y - r,
                           2 * r, 2 * r, colour);
    case 2:
        return fmt::format("<path d=\"M{:.1f} {:.1f}l{} {}l-{} {}l-{} -{}z\" fill=\"{}\"/>\n", x, y - 1.3 * r, 1.3 * r,
                           1.3 * r, 1.3 * r, 1.3 * r, 1.3 * r, 1.3 * r, colour);
    default:
        return fmt::format("<path d=\"M{:.1f} {:.1f}l{} {}h-{}z\" fill=\"{}\"/>\n", x, y - 1.3 * r, 1.2 * r, 2.2 * r,
                           2.4 * r, colour);
    }
}

class Drawing {
public:
    explicit Drawing(const Chart& chart) : chart_(chart), x_(span(true)), y_(span(false)) {}

    std::string svg() const
    {
        std::string all = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" "
                                      "font-family=\"sans-serif\" fill=\"#222\">\n",
                                      width, height);
        all += fmt::format("<rect width=\"{}\" height=\"{}\" fill=\"#fff\"/>\n", width, height);
        all += text(left, 36, chart_.title, 26, "start", " font-weight=\"bold\"");
        return all + frame() + levels() + lines_and_marks() + names() + "</svg>\n";
    }

private:
    Axis span(bool of_x) const
    {
        Span found;
        for (const ChartSeries& series : chart_.series)
            for (const ChartPoint& point : series.points) {
                const bool drawable = !(chart_.log_x && point.x <= 0) && !(chart_.log_y && point.y <= 0);
                if (drawable) {
                    found.take(of_x ? point.x : point.y, of_x ? chart_.log_x : chart_.log_y);
                    if (chart_.diagonal)
                        found.take(of_x ? point.y : point.x, of_x ? chart_.log_x : chart_.log_y);
                }
            }
        if (!of_x)
            for (const ChartLevel& level : chart_.levels)
                found.take(level.y, chart_.log_y);
        return found.axis(of_x ? chart_.log_x : chart_.log_y);
    }
    double px(double x) const { return left + plot_width * x_.place(x); }
    double py(double y) const { return top + plot_height * (1 - y_.place(y)); }
    bool shows(const ChartPoint& point) const { return x_.shows(point.x) && y_.shows(point.y); }

    std::string frame() const
    {
        constexpr const char* thin = "stroke=\"#ddd\" stroke-width=\"1\"";
        std::string all;
        double last = -1e9;
        for (const double tick : x_.ticks()) {
            all += line(px(tick), top, px(tick), top + plot_height, thin);
            if (px(tick) - last >= 58) // numbers keep clear of each other
                all += text(px(tick), top + plot_height + 28, number_text(tick), 20, "middle");
            last = px(tick) - last >= 58 ? px(tick) : last;
        }
        for (const double tick : y_.ticks()) {
            all += line(left, py(tick), left + plot_width, py(tick), thin);
            all += text(left - 10, py(tick) + 7, number_text(tick), 20, "end");
        }
        all += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#222\"/>\n", left,
                           top, plot_width, plot_height);
        all += text(left + 0.5 * plot_width, top + plot_height + 60, chart_.x_label, 22, "middle");
        all += text(0, 0, chart_.y_label, 22, "middle",
                    fmt::format(" transform=\"translate(28 {}) rotate(-90)\"", top + 0.5 * plot_height).c_str());
        all += text(left, height - 14, chart_.note, 17, "start");
        if (chart_.diagonal) {
            const double ends[] = {0.0, 1.0};
            all += line(left + plot_width * ends[0], top + plot_height, left + plot_width * ends[1], top,
                        "stroke=\"#222\" stroke-dasharray=\"6 6\"");
        }
        return all;
    }

    std::string levels() const
    {
        std::string all;
        for (const ChartLevel& level : chart_.levels) {
            if (!y_.shows(level.y))
                continue;
            all += line(left, py(level.y), left + plot_width, py(level.y),
                        "stroke=\"#777\" stroke-width=\"2\" stroke-dasharray=\"4 5\"");
            all += text(left + plot_width - 8, py(level.y) - 7, level.label, 17, "end");
        }
        return all;
    }

    std::string lines_and_marks() const
    {
        std::string all;
        for (std::size_t s = 0; s < chart_.series.size(); ++s) {
            std::string way;
            for (const ChartPoint& point : chart_.series[s].points)
                if (shows(point))
                    way += fmt::format("{:.1f},{:.1f} ", px(point.x), py(point.y));
            if (chart_.series[s].joined && !way.empty())
                all += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"3\"/>\n", way,
                                   colours[s % colour_count]);
        }
        for (std::size_t s = 0; s < chart_.series.size(); ++s)
            for (const ChartPoint& point : chart_.series[s].points)
                if (shows(point))
                    all += marked(point, s);
        return all;
    }

    std::string marked(const ChartPoint& point, std::size_t series) const
    {
        std::string all = mark(px(point.x), py(point.y), series);
        if (point.ringed)
            all += fmt::format(
                "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"13\" fill=\"none\" stroke=\"#222\" stroke-width=\"2.5\"/>\n",
                px(point.x), py(point.y));
        const bool near_right = px(point.x) > left + 0.8 * plot_width;
        if (!point.label.empty())
            all += text(px(point.x) + (near_right ? -12 : 12), py(point.y) - 9, point.label, 17,
                        near_right ? "end" : "start");
        return all;
    }

    std::string names() const
    {
        std::string all;
        double y = top + 16;
        for (std::size_t s = 0; s < chart_.series.size(); ++s, y += 32) {
            all += mark(left + plot_width + 28, y - 6, s);
            all += text(left + plot_width + 44, y, chart_.series[s].name, 19, "start");
        }
        return all;
    }

    const Chart& chart_;
    Axis x_, y_;
};

} // namespace

std::string escaped_markup(const std::string& text)
{
    std::string all;
    for (const char c : text) {
        switch (c) {
        case '&':
            all += "&amp;";
            break;
        case '<':
            all += "&lt;";
            break;
        case '>':
            all += "&gt;";
            break;
        case '"':
            all += "&quot;";
            break;
        default:
            all += c;
        }
    }
    return all;
}

std::string chart_svg(const Chart& chart)
{
    return Drawing(chart).svg();
}

} // namespace lightwell
