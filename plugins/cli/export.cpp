#include "importers/export/export.h"
#include "importers/formats/formats.h"
#include "importers/layers.h"
#include "importers/radiance/radiance.h"
#include "plugins/cli/options.h"
#include "plugins/cli/scene_input.h"
#include "plugins/cli/subcommands.h"

#include <CLI/CLI.hpp>

#include <iostream>

namespace lightwell {
namespace {

struct ExportCommand {
    std::string model, map, output;
    ImportWords import;
    ExportOptions how;
};

constexpr const char* examples = R"(Examples:
  lightwell export house.obj -o house.dxf             the same model in another format
  lightwell export house.dxf --map map.toml -o house.glb
  lightwell export house.rad -o house.dxf
Layers, blocks and outlines of any number of corners stay what they are as far as the format has them; what it lacks is
written out or approximated, and told.)";

Imported model_of(const ExportCommand& options)
{
    if (is_scene_text(options.model)) {
        Imported model;
        model.scene = read_radiance(options.model, model.report);
        for (const Modifier& modifier : model.scene.modifiers)
            model.keys.push_back({modifier.name, {}, {}, {}, {}, {}});
        return model;
    }
    Imported model = import_file(options.model, import_options(options.import));
    if (!options.map.empty())
        apply_layer_map(model, read_layer_map(options.map));
    return model;
}

Status export_model(const ExportCommand& options, std::ostream& out, std::ostream& err)
{
    Imported model = model_of(options);
    export_file(model, options.output, options.how, model.report);
    err << model.report;
    out << options.output << ": " << expanded_count(model.scene) << " surfaces in metres\n";
    return Status::done;
}

} // namespace

/// lightwell export MODEL -o FILE: a model as DXF, OBJ or GLB.
void add_export(CLI::App& app, Status& status)
{
    auto options = std::make_shared<ExportCommand>();
    CLI::App& command = *app.add_subcommand("export", "a model as DXF, OBJ or GLB");
    command.add_option("model", options->model, "CAD file or scene description")->required();
    command.add_option("--map", options->map, "layer map (TOML): materials for OBJ and GLB")->type_name("FILE");
    command.add_option("-o,--output", options->output, "NAME.dxf, NAME.obj or NAME.glb")->required()->type_name("FILE");
    command
        .add_option("--chord-tolerance", options->how.chord_tolerance_m,
                    "metres, for round shapes that the format lacks (default 0.0005)")
        ->check(CLI::PositiveNumber);
    add_import_words(command, options->import);
    command.footer(examples);
    command.callback([options, &status] { status = export_model(*options, std::cout, std::cerr); });
}

} // namespace lightwell
