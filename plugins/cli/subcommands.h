#pragma once

#include "plugins/cli/status.h"

namespace CLI {
class App;
}

namespace lightwell {

// Each adds one subcommand; its callback sets the status. One file each, in this order in the help.
void add_layers(CLI::App& app, Status& status);
void add_import(CLI::App& app, Status& status);
void add_export(CLI::App& app, Status& status);
void add_materials(CLI::App& app, Status& status);
void add_luminaire(CLI::App& app, Status& status);
void add_render(CLI::App& app, Status& status);
void add_illuminance(CLI::App& app, Status& status);
void add_bake(CLI::App& app, Status& status);
void add_plan(CLI::App& app, Status& status);
void add_run(CLI::App& app, Status& status);
void add_validate(CLI::App& app, Status& status);

} // namespace lightwell
