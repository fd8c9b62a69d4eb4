#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lightwell {

/// How testing sources one after the other ended.
struct AdaptiveOutcome {
    std::size_t tested = 0;    ///< the first so many
    double found = 0;          ///< what they gave
    double most_remaining = 0; ///< what the others could give
    double success_ratio = 1;  ///< visible tests here over what the histories let expect
    double estimated = 0;      ///< what the others give, estimated
    /// Bound on the error of found + estimated.
    double doubt() const noexcept { return std::fmax(estimated, most_remaining - estimated); }
};

/// Share of an untested source that is taken to be visible.
/// @param history  share of the tests of this source that found it visible
inline double expected_visibility(double success_ratio, double history) noexcept
{
    return std::fmin(1, success_ratio * history);
}

/// Adaptive shadow testing: the most promising sources first, until what the others could add is a small share of
/// what was found; those are estimated from how often they were visible elsewhere.
/// @param potential  i -> what source i gives when nothing is in the way; falling
/// @param history    i -> share of earlier tests that found it visible
/// @param visible    i -> share of source i that a test finds visible here
/// @param threshold  share of what was found; 0: test all
/// @param certainty  [0, 1]: the next n^certainty untested sources are compared with the threshold
/// Error: biased towards the mean visibility, by at most doubt()
/// Source  Ward 1991, "Adaptive Shadow Testing"; Ward 1994, Section 3.3 and Figure 4
template <class Potential, class History, class Visible>
AdaptiveOutcome test_adaptively(std::size_t count, const Potential& potential, const History& history,
                                const Visible& visible, double threshold, double certainty)
{
    AdaptiveOutcome outcome;
    for (std::size_t i = 0; i < count; ++i)
        outcome.most_remaining += potential(i);
    const auto looked_at = static_cast<std::size_t>(std::pow(static_cast<double>(count), certainty) + 0.5);
    double window = 0; // of the next `looked_at` sources
    for (std::size_t i = 0; i < std::min(looked_at, count); ++i)
        window += potential(i);
    double successes = 0, expected = 0;
    while (outcome.tested < count && (threshold <= 0 || window > threshold * outcome.found)) {
        const std::size_t i = outcome.tested++;
        const double share = visible(i);
        outcome.found += share * potential(i);
        successes += share;
        expected += history(i);
        outcome.most_remaining -= potential(i);
        window += (i + looked_at < count ? potential(i + looked_at) : 0) - potential(i);
    }
    if (expected > 0)
        outcome.success_ratio = successes / expected;
    outcome.most_remaining = outcome.tested == count ? 0 : std::fmax(0, outcome.most_remaining);
    for (std::size_t i = outcome.tested; i < count; ++i)
        outcome.estimated += expected_visibility(outcome.success_ratio, history(i)) * potential(i);
    return outcome;
}

} // namespace lightwell
