#pragma once

#include <functional>
#include <string>

namespace lightwell {

/// How far a long call has come, and whether the caller wants it to stop.
struct Progress {
    /// Called now and then, from one thread at a time.  @param fraction in [0, 1]
    std::function<void(const std::string& stage, double fraction)> report = {};
    /// Asked often and from many threads; true stops the work with Cancelled after what is finished has been kept.
    std::function<bool()> cancelled = {};

    void tell(const std::string& stage, double fraction) const
    {
        if (report)
            report(stage, fraction);
    }
    bool stop() const { return cancelled && cancelled(); }
};

} // namespace lightwell
