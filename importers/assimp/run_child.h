#pragma once

#include <filesystem>
#include <string>

namespace lightwell {

/// What a file may cost to read: more means that it is damaged or a trap.
struct ChildLimits {
    unsigned long long processor_seconds;
    unsigned long long waiting_seconds; ///< more than the above: on a busy machine the child gets only a share
    unsigned long long memory_bytes;    ///< of the child's own data
    unsigned long long answer_bytes;
};
/// By the size of the file: 2 s and 2 s/MB, twenty times that to wait; 200 MB and 4 times the file, the answer at most
/// half of that.
ChildLimits child_limits(unsigned long long file_bytes);

/// Runs the import program on a file and returns its answer. A crash, a hang or too large an answer ends the program,
/// never this one.
/// @param format  what collect_scene calls the extension
/// @param place   for errors
/// @throws InputError  the program is not installed, it broke down, or it met a limit
std::string run_import_program(const std::filesystem::path& file, const std::string& format, const ChildLimits& limits,
                               const std::string& place);

} // namespace lightwell
