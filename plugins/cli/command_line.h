#pragma once

#include "plugins/cli/status.h"

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace lightwell {

/// Adds one subcommand; its callback sets the status.
using AddSubcommand = void (*)(CLI::App& app, Status& status);

/// The whole program: reads the arguments, runs one subcommand, reports errors on stderr.
/// @param arguments  as given to main(), the program's name first
/// @param more       subcommands of folders that use this one
/// @return           exit status, see Status
int run_command_line(const std::vector<std::string>& arguments, const std::vector<AddSubcommand>& more = {});

} // namespace lightwell
