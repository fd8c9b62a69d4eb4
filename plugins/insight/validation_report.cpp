#include "plugins/insight/validation_report.h"

#include "plugins/insight/chart.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace lightwell {
namespace {

constexpr const char* style = R"(<style>
body{font:16px/1.5 system-ui,sans-serif;color:#222;background:#fff;margin:0 auto;max-width:1100px;padding:1rem}
h1{font-size:1.7rem;margin:.5rem 0}h2{font-size:1.3rem;margin:2rem 0 .5rem}
svg{width:100%;height:auto;display:block}
.wide{overflow-x:auto}
table{border-collapse:collapse;font-size:.85rem;white-space:nowrap}
th,td{padding:.2rem .6rem;border-bottom:1px solid #ddd;text-align:right}
th:first-child,td:first-child,th:nth-child(2),td:nth-child(2){text-align:left}
.rows td:nth-child(2),.rows td:last-child{white-space:normal;min-width:8rem;max-width:16rem;overflow-wrap:anywhere}
thead th{position:sticky;top:0;background:#fff}
.bad{background:#fde3d6;font-weight:bold}
.sum{font-size:1.1rem}
@media(max-width:600px){table{font-size:.7rem}th,td{padding:.2rem .2rem}h1{font-size:1.3rem}
.rows td:first-child{white-space:normal;overflow-wrap:anywhere;min-width:5.6rem}.rows td:nth-child(2),.rows td:last-child{min-width:0}
.rows :is(th,td):is(:nth-child(5),:nth-child(6),:nth-child(7),:nth-child(8),:nth-child(9)){display:none}}
@media(prefers-color-scheme:dark){body{background:#fff;color:#222}}
</style>)";

constexpr const char* known_wrong = R"(<h2>Published tables that are known to be wrong</h2>
<p>The cases named cie171 follow the geometry and the skies of CIE 171:2006; their values are computed here. The tables of
that report differ from them by at most 0.02 of a percent of the outdoor illuminance, but for these, where two independent
quadratures agree with each other and not with the report:</p>
<ul>
<li>places at the very edge of an opening as large as its wall: A under the roof of 4 m by 4 m (up to 6 %); A, C, D, F, N
and N' beside the facade of 4 m by 3 m (up to 9 %)</li>
<li>sky of type 13, place G, roof of 4 m by 4 m: a misprint</li>
<li>sky of type 14, facade of 4 m by 3 m: the row of the floor</li>
<li>table 19 (diffuse reflection), and the masks of 5.13 (1 m) and 5.14 (6 m and 9 m)</li>
</ul>)";

/// Deviation over what is allowed: above 1 the row fails.
double strain(const ValidationRow& row)
{
    constexpr double t_95 = 2.365;
    const double allowed = row.tolerance + 3 * row.half_width_95 / t_95;
    return allowed > 0 ? std::fabs(row.deviation()) / allowed : row.deviation() == 0 ? 0 : 10;
}

std::string family(const ValidationRow& row)
{
    const std::pair<const char*, const char*> families[] = {
        {"cl_", "closed forms"},  {"cie171_roof", "roof openings"}, {"cie171_facade", "facade openings"},
        {"cie171_mask", "masks"}, {"cie171_", "electric light"},    {"rad_", "rooms (radiosity)"},
        {"day_", "skies"}};
    for (const auto& [start, name] : families)
        if (row.case_id.starts_with(start))
            return name;
    return "others";
}

/// One series a family, in the order in which they are met.
template <class Place>
std::vector<ChartSeries> by_family(const std::vector<ValidationRow>& rows, const Place& place)
{
    std::vector<ChartSeries> series;
    for (const ValidationRow& row : rows) {
        const std::string name = family(row);
        auto found = std::find_if(series.begin(), series.end(), [&](const ChartSeries& s) { return s.name == name; });
        if (found == series.end())
            found = series.insert(series.end(), {name, {}, false});
        ChartPoint point = place(row);
        point.ringed = !row.passed;
        if (!row.passed)
            point.label = row.case_id;
        found->points.push_back(point);
    }
    return series;
}

Chart found_chart(const std::vector<ValidationRow>& rows)
{
    Chart chart;
    chart.title = "What the engine found against what is right";
    chart.x_label = "expected (each row in its own unit: lx, cd/m2, %)";
    chart.y_label = "found (same unit)";
    chart.log_x = chart.log_y = chart.diagonal = true;
    chart.note = "On the dashed line found and expected are the same. Ringed rows did not pass.";
    chart.series = by_family(rows, [](const ValidationRow& row) { return ChartPoint{row.expected, row.found, ""}; });
    return chart;
}

Chart strain_chart(const std::vector<ValidationRow>& rows)
{
    Chart chart;
    chart.title = "Deviation of every row, as a share of what is allowed";
    chart.x_label = "row of the table below (number)";
    chart.y_label = "deviation / allowed (1: the limit)";
    chart.note = "Allowed: the tolerance of the case and three standard errors. Ringed rows did not pass.";
    double number = 0;
    chart.series = by_family(rows, [&](const ValidationRow& row) {
        return ChartPoint{++number, std::min(2.0, strain(row)), ""};
    });
    chart.levels = {{1, "limit"}};
    return chart;
}

/// Relative error by place and sky: the largest of each case.
std::string sky_map(const std::vector<ValidationRow>& rows)
{
    std::map<std::string, std::map<std::string, const ValidationRow*>> cells;
    std::map<std::string, bool> skies;
    for (const ValidationRow& row : rows) {
        const std::size_t at = row.case_id.rfind("_sky");
        if (!row.case_id.starts_with("cie171_") || at == std::string::npos)
            continue;
        cells[row.case_id.substr(7, at - 7)][row.case_id.substr(at + 4)] = &row;
        skies[row.case_id.substr(at + 4)] = true;
    }
    if (cells.empty())
        return "";
    std::string text = "<h2>Daylight: deviation over allowed at the worst place, by opening and sky</h2>\n<div "
                       "class=\"wide\"><table><thead><tr><th>opening</th><th></th>";
    for (const auto& [sky, unused] : skies)
        text += "<th>" + escaped_markup(sky) + "</th>";
    text += "</tr></thead><tbody>\n";
    for (const auto& [opening, by_sky] : cells) {
        text += "<tr><td>" + escaped_markup(opening) + "</td><td></td>";
        for (const auto& [sky, unused] : skies) {
            const auto found = by_sky.find(sky);
            if (found == by_sky.end()) {
                text += "<td></td>";
                continue;
            }
            const double s = strain(*found->second);
            const int light = static_cast<int>(std::lround(255 - 110 * std::clamp(s, 0.0, 1.0)));
            text += fmt::format("<td style=\"background:rgb(255,{},{})\">{:.2f}</td>", light, light, s);
        }
        text += "</tr>\n";
    }
    return text + "</tbody></table></div>\n" + known_wrong;
}

std::string row_table(const std::vector<ValidationRow>& rows)
{
    std::string text =
        "<h2>Every row</h2>\n<div class=\"wide\"><table "
        "class=\"rows\"><thead><tr><th>case</th><th>quantity</th><th>expected"
        "</th><th>found</th><th>&plusmn; 95 %</th><th>unit</th><th>deviation</th><th>tolerance</th><th>of "
        "allowed</th><th>verdict</th></tr></thead><tbody>\n";
    const auto relative = [](double part, double whole) {
        return whole == 0 ? fmt::format("{:.2g}", part) : fmt::format("{:.3f} %", 100 * part / std::fabs(whole));
    };
    for (const ValidationRow& row : rows)
        text += fmt::format(
            "<tr{}><td>{}</td><td>{}{}</td><td>{:.7g}</td><td>{:.7g}</td><td>{:.2g}</td><td>{}</td><td>{}</"
            "td><td>{}</td><td>{:.2f}</td><td>{}</td></tr>\n",
            row.passed ? "" : " class=\"bad\"", escaped_markup(row.case_id), escaped_markup(row.quantity),
            row.detection ? " (detects 2 %)" : "", row.expected, row.found, row.half_width_95, escaped_markup(row.unit),
            relative(row.deviation(), row.expected), relative(row.tolerance, row.expected), strain(row),
            row.passed ? "passed" : "FAILED: " + escaped_markup(row.reason));
    return text + "</tbody></table></div>\n";
}

} // namespace

std::string validation_html(const std::vector<ValidationRow>& rows, const std::string& what)
{
    const auto passed = std::count_if(rows.begin(), rows.end(), [](const ValidationRow& row) { return row.passed; });
    double worst = 0;
    std::string where;
    for (const ValidationRow& row : rows)
        if (strain(row) > worst) {
            worst = strain(row);
            where = row.case_id + ", " + row.quantity;
        }
    std::string page = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
                       "content=\"width=device-width,initial-scale=1\"><title>Lightwell: validation</title><link "
                       "rel=\"icon\" href=\"data:,\">";
    page += style;
    page += fmt::format(
        "</head><body>\n<h1>Lightwell against numbers that do not come from it</h1>\n<p "
        "class=\"sum\"><b>{} of {} rows passed.</b> {}. The row nearest to its limit: {} of what is allowed "
        "({}).</p>\n",
        passed, rows.size(), escaped_markup(what), fmt::format("{:.0f} %", 100 * worst), escaped_markup(where));
    page +=
        "<p>Each row compares a value that the engine found with one recomputed from its formula. It passes when the "
        "deviation is at most the tolerance and three standard errors, and the standard error at most a third of the "
        "tolerance.</p>\n";
    for (const Chart& chart : {strain_chart(rows), found_chart(rows)})
        page += "<div class=\"wide\">" + chart_svg(chart) + "</div>\n";
    page += sky_map(rows);
    page += row_table(rows);
    return page + "</body></html>\n";
}

} // namespace lightwell
