#include "importers/layers.h"
#include "engine/base/files.h"
#include "importers/formats/formats.h"
#include "importers/layer_report.h"
#include "plugins/cli/options.h"
#include "plugins/cli/subcommands.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <sstream>

namespace lightwell {
namespace {

struct LayersOptions {
    std::string drawing, map, proposal, report;
    ImportWords import;
    bool json = false, strict = false;
};

constexpr const char* examples = R"(Examples:
  lightwell layers house.dxf                          what is in the file, and a guess at what it is made of
  lightwell layers house.dxf --propose map.toml       the guess as a layer map to correct
  lightwell layers house.dxf --map map.toml --strict  is every layer mapped?
  lightwell layers house.glb --json                   for programs
  lightwell layers house.dxf --report table           what became of each type of entity on each layer
Every entity of the file is accounted for: made into surfaces, or skipped for a reason that is named.)";

bool lacks_material(const LayersOptions& options, const Imported& imported)
{
    if (!options.map.empty())
        return imported.report.has(Finding::unmapped);
    const std::vector<LayerSummary> layers = summarize_layers(imported);
    return std::any_of(layers.begin(), layers.end(), [](const LayerSummary& layer) { return layer.material.empty(); });
}

/// What is written by hand stays as it is, to the byte: rules are added for what has none.
void write_proposal(const Imported& imported, const std::filesystem::path& file, std::ostream& err)
{
    if (!std::filesystem::exists(file)) {
        write_text_atomically(file, propose_layer_map(imported));
        return;
    }
    const std::string text{MappedFile{file}.bytes()};
    const std::string extended = extend_layer_map(imported, read_layer_map(file), text);
    if (extended == text)
        err << file.string() << ": nothing added: each layer has a rule\n";
    else
        write_text_atomically(file, extended);
}

std::string rules_table(const std::vector<RuleHits>& rules)
{
    std::ostringstream text;
    for (const RuleHits& rule : rules)
        text << "rule in line " << rule.line << ": " << rule.surfaces << " surfaces, " << rule.area_m2
             << " m2: " << rule.text << '\n';
    return text.str();
}

Status layers(const LayersOptions& options, std::ostream& out, std::ostream& err)
{
    Imported imported = import_file(options.drawing, import_options(options.import));
    if (!options.proposal.empty())
        write_proposal(imported, options.proposal, err);
    std::vector<LedgerRow> rows;
    if (!options.report.empty())
        rows = ledger_rows(imported);
    std::vector<RuleHits> rules;
    if (!options.map.empty())
        rules = apply_layer_map(imported, read_layer_map(options.map));
    update_counts(rows, imported.ledger);
    if (options.report == "json")
        out << report_json(imported, options.drawing, rows, rules);
    else if (options.report == "table")
        out << report_table(imported, rows, rules);
    else
        out << (options.json ? layers_json(imported, options.drawing) : layers_table(imported) + rules_table(rules));
    err << imported.report;
    return options.strict && lacks_material(options, imported) ? Status::no : Status::done;
}

} // namespace

/// lightwell layers DRAWING [--map FILE] [--strict]: each layer's surfaces, area (m^2) and material.
/// Status 1 with --strict when a layer has no material.
void add_layers(CLI::App& app, Status& status)
{
    auto options = std::make_shared<LayersOptions>();
    CLI::App& command = *app.add_subcommand("layers", "what a CAD file holds: layers, surfaces, areas, materials");
    command.add_option("drawing", options->drawing, "CAD file: .dxf, .obj, .gltf, .glb")->required();
    command.add_option("--map", options->map, "layer map (TOML): shows the materials it assigns")->type_name("FILE");
    command
        .add_option("--propose", options->proposal,
                    "writes a first layer map, to be corrected; adds to one that exists")
        ->type_name("FILE");
    command.add_flag("--json", options->json, "layers for programs, on standard output");
    command.add_option("--report", options->report, "the ledger by layer and entity type instead: table or json")
        ->check(CLI::IsMember({"table", "json"}));
    command.add_flag("--strict", options->strict, "status 1 when a layer has no material");
    add_import_words(command, options->import);
    command.footer(examples);
    command.callback([options, &status] { status = layers(*options, std::cout, std::cerr); });
}

} // namespace lightwell
