#include "plugins/insight/child_run.h"

#include "engine/base/errors.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <sstream>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace lightwell {
namespace {

constexpr int cannot_start = 127;

/// In the child, where another thread may have held a lock: nothing here allocates.
/// @param err  open for writing
[[noreturn]] void become(char* const* arguments, const char* input, const char* output, int err, rlim_t seconds)
{
    const int in = open(input, O_RDONLY);
    const int out = open(output, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (in < 0 || out < 0)
        _exit(cannot_start);
    dup2(in, STDIN_FILENO);
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    const rlimit limit{seconds, seconds + 1};
    setrlimit(RLIMIT_CPU, &limit);
    execvp(arguments[0], arguments);
    _exit(cannot_start);
}

/// The last line of a file that has text in it, cut to what a table can hold.
std::string last_line(int file)
{
    constexpr off_t most_read = 4096;
    constexpr std::size_t most_shown = 200;
    char text[most_read];
    const off_t size = lseek(file, 0, SEEK_END), from = std::max<off_t>(0, size - most_read);
    const ssize_t count = size > 0 ? pread(file, text, most_read, from) : 0;
    std::istringstream lines(std::string(text, static_cast<std::size_t>(std::max<ssize_t>(0, count))));
    std::string last;
    for (std::string line; std::getline(lines, line);)
        if (line.find_first_not_of(" \t\r") != std::string::npos)
            last = line;
    return last.substr(0, most_shown);
}

double seconds_of(const timeval& t)
{
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

} // namespace

std::filesystem::path program_on_path(const std::string& name)
{
    const char* path = std::getenv("PATH");
    std::istringstream folders(path != nullptr ? path : "");
    std::string folder;
    while (std::getline(folders, folder, ':')) {
        const std::filesystem::path file = std::filesystem::path(folder) / name;
        std::error_code ignored;
        if (std::filesystem::is_regular_file(file, ignored) && access(file.c_str(), X_OK) == 0)
            return file;
    }
    return {};
}

ChildResult run_child(const std::vector<std::string>& words, const std::filesystem::path& input,
                      const std::filesystem::path& output, double most_cpu_s)
{
    constexpr double wall_over_cpu = 10;
    const auto start = std::chrono::steady_clock::now();
    std::vector<char*> arguments;
    for (const std::string& word : words)
        arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const std::string from = input.empty() ? "/dev/null" : input.string();
    const std::string to = output.empty() ? "/dev/null" : output.string();
    const int words_file = memfd_create("error output", 0);
    const pid_t child = words_file < 0 ? -1 : fork();
    if (child < 0)
        throw InputError{words[0], "cannot be started", "is there memory left for another process?"};
    if (child == 0)
        become(arguments.data(), from.c_str(), to.c_str(), words_file, static_cast<rlim_t>(most_cpu_s) + 1);
    ChildResult result;
    rusage used{};
    int status = 0;
    const auto elapsed = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    while (wait4(child, &status, WNOHANG, &used) == 0) {
        if (elapsed() > wall_over_cpu * most_cpu_s) {
            kill(child, SIGKILL);
            result.timed_out = true;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    result.wall_s = elapsed();
    result.cpu_s = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
    result.status = WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
    // A program may catch the limit's signal and exit; a kill is the limit's last step, but also the system's when
    // memory runs out: the time tells them apart.
    result.timed_out = result.timed_out || (result.status != 0 && result.cpu_s >= most_cpu_s);
    result.last_words = last_line(words_file);
    close(words_file);
    return result;
}

} // namespace lightwell
