#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lightwell {

/// How another program ended.
struct ChildResult {
    double cpu_s = 0, wall_s = 0;
    int status = 0; ///< of its exit; negative: the signal that ended it
    bool timed_out = false;
    std::string last_words; ///< last line of its error output, 200 characters at most
};

/// The program as the PATH has it; empty when it is not there.
std::filesystem::path program_on_path(const std::string& name);
/// Runs a program to its end, without a shell, its standard streams from and to files. It is ended after `most_cpu_s`
/// of CPU time or ten times that by the clock.
/// @throws InputError when it cannot be started
ChildResult run_child(const std::vector<std::string>& words, const std::filesystem::path& input,
                      const std::filesystem::path& output, double most_cpu_s);

} // namespace lightwell
