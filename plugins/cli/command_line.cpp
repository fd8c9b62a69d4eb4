#include "plugins/cli/command_line.h"

#include "engine/base/errors.h"
#include "plugins/cli/insight_commands.h"
#include "plugins/cli/provenance.h"

#include <CLI/CLI.hpp>

#include <array>
#include <iostream>
#include <new>

namespace lightwell {
namespace {

constexpr const char* overview = R"(From a CAD file to light:
  lightwell layers house.dxf --propose map.toml      what is in the file; a first layer map to correct
  lightwell import house.dxf --map map.toml -o house.rad
  lightwell render house.dxf --map map.toml --sky clear --place 52.5,13.4 --time 2026-03-21T12:00+01:00 \
      --view "-vp 2 1 1.6 -vd 0 1 0 -vh 60 -vv 40" -o house.exr --png
  lightwell illuminance house.dxf --map map.toml --grid layer:A-FLOR@0.75/0.5 -o desk.csv -o desk.png
  lightwell run house.toml                           all views and grids of a project
  lightwell validate                                 the engine against closed forms
Exit status: 0 done, 1 the answer is no or the work was interrupted, 2 wrong usage, 3 bad input, 4 our fault.
`lightwell COMMAND --help` explains each command.)";

/// Options whose value may begin with '-', which would read as another option: "--view", "-vtv ..." become one word.
std::vector<std::string> join_values(const std::vector<std::string>& arguments)
{
    static constexpr std::array<std::string_view, 4> with_minus{"--view", "--place", "--north", "--sensor"};
    std::vector<std::string> joined;
    for (std::size_t i = 1; i < arguments.size(); ++i) {
        const bool takes_next = std::find(with_minus.begin(), with_minus.end(), arguments[i]) != with_minus.end();
        if (takes_next && i + 1 < arguments.size()) {
            joined.push_back(arguments[i] + "=" + arguments[i + 1]);
            ++i;
        } else {
            joined.push_back(arguments[i]);
        }
    }
    return joined;
}

Status parse_and_run(const std::vector<std::string>& arguments, const std::vector<AddSubcommand>& more)
{
    Status status = Status::done;
    CLI::App app("Lighting simulation for CAD models: layers in, pictures and illuminance maps out.", "lightwell");
    app.set_version_flag("--version", program_version());
    app.require_subcommand(1);
    app.footer(overview);
    add_layers(app, status);
    add_import(app, status);
    add_export(app, status);
    add_materials(app, status);
    add_luminaire(app, status);
    add_render(app, status);
    add_illuminance(app, status);
    add_bake(app, status);
    add_plan(app, status);
    add_run(app, status);
    add_explain(app, status);
    add_tradeoff(app, status);
    add_validate(app, status);
    for (const AddSubcommand add : more)
        add(app, status);
    std::vector<std::string> words = join_values(arguments);
    std::reverse(words.begin(), words.end()); // CLI11 takes its words from the back
    try {
        app.parse(words);
    } catch (const CLI::ParseError& error) {
        return app.exit(error, std::cout, std::cerr) == 0 ? Status::done : Status::usage;
    }
    return status;
}

} // namespace

int run_command_line(const std::vector<std::string>& arguments, const std::vector<AddSubcommand>& more)
{
    Status status = Status::our_fault;
    try {
        remember_command(arguments);
        status = parse_and_run(arguments, more);
        if (!std::cout.flush()) {
            std::cerr << "lightwell: standard output cannot be written\n";
            status = Status::bad_input;
        }
    } catch (const InputError& error) {
        std::cerr << "lightwell: " << error.what() << '\n';
        status = Status::bad_input;
    } catch (const Cancelled&) {
        std::cerr << "lightwell: interrupted\n";
        status = Status::no;
    } catch (const std::bad_alloc&) {
        std::cerr << "lightwell: out of memory\n";
    } catch (const std::exception& error) {
        std::cerr << "lightwell: internal error: " << error.what() << '\n';
    }
    return static_cast<int>(status);
}

} // namespace lightwell
