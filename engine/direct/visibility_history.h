#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lightwell {

/// How often each source was tested and found visible. Whole numbers, so that sums do not depend on their order:
/// each thread keeps its own and they are added in the end.
class VisibilityCounts {
public:
    VisibilityCounts() = default;
    explicit VisibilityCounts(std::size_t sources) : tested_(sources), visible_(sources) {}
    /// @param share  [0, 1], visible part of the source
    void record(std::size_t source, double share) noexcept
    {
        ++tested_[source];
        visible_[source] += static_cast<std::uint64_t>(std::lround(share * whole));
    }
    void add(const VisibilityCounts& other) noexcept
    {
        for (std::size_t i = 0; i < tested_.size(); ++i) {
            tested_[i] += other.tested_[i];
            visible_[i] += other.visible_[i];
        }
    }
    std::size_t sources() const noexcept { return tested_.size(); }
    std::uint64_t tested(std::size_t source) const noexcept { return tested_[source]; }
    /// Visible tests, partly visible ones in part.
    double visible(std::size_t source) const noexcept { return static_cast<double>(visible_[source]) / whole; }

private:
    static constexpr double whole = 256; ///< steps in which a visible part is counted
    std::vector<std::uint64_t> tested_, visible_;
};

/// The share of tests that found each source visible: frozen while a generation of points is gathered, so that the
/// order of the points and the number of threads do not matter.
class VisibilityHistory {
public:
    VisibilityHistory() = default;
    explicit VisibilityHistory(const VisibilityCounts& counts)
    {
        for (std::size_t i = 0; i < counts.sources(); ++i) {
            const auto tested = static_cast<double>(counts.tested(i));
            rate_.push_back(static_cast<float>((counts.visible(i) + 1) / (tested + 1)));
        }
    }
    /// 1 for a source that was never tested: nothing is known in its way.
    double rate(std::size_t source) const noexcept { return source < rate_.size() ? rate_[source] : 1; }

private:
    std::vector<float> rate_;
};

} // namespace lightwell
