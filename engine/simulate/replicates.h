#pragma once

#include <cmath>

namespace lightwell {

/// Independently scrambled runs behind each value: their spread gives the standard error, since samples within one
/// low-discrepancy run are not independent.
inline constexpr int replicates = 8;

/// Mean and standard error of the mean over the replicates.
class ReplicateMean {
public:
    void add(double replicate) noexcept
    {
        ++count_;
        const double before = replicate - mean_;
        mean_ += before / count_;
        squares_ += before * (replicate - mean_);
    }
    double mean() const noexcept { return mean_; }
    double standard_error() const noexcept { return count_ > 1 ? std::sqrt(squares_ / (count_ - 1) / count_) : 0; }

private:
    int count_ = 0;
    double mean_ = 0, squares_ = 0;
};

/// Samples that bring a median relative error found with `pilot` samples down to `wanted`, a multiple of the
/// replicates within [replicates, most].
int samples_for(double found, int pilot, double wanted, int most) noexcept;

} // namespace lightwell
