#pragma once

#include "engine/base/progress.h"

#include <map>
#include <string>

namespace lightwell {

/// CPU time by stage, told apart by what a run says of its progress. What lies between two reports counts for the
/// stage of the earlier one.
class StageClock {
public:
    /// @param outer  also told
    explicit StageClock(const Progress& outer);
    StageClock(const StageClock&) = delete;
    StageClock& operator=(const StageClock&) = delete;

    /// For the run; valid while this object lives.
    Progress progress();
    /// To be called when the run has ended.
    void stop();
    /// Of all stages whose name begins so.
    double seconds(const std::string& beginning) const;
    double total() const;

private:
    void count();

    const Progress& outer_;
    std::map<std::string, double> seconds_;
    std::string stage_;
    double last_;
};

} // namespace lightwell
