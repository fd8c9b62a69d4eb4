#pragma once

#include <string>
#include <vector>

namespace lightwell {

/// The whole program: reads the arguments, runs one subcommand, reports errors on stderr.
/// @param arguments  as given to main(), the program's name first
/// @return           exit status, see Status
int run_command_line(const std::vector<std::string>& arguments);

} // namespace lightwell
