#include "plugins/insight/explain.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "plugins/cli/insight_commands.h"
#include "plugins/cli/provenance.h"
#include "plugins/cli/scene_input.h"
#include "plugins/cli/terminal.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <iostream>

namespace lightwell {
namespace {

struct ExplainOptions {
    SceneWords scene;
    EffortWords effort;
    std::vector<std::string> sensors;
    bool json = false;
};

constexpr const char* examples = R"(Examples:
  lightwell explain room.rad --sensor 2,1.5,0.8                  facing up
  lightwell explain room.rad --sensor 2,0,1.2,0,1,0 --sensor 3,1,0.8 --accuracy 0.5%
  lightwell explain office.dxf --map map.toml --sensor 4,3,0.75 --json
Shares by source, by the layer on which the sensor sees the light, and by the number of reflections, each summing to
100.0 %; then how much the illuminance changes when a layer's reflectance is raised by 0.01, with 95 % intervals. Light
that comes by a flat mirror's image counts with the surface that it lights.)";

Sensor parse_sensor(const std::string& text)
{
    const std::vector<std::string_view> words = split(text, ", ");
    double numbers[6] = {0, 0, 0, 0, 0, 1};
    bool good = words.size() == 3 || words.size() == 6;
    for (std::size_t i = 0; good && i < words.size(); ++i) {
        const auto number = parse_double(words[i]);
        good = number.has_value();
        numbers[i] = number.value_or(0);
    }
    if (!good)
        throw InputError("--sensor", "\"" + text + "\" is not a place", "write x,y,z or x,y,z,nx,ny,nz in metres");
    return {{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
}

nlohmann::ordered_json shares_json(const std::vector<Share>& shares)
{
    const std::vector<double> percent = whole_percentages(shares);
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < shares.size(); ++i)
        list.push_back({{"name", shares[i].name},
                        {"percent", percent[i]},
                        {"lux", shares[i].lux},
                        {"half_width_95", half_width_95(shares[i].standard_error)}});
    return list;
}

nlohmann::ordered_json explanation_json(const Explanation& e)
{
    nlohmann::ordered_json effects = nlohmann::ordered_json::array();
    for (const LayerEffect& effect : e.effects)
        effects.push_back({{"layer", effect.name},
                           {"reflectance", effect.reflectance},
                           {"lux_per_reflectance", effect.lux_per_reflectance},
                           {"half_width_95", half_width_95(effect.standard_error)}});
    const Point& p = e.sensor.position;
    const Direction& n = e.sensor.normal;
    return {{"position", {p.x, p.y, p.z}},
            {"normal", {n.x, n.y, n.z}},
            {"lux", e.lux},
            {"half_width_95", half_width_95(e.standard_error)},
            {"paths", e.paths},
            {"sources", shares_json(e.sources)},
            {"layers", shares_json(e.layers)},
            {"reflections", shares_json(e.bounces)},
            {"derivatives", effects}};
}

Status explain_sensors(const ExplainOptions& options, std::ostream& out, std::ostream& err)
{
    std::vector<Sensor> sensors;
    for (const std::string& text : options.sensors)
        sensors.push_back(parse_sensor(text));
    LitScene lit = load_scene(options.scene);
    err << lit.report;
    catch_interrupts();
    ExplainSettings settings;
    settings.accuracy = options.effort.accuracy;
    settings.seed = options.effort.seed;
    settings.threads = options.effort.threads;
    settings.preparation = options.effort.preparation;
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Sensor& sensor : sensors) {
        ProgressLine line("explain");
        const Explanation found = explain(lit.scene, sensor, settings, line.progress());
        if (options.json)
            list.push_back(explanation_json(found));
        else
            out << (&sensor == &sensors.front() ? "" : "\n") << explanation_text(found);
    }
    if (options.json)
        out << nlohmann::ordered_json{{"version", program_version()}, {"sensors", list}}.dump(2) << '\n';
    return Status::done;
}

} // namespace

/// lightwell explain SCENE --sensor X,Y,Z[,NX,NY,NZ]: where a sensor's light comes from, and which reflectance matters.
void add_explain(CLI::App& app, Status& status)
{
    auto options = std::make_shared<ExplainOptions>();
    CLI::App& command = *app.add_subcommand("explain", "where a sensor's light comes from, and which layer matters");
    add_scene_words(command, options->scene);
    command.add_option("--sensor", options->sensors, "place and direction (default: up), in metres; repeatable")
        ->required()
        ->expected(1)
        ->take_all()
        ->type_name("X,Y,Z[,NX,NY,NZ]");
    command.add_flag("--json", options->json, "for programs, on standard output");
    constexpr double usual_accuracy = 0.01;
    add_effort_words(command, options->effort, usual_accuracy);
    command.footer(examples);
    command.callback([options, &status] { status = explain_sensors(*options, std::cout, std::cerr); });
}

} // namespace lightwell
