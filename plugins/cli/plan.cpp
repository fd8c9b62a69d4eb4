#include "engine/plan/plan.h"
#include "plugins/cli/picture_files.h"
#include "plugins/cli/plan_text.h"
#include "plugins/cli/scene_input.h"
#include "plugins/cli/subcommands.h"
#include "plugins/cli/terminal.h"

#include <CLI/CLI.hpp>

#include <iostream>

namespace lightwell {
namespace {

struct PlanOptions {
    SceneWords scene;
    EffortWords effort;
    std::string view, grid;
    std::pair<int, int> size{960, 540};
    double time_s = 0;
    bool explain = false, json = false;
};

constexpr const char* examples = R"(Examples:
  lightwell plan room.rad                                        what is in the scene and what that takes
  lightwell plan room.rad --grid layer:A-FLOR@0.75/0.5 --accuracy 1%   and what it will cost
  lightwell plan room.rad --view desk --within 60 --explain        and which accuracy a minute buys
  lightwell plan room.rad --json                                 for programs
Cost is in CPU seconds of one thread, from a pilot run of about a second. `render --plan` and `illuminance --plan` write
the prediction beside what was reached, in NAME.run.json.)";

Forecast forecast_wish(const PlanOptions& options, const Simulation& simulation)
{
    const EffortWords& effort = options.effort;
    if (!options.grid.empty())
        return forecast(simulation, choose_grid(options.grid, simulation.scene()), grid_settings(effort));
    const View view = choose_view(options.view, simulation.scene());
    PictureSettings settings = picture_settings(effort, options.size.first, options.size.second);
    fit_to_view(view, settings);
    return forecast(simulation, view, settings);
}

/// Where a picture or a map would look from; nothing without one.
std::vector<Lookout> lookouts(const PlanOptions& options, const Scene& scene)
{
    std::vector<Lookout> places;
    if (!options.grid.empty()) {
        constexpr double lift = 1e-9; // of the scene's size: off a surface that holds the sensor
        const double lift_m = lift * bounds(scene).diagonal();
        for (const Sensor& sensor : choose_grid(options.grid, scene).sensors)
            places.push_back({sensor.position, sensor.normal, lift_m});
    } else if (!options.view.empty()) {
        const View view = choose_view(options.view, scene);
        places.push_back({view.position, view.direction, 0});
    }
    return places;
}

Status plan(const PlanOptions& options, std::ostream& out, std::ostream& err)
{
    LitScene lit = load_scene(options.scene);
    err << lit.report;
    validate(lit.scene);
    PlanWish wish;
    wish.accuracy = options.effort.accuracy;
    const Preparation& preparation = options.effort.preparation;
    wish.virtual_depth = preparation.virtual_sources ? preparation.virtual_depth : 0;
    const std::vector<Lookout> places = lookouts(options, lit.scene);
    std::optional<Surroundings> surroundings;
    if (!places.empty())
        surroundings = look_around(lit.scene, RayQueries(lit.scene), places);
    const Plan made = plan_for(needs_of(lit.scene), wish, surroundings);
    std::optional<Forecast> expected;
    std::optional<TimeOffer> offer;
    if (!places.empty()) {
        catch_interrupts();
        expected = forecast_wish(options, Simulation(std::move(lit.scene), options.effort.preparation));
        if (options.time_s > 0)
            offer = {options.time_s, accuracy_within(expected->prediction.model, expected->items, options.time_s)};
    }
    out << (options.json ? plan_json(made, expected, offer) : plan_text(made, expected, offer, options.explain));
    return Status::done;
}

} // namespace

/// lightwell plan SCENE [--view V | --grid G]: what the scene needs, what will be done, at what cost.
void add_plan(CLI::App& app, Status& status)
{
    auto options = std::make_shared<PlanOptions>();
    CLI::App& command = *app.add_subcommand("plan", "what a scene needs, and the cost and error to expect");
    add_scene_words(command, options->scene);
    CLI::Option* view = command.add_option("--view", options->view, "predict a picture: name, file or view words");
    command.add_option("--grid", options->grid, "predict an illuminance map: layer:..., plane:..., file:... or a name")
        ->excludes(view);
    command
        .add_option_function<std::string>(
            "--size", [options](const std::string& text) { options->size = parse_size(text); },
            "largest size of the picture (default 960x540)")
        ->type_name("WxH");
    command.add_option("--within", options->time_s, "CPU seconds: which accuracy do they buy?")
        ->check(CLI::PositiveNumber)
        ->type_name("SECONDS");
    command.add_flag("--explain", options->explain, "also the stages that the scene does not need, and why not");
    command.add_flag("--json", options->json, "for programs, on standard output");
    constexpr double usual_accuracy = 0.05;
    add_effort_words(command, options->effort, usual_accuracy);
    add_unbiased_flag(command, options->effort);
    command.footer(examples);
    command.callback([options, &status] { status = plan(*options, std::cout, std::cerr); });
}

} // namespace lightwell
