#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace lightwell {

/// The standard error is itself known to a quarter only: aims lower than is asked.
inline constexpr double refinement_aim = 0.8;

struct MeasuredValue {
    double value, error;
};

/// A number to be found, and how well.
struct WantedQuantity {
    double expected, tolerance, wanted;
    MeasuredValue found{0, std::numeric_limits<double>::infinity()};
    bool known = false;
    double allowed() const { return tolerance + 3 * found.error; }
    /// 1 and more: does not agree.
    double strain() const { return std::fabs(found.value - expected) / allowed(); }
};

/// How much work, as its square root makes the error fall: samples or, where the engine is run as it is used, the
/// accuracy asked for to the power of -2.
struct WorkRange {
    double pilot = 0; ///< the first look
    double least = 0; ///< for a value that is kept
    double most = 0;
    double samples_per_error = 0; ///< samples grow as the error wanted to this power
    bool together = false;        ///< one run for all: each makes ambient light ready anew
};

/// Measures some of the quantities, by number, with this much work; samples of no run may be those of another.
using MeasureSome = std::function<std::vector<MeasuredValue>(const std::vector<std::size_t>& which, double work)>;

/// Finds each quantity with an error as small as is wanted, or by the most work.
///
/// A run whose samples missed rare light has a small value and a small error: one that is kept because its error is
/// small is too dark on average. So pilots tell how many samples are needed, the one that asks for most has the word,
/// and the value is that of a later run with samples of its own. Only where that comes out too noisy it becomes a
/// pilot as well.
void refine_by(const MeasureSome& measure, const WorkRange& range, std::vector<WantedQuantity>& quantities);

} // namespace lightwell
