#include "importers/formats/formats.h"
#include "importers/layer_report.h"
#include "importers/radiance/radiance.h"
#include "plugins/cli/options.h"
#include "plugins/cli/sky_words.h"
#include "plugins/cli/subcommands.h"

#include <CLI/CLI.hpp>

#include <iostream>

namespace lightwell {
namespace {

struct ImportCommand {
    std::string drawing, map, output, report;
    ImportWords import;
    SkyWords sky;
    WriteOptions write;
};

constexpr const char* examples = R"(Examples:
  lightwell import house.dxf --map map.toml -o house.rad
  lightwell import house.obj --unit mm --up y --map map.toml -o house.rad --flat
  lightwell import house.glb --map map.toml --sky clear --place 52.5,13.4 --time 2026-03-21T12:00+01:00 -o house.rad
The result is a scene description as text. Blocks stay instances, in house.parts/; --flat writes them out into one
file. Several drawings become one scene in a project file: lightwell run --help.)";

Status import_drawing(const ImportCommand& options, std::ostream& out, std::ostream& err)
{
    Imported imported = import_file(options.drawing, import_options(options.import));
    std::vector<LedgerRow> rows;
    if (!options.report.empty())
        rows = ledger_rows(imported);
    const std::vector<RuleHits> rules =
        apply_layer_map(imported, options.map.empty() ? LayerMap{} : read_layer_map(options.map));
    if (!options.sky.type.empty())
        add_described_sky(imported.scene, sky_of(options.sky));
    write_radiance(imported.scene, options.output, options.write, imported.report);
    err << imported.report;
    update_counts(rows, imported.ledger);
    if (options.report == "json") {
        out << report_json(imported, options.drawing, rows, rules);
        return Status::done;
    }
    if (options.report == "table")
        out << report_table(imported, rows, rules);
    out << options.output << ": " << expanded_count(imported.scene) << " surfaces, unit " << imported.unit << "; "
        << imported.ledger.read_count() << " entities read = " << imported.ledger.made_count() << " made + "
        << imported.ledger.read_count() - imported.ledger.made_count() << " skipped\n";
    return Status::done;
}

} // namespace

/// lightwell import DRAWING --map FILE -o SCENE: a CAD file as scene description.
void add_import(CLI::App& app, Status& status)
{
    auto options = std::make_shared<ImportCommand>();
    CLI::App& command = *app.add_subcommand("import", "a CAD file to a scene description");
    command.add_option("drawing", options->drawing, "CAD file: .dxf, .obj, .gltf, .glb")->required();
    command.add_option("--map", options->map, "layer map (TOML): which layer is made of what")->type_name("FILE");
    command.add_option("-o,--output", options->output, "scene description, NAME.rad")->required()->type_name("FILE");
    command.add_option("--report", options->report, "the ledger by layer and entity type: table or json")
        ->check(CLI::IsMember({"table", "json"}));
    command.add_flag("--flat", options->write.flat, "expand blocks, so that one file says it all");
    add_import_words(command, options->import);
    add_sky_words(command, options->sky);
    command.footer(examples);
    command.callback([options, &status] { status = import_drawing(*options, std::cout, std::cerr); });
}

} // namespace lightwell
