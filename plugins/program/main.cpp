#include "plugins/cli/command_line.h"
#include "plugins/commands/command.h"
#include "plugins/serve/serve.h"

/// `lightwell COMMAND ...`; under the name of a command of Radiance, or as `lightwell rad NAME ...`, that command.
int main(int count, char** words)
{
    const std::vector<std::string> all(words, words + count);
    if (all.size() > 2 && all[1] == "rad")
        return lightwell::commands::run_command({all.begin() + 2, all.end()});
    if (!all.empty() && lightwell::commands::is_command(all[0]))
        return lightwell::commands::run_command(all);
    return lightwell::run_command_line(all, {lightwell::add_serve});
}
