#include "plugins/insight/explain.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace lightwell {

std::vector<double> whole_percentages(const std::vector<Share>& shares)
{
    // In tenths of a percent: rounded down, and the largest remainders up, until all are there.
    constexpr double tenths = 1000;
    double sum = 0;
    for (const Share& share : shares)
        sum += share.lux;
    std::vector<double> parts(shares.size(), 0);
    if (!(sum > 0))
        return parts;
    std::vector<std::size_t> order(shares.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto exact = [&](std::size_t i) { return tenths * shares[i].lux / sum; };
    double left = tenths;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        parts[i] = std::floor(exact(i));
        left -= parts[i];
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return exact(a) - std::floor(exact(a)) > exact(b) - std::floor(exact(b));
    });
    for (std::size_t k = 0; k < order.size() && left > 0.5; ++k, --left)
        parts[order[k]] += 1;
    for (double& part : parts)
        part /= 10;
    return parts;
}

namespace {

std::string table(const std::string& title, const std::vector<Share>& shares)
{
    std::size_t width = title.size();
    for (const Share& share : shares)
        width = std::max(width, share.name.size());
    std::string text = fmt::format("\n{:<{}}   share            lx   +- 95 %\n", title, width);
    const std::vector<double> percent = whole_percentages(shares);
    double sum = 0, lux = 0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        text += fmt::format("{:<{}}  {:>5.1f} %  {:>11.5g}  {:>7.2g}\n", shares[i].name, width, percent[i],
                            shares[i].lux, half_width_95(shares[i].standard_error));
        sum += percent[i];
        lux += shares[i].lux;
    }
    return text + fmt::format("{:<{}}  {:>5.1f} %  {:>11.5g}\n", "sum", width, sum, lux);
}

} // namespace

std::string explanation_text(const Explanation& explanation)
{
    const Sensor& s = explanation.sensor;
    std::string text =
        fmt::format("sensor at {:g},{:g},{:g} facing {:g},{:g},{:g}: {:.5g} lx +- {:.2g} (95 %), {} paths\n",
                    s.position.x, s.position.y, s.position.z, s.normal.x, s.normal.y, s.normal.z, explanation.lux,
                    half_width_95(explanation.standard_error), explanation.paths);
    text += table("source", explanation.sources);
    text += table("seen on layer", explanation.layers);
    text += table("reflections", explanation.bounces);
    std::size_t width = 9;
    for (const LayerEffect& effect : explanation.effects)
        width = std::max(width, effect.name.size());
    text += fmt::format("\n{:<{}}  reflectance  lx for +0.01   +- 95 %   of the whole\n", "layer", width);
    constexpr double step = 0.01;
    for (const LayerEffect& effect : explanation.effects)
        text += fmt::format("{:<{}}  {:>11.3f}  {:>+12.4g}  {:>8.2g}  {:>+11.3f} %\n", effect.name, width,
                            effect.reflectance, step * effect.lux_per_reflectance,
                            half_width_95(step * effect.standard_error),
                            explanation.lux > 0 ? 100 * step * effect.lux_per_reflectance / explanation.lux : 0);
    return text;
}

} // namespace lightwell
