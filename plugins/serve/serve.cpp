#include "plugins/serve/serve.h"

#include "plugins/cli/terminal.h"
#include "plugins/serve/server.h"

#include <CLI/CLI.hpp>

#include <unistd.h>

namespace lightwell {
namespace {

constexpr const char* examples = R"(A host starts `lightwell serve`, writes one JSON object a line and reads one a line:
  < {"event":"hello","protocol":1,"engine":"0.1.0","pid":123}
  > {"id":1,"do":"load","scene":"/tmp/job/scene.rad"}
  < {"event":"result","id":1,"kind":"scene","surfaces":412,"layers":[...],"views":["desk"],...}
  > {"id":2,"do":"render","view":"desk","size":[960,540],"accuracy":0.05,"file":"/tmp/job/desk.exr"}
  < {"event":"progress","id":2,"fraction":0.42,"phase":"view desk","seconds_left":3.1}
  < {"event":"result","id":2,"kind":"picture","file":"/tmp/job/desk.exr","error":0.049,...}
All requests: plugins/README.md. It ends when its standard input ends.)";

} // namespace

void add_serve(CLI::App& app, Status& status)
{
    CLI::App& command = *app.add_subcommand("serve", "for modelling programs: JSON lines in, JSON lines out");
    command.footer(examples);
    command.callback([&status] {
        catch_interrupts();
        serve::answer(STDIN_FILENO, STDOUT_FILENO);
        status = Status::done;
    });
}

} // namespace lightwell
