#pragma once

#include <iosfwd>
#include <stdexcept>
#include <string>
#include <vector>

/// \file Radiance's commands as faces of the library: the same words, formats and messages.
namespace lightwell::commands {

/// Where a command reads and writes.
struct Streams {
    std::istream& in;
    std::ostream& out;
    std::ostream& err;
};

/// Ends a command with `NAME: fatal - WHAT` and its status.
class Fatal : public std::runtime_error {
public:
    explicit Fatal(const std::string& what, int exit_status = 1) : std::runtime_error(what), status(exit_status) {}
    int status;
};

/// @param words  the command's name first, as it stands in messages
using Command = int (*)(const std::vector<std::string>& words, const Streams& streams);

/// Whether there is a command of this name (`rtrace`, also `/usr/bin/rtrace` and `rtrace.exe`).
bool is_command(const std::string& program);
/// Runs it on the process's own streams.
/// @return the exit status: 0 done, 1 bad input or usage
int run_command(const std::vector<std::string>& words);
/// The same on other streams.
int run_command(const std::vector<std::string>& words, const Streams& streams);
std::vector<std::string> command_names();

/// Whether the environment permits commands in scene text that are not answered here (LIGHTWELL_RUN_COMMANDS=1).
bool commands_permitted();

} // namespace lightwell::commands
