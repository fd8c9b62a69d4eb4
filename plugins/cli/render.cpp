#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "plugins/cli/forecast.h"
#include "plugins/cli/picture_files.h"
#include "plugins/cli/scene_input.h"
#include "plugins/cli/subcommands.h"
#include "plugins/cli/terminal.h"

#include <CLI/CLI.hpp>

#include <iostream>

namespace lightwell {
namespace {

struct RenderOptions {
    SceneWords scene;
    EffortWords effort;
    std::string view, output;
    std::pair<int, int> size{960, 540};
    RegionWords region;
    bool png = false, hdr = false;
};

constexpr const char* examples = R"(Examples:
  lightwell render room.rad --view desk -o room.exr --png
  lightwell render room.rad --view "-vp 2 1 1.6 -vd 0 1 0 -vh 60 -vv 40" --accuracy 2% -o room.exr
  lightwell render house.glb --map map.toml --sky clear --place 52.5,13.4 --time 2026-03-21T12:00+01:00 \
      --view "-vp 0 -20 5 -vd 0 1 -0.1" --size 1600x900 -o house.exr --png --hdr
  lightwell render room.rad --view desk --size 1600x900 --region 700,300,900,450 -o corner.exr
View words: -vtv perspective, -vtl parallel, -vtc cylindrical, or a fisheye: -vth hemispherical, -vta angular, -vts
planisphere; -vp position, -vd direction, -vu up, -vh and -vv horizontal and vertical angle in degrees (metres for a
parallel view); -vs shift, -vl lift; -vo, -va fore and aft clipping distance; -pd diameter of the lens in metres, sharp
at -pf metres or, without it, at the length of -vd.
The picture grows as room.partial.exr. After Ctrl-C or a kill the same command goes on where it stopped, to the same bits.
Beside room.exr stands room.run.json: command, host, time, samples, accuracy reached, notes of the import.)";

Status render(const RenderOptions& options, std::ostream& out, std::ostream& err)
{
    if (lowercase_ascii(std::filesystem::path(options.output).extension().string()) != ".exr")
        throw InputError(options.output, "the picture is written as OpenEXR",
                         "name it NAME.exr; --png and --hdr add others");
    LitScene lit = load_scene(options.scene);
    err << lit.report;
    PictureJob job;
    job.view = choose_view(options.view, lit.scene);
    job.settings = picture_settings(options.effort, options.size.first, options.size.second);
    fit_to_view(job.view, job.settings);
    const RegionWords& region = options.region;
    job.settings.region = {region.x0, region.y0, region.x1 - region.x0, region.y1 - region.y0};
    wanted_pixels(job.settings); // refuses one that is not in the picture before anything is made
    job.file = options.output;
    job.time_s = options.effort.time_s;
    job.png = options.png;
    job.hdr = options.hdr;
    job.provenance = lit.provenance;
    job.report = lit.report;
    if (lit.provenance.contains("sky"))
        err << lit.provenance["sky"] << '\n';
    const Simulation simulation(std::move(lit.scene), options.effort.preparation);
    catch_interrupts();
    if (options.effort.plan) {
        const Forecast expected = forecast(simulation, job.view, job.settings);
        err << to_text(expected);
        job.predicted = expected.prediction;
    }
    return make_picture(simulation, job, out, err);
}

} // namespace

/// lightwell render SCENE --view VIEW -o NAME.exr: a picture in W/(m^2 sr) with the illuminance of what it shows.
/// Status 1 when interrupted.
void add_render(CLI::App& app, Status& status)
{
    auto options = std::make_shared<RenderOptions>();
    CLI::App& command = *app.add_subcommand("render", "a picture in absolute units, OpenEXR");
    add_scene_words(command, options->scene);
    command.add_option("--view", options->view, "name of a view of the scene, a view file, or view words")->required();
    command.add_option("-o,--output", options->output, "picture, NAME.exr")->required()->type_name("FILE");
    command.add_flag("--png", options->png, "also NAME.png, tone mapped for display");
    command.add_flag("--hdr", options->hdr, "also NAME.hdr, a Radiance picture");
    command
        .add_option_function<std::string>(
            "--size", [options](const std::string& text) { options->size = parse_size(text); },
            "largest size; pixels stay square, so the view's shape decides one side (default 960x540)")
        ->type_name("WxH");
    command
        .add_option_function<std::string>(
            "--region", [options](const std::string& text) { options->region = parse_region(text); },
            "only columns X0 to X1-1 and rows Y0 to Y1-1 of the picture, row 0 at the top: the same bits as in the "
            "whole")
        ->type_name("X0,Y0,X1,Y1");
    constexpr double picture_accuracy = 0.05;
    add_effort_words(command, options->effort, picture_accuracy);
    add_unbiased_flag(command, options->effort);
    add_plan_flag(command, options->effort);
    add_time_words(command, options->effort, &options->scene.sky);
    add_ambient_file(command, options->effort);
    add_secondary_words(command, options->effort);
    command.footer(examples);
    command.callback([options, &status] {
        check_effort(options->effort);
        status = render(*options, std::cout, std::cerr);
    });
}

} // namespace lightwell
