#pragma once

#include "plugins/cli/subcommands.h"

namespace lightwell {

// The commands that ask about a scene's light with many runs.
void add_explain(CLI::App& app, Status& status);
void add_tradeoff(CLI::App& app, Status& status);

} // namespace lightwell
