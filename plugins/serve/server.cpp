#include "plugins/serve/server.h"

#include "engine/base/text.h"
#include "plugins/cli/terminal.h"
#include "plugins/serve/session.h"

#include <algorithm>
#include <cerrno>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <new>
#include <poll.h>
#include <thread>
#include <unistd.h>

namespace lightwell::serve {
namespace {

/// A longer line is no request: a host that has gone astray must not fill the memory.
constexpr std::size_t longest_line = std::size_t{1} << 24;
/// How often it is looked whether the host still reads.
constexpr int look_ms = 200;
/// Work that has not stopped by then when the host is gone is ended with the process; results are written under other
/// names and renamed, so that no half ones stay.
constexpr std::chrono::seconds patience{5};

/// Requests in their order, done one after the other by a thread of its own.
class Worker {
public:
    explicit Worker(Events& events) : events_(events), thread_([this] { run(); }) {}
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    void add(Request request)
    {
        const std::lock_guard lock(mutex_);
        waiting_.push_back(std::move(request));
        changed_.notify_all();
    }

    /// Stops the request that runs, or takes one that waits out of the queue. @return false when there is none
    bool cancel(std::int64_t id)
    {
        const std::lock_guard lock(mutex_);
        if (running_ && running_->id == id) {
            stop_ = true;
            // Making a scene ready cannot be interrupted: it ends by itself, unheard.
            const bool reading = running_->task == Request::Task::load || running_->task == Request::Task::edit;
            if (reading)
                events_.cancelled_for_good(id);
            return true;
        }
        const auto found =
            std::find_if(waiting_.begin(), waiting_.end(), [&](const Request& request) { return request.id == id; });
        if (found == waiting_.end())
            return false;
        waiting_.erase(found);
        events_.cancelled(id);
        return true;
    }

    /// Stops everything. @return false when it does not stop in time
    bool finish()
    {
        {
            std::unique_lock lock(mutex_);
            waiting_.clear();
            ending_ = stop_ = true;
            changed_.notify_all();
            if (!changed_.wait_for(lock, patience, [this] { return ended_; })) {
                thread_.detach();
                return false;
            }
        }
        thread_.join();
        return true;
    }

private:
    void run()
    {
        std::unique_lock lock(mutex_);
        while (!ending_) {
            if (waiting_.empty()) {
                changed_.wait(lock);
                continue;
            }
            running_ = std::move(waiting_.front());
            waiting_.pop_front();
            stop_ = false;
            lock.unlock();
            run(*running_);
            lock.lock();
            running_.reset();
        }
        ended_ = true;
        changed_.notify_all();
    }

    void run(const Request& request)
    {
        try {
            Told told(events_, request.id, stop_);
            session_.run(request, told);
        } catch (const Cancelled&) {
            events_.cancelled(request.id);
        } catch (const InputError& error) {
            events_.error(request.id, to_utf8(error.what()));
        } catch (const std::bad_alloc&) {
            events_.error(request.id, "out of memory; use a smaller picture or fewer objects");
        } catch (const std::exception& error) {
            events_.error(request.id, std::string("internal error: ") + to_utf8(error.what()));
        }
    }

    Events& events_;
    Session session_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Request> waiting_;
    std::optional<Request> running_;
    std::atomic<bool> stop_ = false;
    bool ending_ = false, ended_ = false;
    std::thread thread_; ///< last: it uses all of the above
};

/// Lines from a pipe.
class Lines {
public:
    explicit Lines(int descriptor) : descriptor_(descriptor) {}

    enum class Next { line, too_long, nothing_yet, end };
    Next next(std::string& line)
    {
        if (take(line)) {
            const bool whole = !overlong_;
            overlong_ = false;
            return whole ? Next::line : Next::too_long;
        }
        pollfd waiting{descriptor_, POLLIN, 0};
        if (poll(&waiting, 1, look_ms) <= 0)
            return Next::nothing_yet;
        char buffer[1 << 16];
        const ssize_t count = read(descriptor_, buffer, sizeof buffer);
        if (count <= 0)
            return count < 0 && (errno == EINTR || errno == EAGAIN) ? Next::nothing_yet : Next::end;
        pending_.append(buffer, static_cast<std::size_t>(count));
        return Next::nothing_yet;
    }

private:
    bool take(std::string& line)
    {
        const std::size_t end = pending_.find('\n', searched_);
        searched_ = end == std::string::npos ? pending_.size() : 0;
        if (end == std::string::npos) {
            if (pending_.size() > longest_line) {
                overlong_ = true;
                pending_.clear();
                searched_ = 0;
            }
            return false;
        }
        line = pending_.substr(0, end);
        pending_.erase(0, end + 1);
        return true;
    }

    int descriptor_;
    std::string pending_;
    std::size_t searched_ = 0;
    bool overlong_ = false; ///< the line at hand has lost its beginning
};

/// @return false when the host wants to end
bool answer_line(const std::string& line, Worker& worker, Events& events)
{
    if (trimmed(line).empty())
        return true;
    try {
        Request request = parse_request(line);
        if (request.task == Request::Task::quit) {
            events.result(request.id, "quit", "");
            return false;
        }
        if (request.task != Request::Task::cancel)
            worker.add(std::move(request));
        else if (worker.cancel(request.target))
            events.result(request.id, "cancel", "\"target\":" + std::to_string(request.target));
        else
            throw BadRequest{request.id,
                             "request " + std::to_string(request.target) + " is neither running nor waiting", ""};
    } catch (const BadRequest& bad) {
        events.error(bad);
    }
    return true;
}

} // namespace

void answer(int requests, int answers)
{
    std::signal(SIGPIPE, SIG_IGN); // a host that is gone shows as an error of write()
    Events events(answers);
    events.hello();
    Worker worker(events);
    Lines lines(requests);
    std::string line;
    for (bool going_on = true; going_on && !events.broken() && !interrupted();) {
        const Lines::Next next = lines.next(line);
        if (next == Lines::Next::line)
            going_on = answer_line(line, worker, events);
        else if (next == Lines::Next::too_long)
            events.error({std::nullopt, "a line is longer than 16 MB", "put long data into files"});
        else if (next == Lines::Next::end)
            break;
    }
    if (!worker.finish())
        std::_Exit(0);
}

} // namespace lightwell::serve
