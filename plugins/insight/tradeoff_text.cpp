#include "plugins/insight/tradeoff.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace lightwell {
namespace {

std::string chosen_text(const TradePoint& point)
{
    std::string text;
    for (const double wanted : point.chosen_for)
        text += fmt::format("{}{:g} %", text.empty() ? "" : " ", 100 * wanted);
    return text;
}

/// What a line below the plot has room for: long names lose their middle.
std::string shortened(const std::string& text)
{
    constexpr std::size_t most = 44, part = 20;
    return text.size() <= most ? text : text.substr(0, part) + " ... " + text.substr(text.size() - part);
}

/// A field of CSV.
std::string quoted(const std::string& text)
{
    if (text.find_first_of(",\"\n") == std::string::npos)
        return text;
    std::string field = "\"";
    for (const char c : text)
        field += c == '"' ? "\"\"" : std::string(1, c);
    return field + "\"";
}

} // namespace

std::string tradeoff_csv(const Tradeoff& tradeoff)
{
    std::string text = "program,setting,without,cpu_s,wall_s,rms_relative,mean_bias_relative,percentile95_relative,"
                       "max_relative,chosen_for,failure\n";
    for (const TradePoint& p : tradeoff.points) {
        text += fmt::format("{},{},{},{:.4g},{:.4g},", p.program, p.setting, p.without, p.cpu_s, p.wall_s);
        if (p.failure.empty())
            text += fmt::format("{:.5g},{:.5g},{:.5g},{:.5g},", p.error.rms, p.error.mean_bias, p.error.percentile_95,
                                p.error.maximum);
        else
            text += ",,,,";
        text += fmt::format("{},{}\n", chosen_text(p), quoted(p.failure));
    }
    return text + fmt::format("reference,unbiased {} samples,,{:.4g},,{:.5g},,,,,\n", tradeoff.reference.samples,
                              tradeoff.reference.cpu_s, tradeoff.reference.residual);
}

std::string tradeoff_text(const Tradeoff& tradeoff)
{
    std::string text =
        fmt::format("{}: reference by {} unbiased samples each in {:.3g} CPU s, residual {:.2g} %\n", tradeoff.of,
                    tradeoff.reference.samples, tradeoff.reference.cpu_s, 100 * tradeoff.reference.residual);
    text += fmt::format("{:<16}  {:<8}  {:<12}  {:>8}  {:>8}  {:>8}  {:>8}  {:>8}  {:>8}  chosen for\n", "program",
                        "setting", "without", "CPU s", "wall s", "RMS", "bias", "95 %", "max");
    for (const TradePoint& p : tradeoff.points) {
        text += fmt::format("{:<16}  {:<8}  {:<12}  ", p.program, p.setting, p.without);
        if (!p.failure.empty()) {
            text += p.failure + "\n";
            continue;
        }
        text += fmt::format("{:>8.3g}  {:>8.3g}  {:>6.2f} %  {:>+6.2f} %  {:>6.2f} %  {:>6.1f} %  {}\n", p.cpu_s,
                            p.wall_s, 100 * p.error.rms, 100 * p.error.mean_bias, 100 * p.error.percentile_95,
                            100 * p.error.maximum, chosen_text(p));
    }
    return text;
}

Chart tradeoff_chart(const Tradeoff& tradeoff, const std::string& title)
{
    Chart chart;
    chart.title = title;
    chart.x_label = "CPU time (s)";
    chart.y_label = "RMS error, relative (%)";
    chart.log_x = chart.log_y = true;
    chart.note = fmt::format("Ringed: the cheapest setting for the error beside it. {}.", shortened(tradeoff.of));
    ChartSeries own{"Lightwell", {}, true}, without{"one technique off", {}, false};
    std::vector<ChartSeries> others;
    for (const TradePoint& p : tradeoff.points) {
        if (!p.failure.empty())
            continue;
        ChartPoint point{p.cpu_s, 100 * p.error.rms, "", !p.chosen_for.empty()};
        if (p.program != own.name) {
            if (others.empty() || others.back().name != p.program)
                others.push_back({p.program, {}, true});
            point.label = p.setting;
            others.back().points.push_back(point);
        } else if (p.without.empty()) {
            point.label = chosen_text(p);
            own.points.push_back(point);
        } else {
            without.points.push_back(point);
        }
    }
    // Only what a technique changes much is named: the others lie where the setting itself lies.
    for (ChartPoint& point : without.points)
        for (const TradePoint& p : tradeoff.points)
            if (!p.without.empty() && p.cpu_s == point.x) {
                const auto whole =
                    std::find_if(tradeoff.points.begin(), tradeoff.points.end(), [&](const TradePoint& q) {
                        return q.program == p.program && q.without.empty() && q.setting == p.setting;
                    });
                constexpr double much = 1.5;
                const double dearer = whole == tradeoff.points.end() ? 1 : p.cpu_s / whole->cpu_s;
                const double worse = whole == tradeoff.points.end() ? 1 : p.error.rms / whole->error.rms;
                if (std::max({dearer, 1 / dearer, worse, 1 / worse}) > much)
                    point.label = "no " + p.without;
            }
    chart.series = {own, without};
    chart.series.insert(chart.series.end(), others.begin(), others.end());
    chart.levels = {{100 * tradeoff.reference.residual, "residual error of the reference"}};
    return chart;
}

} // namespace lightwell
