#pragma once

#include "engine/base/progress.h"

#include <chrono>
#include <string>

namespace lightwell {

/// From its making on, Ctrl-C (SIGINT) and SIGTERM ask the work to stop; a second one ends the program at once.
void catch_interrupts();
bool interrupted() noexcept;

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

    std::string title_, stage_;
    bool terminal_;
    bool shown_ = false;
    double fraction_ = 0;
    double stage_start_fraction_ = 0;
    Clock::time_point stage_start_, last_;
};

/// "4.2 s", "42 s", "3 min 05 s", "2 h 10 min".
std::string duration_text(double seconds);

} // namespace lightwell
