#pragma once

#include "engine/base/progress.h"

#include <chrono>
#include <optional>
#include <string>

namespace lightwell {

/// From its making on, Ctrl-C (SIGINT) and SIGTERM ask the work to stop; a second one ends the program at once.
void catch_interrupts();
bool interrupted() noexcept;

/// How long a stage will still take, from how fast it has gone since it began.
class StageTime {
public:
    /// @return nothing as long as nothing is done
    std::optional<double> left_s(const std::string& stage, double fraction);

private:
    std::string stage_;
    double start_fraction_ = 0; ///< tiles of an earlier run count as done, not as fast
    std::chrono::steady_clock::time_point start_{};
};

/// Progress on stderr: one line that renews itself, with the time left, on a terminal; else a line every 10 s.
class ProgressLine {
public:
    /// @param title  what is being made, for instance the name of the view
    explicit ProgressLine(std::string title);
    /// Removes the line from the terminal.
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// Callbacks for the library; valid while this object lives.
    Progress progress();
    /// Last fraction reported, [0, 1].
    double fraction() const { return fraction_; }

private:
    using Clock = std::chrono::steady_clock;
    void show(const std::string& stage, double fraction);

    std::string title_;
    bool terminal_;
    bool shown_ = false;
    double fraction_ = 0;
    StageTime time_;
    Clock::time_point last_;
};

/// "4.2 s", "42 s", "3 min 05 s", "2 h 10 min".
std::string duration_text(double seconds);

} // namespace lightwell
