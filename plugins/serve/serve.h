#pragma once

#include "plugins/cli/status.h"

namespace CLI {
class App;
}

namespace lightwell {

/// lightwell serve: the engine as a child process of a modelling program, JSON lines on standard input and output.
void add_serve(CLI::App& app, Status& status);

} // namespace lightwell
