#include "plugins/cli/terminal.h"

#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <unistd.h>

namespace lightwell {
namespace {

std::atomic<bool> stop_asked = false;
static_assert(std::atomic<bool>::is_always_lock_free, "the signal handler may only touch lock-free data");

extern "C" void ask_to_stop(int)
{
    stop_asked = true;
}

constexpr std::chrono::milliseconds terminal_interval{100};
constexpr std::chrono::seconds log_interval{10};

} // namespace

void catch_interrupts()
{
    struct sigaction action = {};
    action.sa_handler = ask_to_stop;
    action.sa_flags = static_cast<int>(SA_RESETHAND); // the second signal has its usual effect
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() noexcept
{
    return stop_asked;
}

std::string duration_text(double seconds)
{
    const long whole = std::lround(std::fmax(0, seconds));
    char text[48];
    if (seconds < 9.95)
        std::snprintf(text, sizeof text, "%.1f s", std::fmax(0, seconds));
    else if (whole < 60)
        std::snprintf(text, sizeof text, "%ld s", whole);
    else if (whole < 3600)
        std::snprintf(text, sizeof text, "%ld min %02ld s", whole / 60, whole % 60);
    else
        std::snprintf(text, sizeof text, "%ld h %02ld min", whole / 3600, whole / 60 % 60);
    return text;
}

ProgressLine::ProgressLine(std::string title)
    : title_(std::move(title)), terminal_(isatty(STDERR_FILENO) == 1), last_(Clock::now())
{
}

ProgressLine::~ProgressLine()
{
    if (terminal_ && shown_)
        std::fputs("\r\033[K", stderr);
}

std::optional<double> StageTime::left_s(const std::string& stage, double fraction)
{
    const auto now = std::chrono::steady_clock::now();
    if (stage != stage_) {
        stage_ = stage;
        start_ = now;
        start_fraction_ = fraction;
    }
    const double passed = std::chrono::duration<double>(now - start_).count(), done = fraction - start_fraction_;
    return done > 0 ? std::optional(passed / done * (1 - fraction)) : std::nullopt;
}

Progress ProgressLine::progress()
{
    return {[this](const std::string& stage, double fraction) { show(stage, fraction); }, [] { return interrupted(); }};
}

void ProgressLine::show(const std::string& stage, double fraction)
{
    const Clock::time_point now = Clock::now();
    fraction_ = fraction;
    const std::optional<double> left_s = time_.left_s(stage, fraction);
    if (now - last_ < (terminal_ ? Clock::duration(terminal_interval) : Clock::duration(log_interval)))
        return;
    last_ = now;
    shown_ = true;
    const std::string left = left_s ? ", " + duration_text(*left_s) + " left" : "";
    std::fprintf(stderr, terminal_ ? "\r\033[K%s: %s %3.0f %%%s" : "%s: %s %.0f %%%s\n", title_.c_str(), stage.c_str(),
                 fraction * 100, left.c_str());
    std::fflush(stderr);
}

} // namespace lightwell
