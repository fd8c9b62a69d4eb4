#include "engine/base/errors.h"
#include "plugins/cli/baked_maps.h"
#include "plugins/cli/scene_input.h"
#include "plugins/cli/subcommands.h"
#include "plugins/cli/terminal.h"

#include <CLI/CLI.hpp>

#include <iostream>

namespace lightwell {
namespace {

struct BakeOptions {
    SceneWords scene;
    EffortWords effort;
    std::vector<std::string> layers;
    bool all = false;
    double spacing_m = 0.1;
    std::string sides = "both", folder;
};

constexpr const char* examples = R"(Examples:
  lightwell bake room.rad --all --spacing 0.1 -o maps
  lightwell bake office.dxf --map map.toml --surface A-FLOR --surface A-WALL --spacing 0.25 --side front -o maps
Each surface becomes a picture in lx, front.Y and back.Y with their standard errors; maps.json says which surface it
belongs to, where its texels lie, and the means by surface and layer. Layers are globs: --surface "A-*".)";

BakeJob job_of(const BakeOptions& options, const LitScene& lit)
{
    BakeJob job;
    if (options.all == !options.layers.empty())
        throw InputError("bake", options.all ? "both --all and --surface were given" : "no surface was chosen",
                         "give --all, or --surface LAYER once or several times");
    for (const std::string& layer : options.all ? std::vector<std::string>{"*"} : options.layers)
        for (SurfaceChart& chart : surface_charts(lit.scene, layer, options.spacing_m))
            job.charts.push_back(std::move(chart));
    job.sides = options.sides == "front"  ? BakeSides::front
                : options.sides == "back" ? BakeSides::back
                                          : BakeSides::both;
    job.spacing_m = options.spacing_m;
    job.settings = grid_settings(options.effort);
    job.folder = options.folder;
    job.provenance = lit.provenance;
    return job;
}

Status bake(const BakeOptions& options, std::ostream& out, std::ostream& err)
{
    LitScene lit = load_scene(options.scene);
    err << lit.report;
    validate(lit.scene);
    const BakeJob job = job_of(options, lit);
    std::error_code failed;
    std::filesystem::create_directories(job.folder, failed);
    if (failed)
        throw InputError(options.folder, "the folder cannot be made: " + failed.message(), "choose another one");
    const Simulation simulation(std::move(lit.scene), options.effort.preparation);
    catch_interrupts();
    const SensorGrid grid = sensors_of(job);
    GridResult result;
    try {
        ProgressLine line("bake");
        result = simulation.illuminance(grid, job.settings, line.progress());
    } catch (const Cancelled&) {
        err << "lightwell: interrupted; no map was written\n";
        return Status::no;
    }
    write_baked_maps(job, result);
    char error[80];
    std::snprintf(error, sizeof error, " texels, median standard error %.2g %%, ", 100 * result.median_relative_error);
    out << layer_table(job, result);
    err << (job.folder / "maps.json").string() << ": " << job.charts.size() << " surfaces, " << grid.sensors.size()
        << error << duration_text(result.seconds) << '\n';
    return Status::done;
}

} // namespace

/// lightwell bake SCENE --surface LAYER | --all --spacing METRES -o FOLDER: illuminance as a texture for each surface.
/// Status 1 when interrupted.
void add_bake(CLI::App& app, Status& status)
{
    auto options = std::make_shared<BakeOptions>();
    CLI::App& command = *app.add_subcommand("bake", "illuminance of surfaces as textures, front and back");
    add_scene_words(command, options->scene);
    command.add_option("--surface", options->layers, "layers (globs) to bake; may be given several times")
        ->type_name("LAYER");
    command.add_flag("--all", options->all, "every surface of the scene");
    command.add_option("--spacing", options->spacing_m, "largest distance between texels (default 0.1 m)")
        ->check(CLI::PositiveNumber)
        ->type_name("METRES");
    command.add_option("--side", options->sides, "front, back or both (default)")
        ->check(CLI::IsMember({"front", "back", "both"}));
    command.add_option("-o,--output", options->folder, "folder for the pictures and maps.json; made when missing")
        ->required()
        ->type_name("FOLDER");
    constexpr double map_accuracy = 0.05;
    add_effort_words(command, options->effort, map_accuracy);
    add_unbiased_flag(command, options->effort);
    add_ambient_file(command, options->effort);
    command.footer(examples);
    command.callback([options, &status] {
        check_effort(options->effort);
        status = bake(*options, std::cout, std::cerr);
    });
}

} // namespace lightwell
