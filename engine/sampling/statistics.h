#pragma once

#include <cstddef>
#include <vector>

namespace lightwell {

/// Mean and variance of numbers as they come, without keeping them.
/// Merging in a fixed order gives the same bits, whoever computed the parts.
/// Source  Welford 1962; Chan, Golub, LeVeque 1979 (merging)
class RunningStatistics {
public:
    void add(double value) noexcept;
    void merge(const RunningStatistics& other) noexcept;
    std::size_t count() const noexcept { return count_; }
    double mean() const noexcept { return mean_; }
    /// Of the numbers, unbiased; 0 below two numbers.
    double variance() const noexcept;
    /// Of the mean, for independent numbers.
    double standard_error() const noexcept;

private:
    std::size_t count_ = 0;
    double mean_ = 0;
    double squares_ = 0; ///< sum of squared deviations from the mean
};

/// A mean with its standard error.
struct Estimate {
    double value = 0;
    double standard_error = 0;
};
Estimate estimate_of(const RunningStatistics& statistics) noexcept;

/// x such that a standard normal variable lies below it with this probability, (0, 1).
/// Error: absolute 1e-12; by bisection of erfc.
double normal_quantile(double probability) noexcept;
/// The same for Student's t.
/// @param degrees  of freedom, >= 1
double student_t_quantile(double probability, double degrees) noexcept;
/// Half width of the two-sided interval: quantile times standard error.
/// @param confidence  (0, 1), for example 0.95
double confidence_half_width(const RunningStatistics& statistics, double confidence) noexcept;

/// True unless the estimate lies so far from `expected` that chance explains it with less than `false_alarm`.
bool agrees(const Estimate& found, double expected, double false_alarm = 1e-6) noexcept;

/// Probability that chi-square with these degrees of freedom exceeds the value.
/// Source  Abramowitz, Stegun 6.5 (series and continued fraction of the incomplete gamma function)
double chi_square_survival(double value, double degrees) noexcept;
/// Pearson's test of counts against expected counts; cells are pooled until each expects at least `least`.
/// @return  probability of counts at least as far from the expected ones
double chi_square_probability(const std::vector<double>& found, const std::vector<double>& expected, double least = 10);

} // namespace lightwell
