#include "plugins/cli/forecast.h"
#include "plugins/cli/map_files.h"
#include "plugins/cli/scene_input.h"
#include "plugins/cli/subcommands.h"
#include "plugins/cli/terminal.h"

#include <CLI/CLI.hpp>

#include <iostream>

namespace lightwell {
namespace {

struct IlluminanceOptions {
    SceneWords scene;
    EffortWords effort;
    std::string grid;
    std::vector<std::string> outputs;
};

constexpr const char* examples = R"(Examples:
  lightwell illuminance office.dxf --map map.toml --grid layer:A-FLOR@0.75/0.5 -o desks.csv -o desks.png
  lightwell illuminance room.rad --grid plane:0.85,0,0,6,4/0.25 -o desk.exr --accuracy 1%
  lightwell illuminance room.rad --grid file:points.txt -o points.csv --samples 4096
Grids: layer:NAME@HEIGHT/SPACING above the upward surfaces of the layers that match NAME; plane:z,x0,y0,x1,y1/SPACING
level and facing up; file:POINTS with six numbers a line, place and direction; or the name of a grid of the scene.
CSV columns: x,y,z,nx,ny,nz,illuminance_lx,error_lx,bias_lx: one standard error, and apart from it the bias
to expect of this value (0: none that the check could tell from noise).)";

Status illuminance(const IlluminanceOptions& options, std::ostream& out, std::ostream& err)
{
    LitScene lit = load_scene(options.scene);
    err << lit.report;
    MapJob job;
    job.grid = choose_grid(options.grid, lit.scene);
    job.settings = grid_settings(options.effort);
    job.files.assign(options.outputs.begin(), options.outputs.end());
    job.provenance = lit.provenance;
    job.time_s = options.effort.time_s;
    job.report = lit.report;
    check_map_files(job);
    if (lit.provenance.contains("sky"))
        err << lit.provenance["sky"] << '\n';
    const Simulation simulation(std::move(lit.scene), options.effort.preparation);
    catch_interrupts();
    if (options.effort.plan) {
        const Forecast expected = forecast(simulation, job.grid, job.settings);
        err << to_text(expected);
        job.predicted = expected.prediction;
    }
    return make_map(simulation, job, out, err);
}

} // namespace

/// lightwell illuminance SCENE --grid GRID -o FILE: illuminance with its standard error at every sensor of a grid.
/// Status 1 when interrupted.
void add_illuminance(CLI::App& app, Status& status)
{
    auto options = std::make_shared<IlluminanceOptions>();
    CLI::App& command =
        *app.add_subcommand("illuminance", "a map of lux with its error: CSV, OpenEXR, false-colour PNG");
    add_scene_words(command, options->scene);
    command
        .add_option("--grid", options->grid, "where to measure: layer:..., plane:..., file:... or a grid of the scene")
        ->required();
    command.add_option("-o,--output", options->outputs, "NAME.csv, NAME.exr or NAME.png; may be given several times")
        ->required()
        ->type_name("FILE");
    constexpr double map_accuracy = 0.02;
    add_effort_words(command, options->effort, map_accuracy);
    add_unbiased_flag(command, options->effort);
    add_plan_flag(command, options->effort);
    add_time_words(command, options->effort, &options->scene.sky);
    add_ambient_file(command, options->effort);
    add_secondary_words(command, options->effort);
    command.footer(examples);
    command.callback([options, &status] {
        check_effort(options->effort);
        status = illuminance(*options, std::cout, std::cerr);
    });
}

} // namespace lightwell
