#pragma once

#include <string>
#include <vector>

namespace lightwell::commands {

/// The head of a result: `#?RADIANCE`, the history of the scene, this command, program and time.
std::string run_header(const std::vector<std::string>& history, const std::vector<std::string>& words);
/// The same without the first line, as an entry of a picture's header.
std::string run_history(const std::vector<std::string>& history, const std::vector<std::string>& words);
/// What `rtrace -defaults` and `rpict -defaults` print.
std::string trace_defaults();
std::string picture_defaults();

} // namespace lightwell::commands
