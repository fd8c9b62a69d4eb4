#pragma once

#include "engine/base/errors.h"
#include "engine/base/progress.h"
#include "plugins/cli/terminal.h"
#include "plugins/serve/request.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace lightwell::serve {

/// Lines to the host, whole and one after the other, from any thread.
class Events {
public:
    /// @param descriptor  of the pipe to the host
    explicit Events(int descriptor) : descriptor_(descriptor) {}
    Events(const Events&) = delete;
    Events& operator=(const Events&) = delete;

    void hello();
    void progress(std::int64_t id, double fraction, const std::string& phase, std::optional<double> seconds_left);
    /// A whole picture, better than the one before, is in the file.
    void partial(std::int64_t id, const std::string& file, int samples, double error);
    /// @param more  further members of the object as JSON, without its braces; may be empty
    void result(std::int64_t id, const std::string& kind, const std::string& more);
    void cancelled(std::int64_t id);
    /// The same as the last word of a request that cannot be interrupted: what it says afterwards is not told.
    void cancelled_for_good(std::int64_t id);
    void error(const BadRequest& bad);
    /// The sentence of an error, and its parts as far as they can be told: file, line, object, layer, way out.
    void error(std::int64_t id, const std::string& sentence);

    /// The host no longer reads.
    bool broken() const noexcept { return broken_; }

private:
    void line(std::optional<std::int64_t> id, const std::string& text);
    void write(const std::string& line);

    int descriptor_;
    std::mutex mutex_;
    std::optional<std::int64_t> silent_; ///< id that has had its last word
    std::atomic<bool> broken_ = false;
};

/// Progress of one request as one fraction that only grows, at most ten times a second, and the wish to stop it.
class Told {
public:
    Told(Events& events, std::int64_t id, const std::atomic<bool>& stop) : events_(events), id_(id), stop_(stop) {}
    Told(const Told&) = delete;
    Told& operator=(const Told&) = delete;

    /// For one run that is the part from `begin` to `end` of the whole.
    Progress part(double begin = 0, double end = 1);
    void check() const
    {
        if (stop_)
            throw Cancelled{};
    }
    Events& events() noexcept { return events_; }
    std::int64_t id() const noexcept { return id_; }

private:
    void tell(const std::string& stage, double fraction, double begin, double end);

    Events& events_;
    std::int64_t id_;
    const std::atomic<bool>& stop_;
    StageTime time_;
    double fraction_ = 0;
    std::chrono::steady_clock::time_point last_{};
};

} // namespace lightwell::serve
