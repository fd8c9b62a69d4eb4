#include "plugins/insight/tradeoff.h"

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "plugins/cli/insight_commands.h"
#include "plugins/cli/picture_files.h"
#include "plugins/cli/scene_input.h"
#include "plugins/cli/terminal.h"

#include <CLI/CLI.hpp>

#include <fstream>
#include <iostream>

namespace lightwell {
namespace {

struct TradeoffOptions {
    SceneWords scene;
    std::string view, grid, output;
    std::pair<int, int> size{160, 90};
    TradeSettings settings;
    bool no_peers = false;
};

constexpr const char* examples = R"(Examples:
  lightwell tradeoff room.rad --grid plane:0.85,0,0,6,4/0.5 -o trade
  lightwell tradeoff room.rad --view desk --size 160x90 -o trade --reference 600
Writes trade.csv and trade.svg: error (RMS, mean bias, 95th percentile, maximum; relative) against CPU time for settings
from coarse to fine, each technique off in turn, and rtrace or rpict where they are on the PATH; marks the cheapest
setting that reached 1, 3, 5 and 10 %. --peer-file draws what other programs were measured to answer. The reference is unbiased path tracing; its own error is stated.)";

void write_text(const std::filesystem::path& file, const std::string& text)
{
    std::ofstream stream(file, std::ios::binary);
    if (!(stream << text) || !stream.flush())
        throw InputError{file.string(), "cannot be written", "is the folder there, and writable?"};
}

Status tradeoff(const TradeoffOptions& options, std::ostream& out, std::ostream& err)
{
    if (options.view.empty() == options.grid.empty())
        throw InputError{"tradeoff", "one of --grid and --view is needed", "what shall be measured?"};
    LitScene lit = load_scene(options.scene);
    err << lit.report;
    catch_interrupts();
    TradeSettings settings = options.settings;
    settings.peers = !options.no_peers;
    const std::string name = std::filesystem::path(options.scene.file).stem().string();
    write_text(options.output + ".csv", ""); // before an hour is spent
    Tradeoff found;
    {
        ProgressLine line("tradeoff");
        if (!options.grid.empty()) {
            found = measure_tradeoff(lit.scene, choose_grid(options.grid, lit.scene), settings, line.progress());
        } else {
            const View view = choose_view(options.view, lit.scene);
            PictureSettings size;
            size.width = options.size.first;
            size.height = options.size.second;
            fit_to_view(view, size);
            found = measure_tradeoff(lit.scene, view, size.width, size.height, settings, line.progress());
        }
    }
    write_text(options.output + ".csv", tradeoff_csv(found));
    write_text(options.output + ".svg", chart_svg(tradeoff_chart(found, name + ": error against CPU time")));
    out << tradeoff_text(found) << options.output << ".csv\n" << options.output << ".svg\n";
    return Status::done;
}

} // namespace

/// lightwell tradeoff SCENE --grid G | --view V -o NAME: what a second buys, for this scene.
void add_tradeoff(CLI::App& app, Status& status)
{
    auto options = std::make_shared<TradeoffOptions>();
    CLI::App& command = *app.add_subcommand("tradeoff", "error against time over settings, techniques and programs");
    add_scene_words(command, options->scene);
    CLI::Option* view = command.add_option("--view", options->view, "name, file or view words");
    command.add_option("--grid", options->grid, "layer:..., plane:..., file:... or a name")->excludes(view);
    command
        .add_option_function<std::string>(
            "--size", [options](const std::string& text) { options->size = parse_size(text); },
            "largest size of the picture (default 160x90)")
        ->type_name("WxH");
    command.add_option("-o,--output", options->output, "NAME: writes NAME.csv and NAME.svg")
        ->required()
        ->type_name("NAME");
    command.add_option("--reference", options->settings.reference_cpu_s, "CPU seconds for the reference (default 120)")
        ->check(CLI::PositiveNumber)
        ->type_name("SECONDS");
    command.add_option("--seed", options->settings.seed, "another seed, other noise")->type_name("N");
    command.add_option("--threads", options->settings.threads, "0: all processors")
        ->type_name("N")
        ->check(CLI::Range(0, 1024));
    command
        .add_option("--peer-time", options->settings.peer_cpu_s,
                    "CPU seconds after which a run of another program is ended (default 300)")
        ->check(CLI::PositiveNumber)
        ->type_name("SECONDS");
    command
        .add_option("--peer-file", options->settings.peer_file,
                    "answers of further programs: program,setting,cpu_s,wall_s,values a line")
        ->type_name("FILE");
    command.add_flag("--no-peers", options->no_peers, "leave other programs out");
    command.footer(examples);
    command.callback([options, &status] { status = tradeoff(*options, std::cout, std::cerr); });
}

} // namespace lightwell
