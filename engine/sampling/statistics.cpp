#include "engine/sampling/statistics.h"

#include "engine/base/vector.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

/// Continued fraction of the incomplete beta function.  Source  Abramowitz, Stegun 26.5.8, by Lentz's method
double beta_fraction(double a, double b, double x)
{
    constexpr double tiny = 1e-300; // keeps a vanishing partial denominator from dividing by zero
    double c = 1, d = 1 / std::max(std::fabs(1 - (a + b) * x / (a + 1)), tiny), value = d;
    for (int m = 1; m < 500; ++m) {
        const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
        d = 1 / (1 + even * d);
        c = 1 + even / c;
        value *= d * c;
        const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
        d = 1 / (1 + odd * d);
        c = 1 + odd / c;
        value *= d * c;
        if (std::fabs(d * c - 1) < 1e-15)
            break;
    }
    return value;
}

double incomplete_beta(double a, double b, double x)
{
    if (x <= 0 || x >= 1)
        return x <= 0 ? 0 : 1;
    const double front =
        std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x));
    if (x < (a + 1) / (a + b + 2))
        return front * beta_fraction(a, b, x) / a;
    return 1 - front * beta_fraction(b, a, 1 - x) / b;
}

/// Probability that Student's t exceeds a value >= 0.
double student_t_tail(double value, double degrees)
{
    return 0.5 * incomplete_beta(degrees / 2, 0.5, degrees / (degrees + value * value));
}

double gamma_series(double a, double x)
{
    double term = 1 / a, sum = term;
    for (int n = 1; n < 10000 && term > sum * 1e-16; ++n)
        sum += term *= x / (a + n);
    return sum;
}

double gamma_fraction(double a, double x)
{
    double b = x + 1 - a, c = 1e300, d = 1 / b, value = d;
    for (int n = 1; n < 10000; ++n) {
        const double step = -n * (n - a);
        b += 2;
        d = 1 / (step * d + b);
        c = b + step / c;
        value *= d * c;
        if (std::fabs(d * c - 1) < 1e-15)
            break;
    }
    return value;
}

} // namespace

void RunningStatistics::add(double value) noexcept
{
    ++count_;
    const double before = value - mean_;
    mean_ += before / static_cast<double>(count_);
    squares_ += before * (value - mean_);
}

void RunningStatistics::merge(const RunningStatistics& other) noexcept
{
    if (other.count_ == 0)
        return;
    const double n = static_cast<double>(count_), m = static_cast<double>(other.count_);
    const double apart = other.mean_ - mean_;
    count_ += other.count_;
    mean_ += apart * (m / (n + m));
    squares_ += other.squares_ + apart * apart * (n * m / (n + m));
}

double RunningStatistics::variance() const noexcept
{
    return count_ < 2 ? 0 : squares_ / static_cast<double>(count_ - 1);
}

double RunningStatistics::standard_error() const noexcept
{
    return count_ < 2 ? 0 : std::sqrt(variance() / static_cast<double>(count_));
}

Estimate estimate_of(const RunningStatistics& statistics) noexcept
{
    return {statistics.mean(), statistics.standard_error()};
}

double normal_quantile(double probability) noexcept
{
    if (!(probability > 0 && probability < 1))
        return probability >= 1 ? infinity : -infinity;
    if (probability > 0.5)
        return -normal_quantile(1 - probability);
    double low = -39, high = 0; // erfc underflows below -39
    const auto below = [](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); };
    for (int step = 0; step < 60; ++step) {
        const double middle = (low + high) / 2;
        (below(middle) < probability ? low : high) = middle;
    }
    return (low + high) / 2;
}

double student_t_quantile(double probability, double degrees) noexcept
{
    if (!(probability > 0 && probability < 1))
        return probability >= 1 ? infinity : -infinity;
    if (probability < 0.5)
        return -student_t_quantile(1 - probability, degrees);
    const double tail = 1 - probability;
    double low = 0, high = 1;
    while (student_t_tail(high, degrees) > tail && high < 1e300)
        high *= 2;
    for (int step = 0; step < 200 && high - low > 1e-13 * high; ++step) {
        const double middle = (low + high) / 2;
        (student_t_tail(middle, degrees) > tail ? low : high) = middle;
    }
    return (low + high) / 2;
}

double confidence_half_width(const RunningStatistics& statistics, double confidence) noexcept
{
    if (statistics.count() < 2)
        return infinity;
    const double degrees = static_cast<double>(statistics.count() - 1);
    return student_t_quantile((1 + confidence) / 2, degrees) * statistics.standard_error();
}

bool agrees(const Estimate& found, double expected, double false_alarm) noexcept
{
    // Sums of many terms carry rounding even when all terms are equal.
    constexpr double rounding = 1e-12;
    const double slack = rounding * std::max(std::fabs(found.value), std::fabs(expected));
    return std::fabs(found.value - expected) <= -normal_quantile(false_alarm / 2) * found.standard_error + slack;
}

double chi_square_survival(double value, double degrees) noexcept
{
    const double a = degrees / 2, x = value / 2;
    if (!(x > 0))
        return 1;
    const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
    return x < a + 1 ? 1 - front * gamma_series(a, x) : front * gamma_fraction(a, x);
}

double chi_square_probability(const std::vector<double>& found, const std::vector<double>& expected, double least)
{
    struct Cell {
        double found = 0, expected = 0;
    };
    std::vector<Cell> cells(1);
    for (std::size_t i = 0; i < expected.size(); ++i) {
        if (cells.back().expected >= least)
            cells.emplace_back();
        cells.back().found += found[i];
        cells.back().expected += expected[i];
    }
    if (cells.size() > 1 && cells.back().expected < least) {
        const Cell rest = cells.back();
        cells.pop_back();
        cells.back().found += rest.found;
        cells.back().expected += rest.expected;
    }
    if (cells.size() < 2)
        return cells.back().expected > 0 || cells.back().found == 0 ? 1 : 0;
    double statistic = 0;
    for (const Cell& cell : cells)
        statistic += (cell.found - cell.expected) * (cell.found - cell.expected) / cell.expected;
    return chi_square_survival(statistic, static_cast<double>(cells.size() - 1));
}

} // namespace lightwell
