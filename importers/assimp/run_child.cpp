#include "importers/assimp/run_child.h"

#include "engine/base/errors.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <vector>

extern char** environ;

namespace lightwell {
namespace {

constexpr const char* program_name = "lightwell-import-assimp";
constexpr int answer_descriptor = 3;
constexpr unsigned long long megabyte = 1'000'000;

/// A descriptor that is closed with the object.
class Descriptor {
public:
    explicit Descriptor(int number = -1) : number_(number) {}
    ~Descriptor() { close(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int number() const { return number_; }
    void close()
    {
        if (number_ >= 0)
            ::close(number_);
        number_ = -1;
    }

private:
    int number_;
};

/// A running program that is killed and waited for with the object.
class Child {
public:
    explicit Child(pid_t process) : process_(process) {}
    ~Child()
    {
        if (process_ > 0) {
            kill(process_, SIGKILL);
            wait();
        }
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    int wait()
    {
        int status = 0;
        while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
        }
        process_ = -1;
        return status;
    }

private:
    pid_t process_;
};

std::filesystem::path find_program(const std::string& place)
{
    std::vector<std::filesystem::path> places;
    if (const char* named = std::getenv("LIGHTWELL_IMPORT_ASSIMP"))
        places.push_back(named);
    std::error_code error;
    if (const auto self = std::filesystem::read_symlink("/proc/self/exe", error); !error)
        places.push_back(self.parent_path() / program_name);
    places.push_back(LIGHTWELL_BUILT_CHILD);
    for (const std::filesystem::path& candidate : places)
        if (access(candidate.c_str(), X_OK) == 0)
            return candidate;
    throw InputError(place, std::string("the program ") + program_name + " that reads this format was not found",
                     "install it beside lightwell, or name it in LIGHTWELL_IMPORT_ASSIMP");
}

pid_t start(const std::filesystem::path& program, const std::vector<std::string>& words, int answer_end,
            const std::string& place)
{
    std::vector<char*> pointers;
    for (const std::string& word : words)
        pointers.push_back(const_cast<char*>(word.c_str())); // the interface of spawn; nothing is written there
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&files, 2, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&files, answer_end, answer_descriptor);
    pid_t process = -1;
    const int failure = posix_spawn(&process, program.c_str(), &files, nullptr, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    if (failure != 0)
        throw InputError(place, program.string() + " cannot be started: " + std::generic_category().message(failure));
    return process;
}

std::string seconds_text(const ChildLimits& limits)
{
    return std::to_string(limits.processor_seconds) + " s";
}

/// Reads until the other end is closed. @throws InputError when the answer takes too long or is too large
std::string read_answer(int descriptor, const ChildLimits& limits, const std::string& place)
{
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::seconds(limits.waiting_seconds);
    std::string answer;
    std::vector<char> buffer(1 << 18);
    for (;;) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
        pollfd waiting{descriptor, POLLIN, 0};
        const int ready = left > 0 ? poll(&waiting, 1, static_cast<int>(left)) : 0;
        if (ready < 0 && errno == EINTR)
            continue;
        if (ready <= 0)
            throw InputError(place,
                             "reading it takes longer than a file of its size should (" + seconds_text(limits) +
                                 " of processor time)",
                             "it is probably damaged; export it again, or as glTF or OBJ");
        const ssize_t count = read(descriptor, buffer.data(), buffer.size());
        if (count < 0 && errno == EINTR)
            continue;
        if (count <= 0)
            return answer;
        answer.append(buffer.data(), static_cast<std::size_t>(count));
        if (answer.size() > limits.answer_bytes)
            throw InputError(place, "it unfolds to more than " + std::to_string(limits.answer_bytes / megabyte) + " MB",
                             "it is probably damaged; export it again, or as glTF or OBJ");
    }
}

[[noreturn]] void report_breakdown(int status, const ChildLimits& limits, const std::string& place)
{
    const char* const hint = "it is probably damaged; export it again, or as glTF or OBJ";
    if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL))
        throw InputError(place, "reading it takes more than " + seconds_text(limits) + " of processor time", hint);
    const std::string how = WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status))
                                                : "status " + std::to_string(WEXITSTATUS(status));
    throw InputError(place, "the import program broke down while reading it (" + how + ")", hint);
}

} // namespace

ChildLimits child_limits(unsigned long long file_bytes)
{
    constexpr unsigned long long least_seconds = 2, seconds_per_megabyte = 2, patience = 20;
    constexpr unsigned long long least_memory = 200 * megabyte, memory_per_byte = 4;
    const unsigned long long memory = least_memory + memory_per_byte * file_bytes;
    const unsigned long long seconds = least_seconds + seconds_per_megabyte * (file_bytes / megabyte);
    return {seconds, patience * seconds, memory, memory / 2};
}

std::string run_import_program(const std::filesystem::path& file, const std::string& format, const ChildLimits& limits,
                               const std::string& place)
{
    const std::filesystem::path program = find_program(place);
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
        throw std::system_error(errno, std::generic_category(), "pipe");
    Descriptor reading(ends[0]), writing(ends[1]);
    Child child(start(program,
                      {program_name, format, std::filesystem::absolute(file).string(),
                       std::to_string(limits.processor_seconds), std::to_string(limits.memory_bytes)},
                      writing.number(), place));
    writing.close();
    std::string answer = read_answer(reading.number(), limits, place);
    const int status = child.wait();
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        report_breakdown(status, limits, place);
    return answer;
}

} // namespace lightwell
