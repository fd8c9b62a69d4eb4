#include "engine/base/errors.h"
#include "importers/project/project.h"
#include "importers/units.h"
#include "plugins/cli/map_files.h"
#include "plugins/cli/picture_files.h"
#include "plugins/cli/scene_input.h"
#include "plugins/cli/subcommands.h"
#include "plugins/cli/terminal.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>

namespace lightwell {
namespace {

struct RunOptions {
    std::string project, folder;
    std::vector<std::string> only;
    EffortWords effort;
    bool seed_given = false;
};

constexpr double picture_accuracy = 0.05, map_accuracy = 0.02; // as of `render` and `illuminance`

constexpr const char* examples = R"(Examples:
  lightwell run project.toml
  lightwell run project.toml --accuracy 20% --output out/draft
  lightwell run project.toml --only desk --only hall
  lightwell run project.toml --ambient-file out/house.amb      views share their ambient light
A project file:
  [inputs]
  files = ["house.dxf", "furniture.obj"]   # beside the project file; .rad files too
  map = "map.toml"
  [place]
  latitude = 52.5
  longitude = 13.4                         # east positive
  time = "2026-03-21T12:00+01:00"
  [sky]
  type = "clear"                           # intermediate, overcast, uniform, none
  [[view]]
  name = "hall"
  text = "-vp 2 1 1.6 -vd 0 1 0 -vh 60 -vv 40"
  size = [960, 540]
  [[grid]]
  name = "desk"
  on = "layer:A-FLOR@0.75"
  spacing = 0.5
  [wish]
  accuracy = 0.05                          # or quality = "draft", "normal", "fine", or time = "60s"
  [output]
  folder = "out"                           # beside the project file
Each view becomes NAME.exr (and NAME.png), each grid NAME.csv, NAME.png and NAME.exr; a list of points only NAME.csv.)";

SceneInputs inputs_of(const Project& project)
{
    SceneInputs inputs{project.inputs.files, project.inputs.map, {}, std::nullopt};
    if (!project.inputs.unit.empty())
        inputs.import.metres_per_unit = parse_unit(project.inputs.unit).value;
    inputs.import.up = project.inputs.up;
    inputs.import.raised = project.inputs.raised;
    if (project.sky && project.place)
        inputs.sky = describe_sky(*project.sky, *project.place, project.north_deg);
    return inputs;
}

/// What the project wishes, unless the command line says otherwise.
/// @param usual_accuracy  of this kind of result
EffortWords effort_of(const Project& project, const RunOptions& options, double usual_accuracy)
{
    EffortWords effort = options.effort;
    const ProjectWish& wish = project.wish;
    if (!effort.quality.empty())
        effort.accuracy = accuracy_of_quality(effort.quality, usual_accuracy);
    else if (!effort.accuracy_given)
        effort.accuracy = wish.accuracy.value_or(
            wish.quality.empty() ? usual_accuracy : accuracy_of_quality(wish.quality, usual_accuracy));
    const bool wished_here = effort.accuracy_given || effort.time_s > 0 || effort.samples > 0;
    if (!wished_here) {
        effort.samples = wish.samples.value_or(0);
        effort.time_s = wish.time_s.value_or(0);
    }
    if (!options.seed_given && project.wish.seed)
        effort.seed = static_cast<std::uint64_t>(*project.wish.seed);
    return effort;
}

struct Jobs {
    std::vector<PictureJob> pictures;
    std::vector<MapJob> maps;
};

/// What all results share: the time, and the accuracy of kept ambient light, which is that of the finest.
void share(Jobs& jobs)
{
    const auto count = static_cast<double>(jobs.pictures.size() + jobs.maps.size());
    double finest = 1;
    const auto each = [&](const auto& visit) {
        std::for_each(jobs.pictures.begin(), jobs.pictures.end(), visit);
        std::for_each(jobs.maps.begin(), jobs.maps.end(), visit);
    };
    each([&](auto& job) {
        job.time_s /= count;
        finest = std::min(finest, job.settings.accuracy);
    });
    each([&](auto& job) {
        if (!job.settings.ambient_file.file.empty())
            job.settings.ambient_file.accuracy = finest;
    });
}

/// All views and grids of the project, or of its scene when the project has none.
Jobs jobs_of(const Project& project, const RunOptions& options, const LitScene& lit)
{
    const std::filesystem::path& folder = project.output.folder;
    const auto wanted = [&](const std::string& name) {
        return options.only.empty() || std::find(options.only.begin(), options.only.end(), name) != options.only.end();
    };
    const auto add_picture = [&](Jobs& jobs, const ProjectView& view) {
        const EffortWords effort = effort_of(project, options, picture_accuracy);
        PictureJob job{view.view,
                       picture_settings(effort, view.width, view.height),
                       folder / (view.view.name + ".exr"),
                       project.output.png,
                       project.output.hdr,
                       lit.provenance,
                       lit.report};
        job.time_s = effort.time_s;
        fit_to_view(job.view, job.settings);
        if (wanted(view.view.name))
            jobs.pictures.push_back(std::move(job));
    };
    const auto add_map = [&](Jobs& jobs, const SensorGrid& grid) {
        const EffortWords effort = effort_of(project, options, map_accuracy);
        MapJob job{grid, grid_settings(effort), {folder / (grid.name + ".csv")}, lit.provenance, lit.report};
        job.time_s = effort.time_s;
        if (grid.rows > 0)
            job.files.insert(job.files.end(), {folder / (grid.name + ".png"), folder / (grid.name + ".exr")});
        if (wanted(grid.name))
            jobs.maps.push_back(std::move(job));
    };
    Jobs jobs;
    for (const ProjectView& view : project.views)
        add_picture(jobs, view);
    for (const GridRequest& grid : project.grids)
        add_map(jobs, make_grid(grid, lit.scene));
    if (project.views.empty() && project.grids.empty()) {
        for (const View& view : lit.scene.views)
            add_picture(jobs, {view});
        for (const SensorGrid& grid : lit.scene.grids)
            add_map(jobs, grid);
    }
    share(jobs);
    return jobs;
}

/// @throws InputError when two results would take one name, or nothing is to be made
void check_jobs(const Jobs& jobs, const Project& project)
{
    std::vector<std::string> names;
    for (const PictureJob& job : jobs.pictures)
        names.push_back(job.file.stem().string());
    for (const MapJob& job : jobs.maps)
        names.push_back(job.files.front().stem().string());
    if (names.empty())
        throw InputError(project.file.string(), "nothing to make", "add a [[view]] or a [[grid]] of that name");
    std::sort(names.begin(), names.end());
    const auto twice = std::adjacent_find(names.begin(), names.end());
    if (twice != names.end())
        throw InputError(project.file.string(), "two results have the name \"" + *twice + "\"",
                         "give each view and grid a name of its own");
}

Status run_project(const RunOptions& options, std::ostream& out, std::ostream& err)
{
    Project project = read_project(options.project);
    if (!options.folder.empty())
        project.output.folder = options.folder;
    LitScene lit = light_scene(inputs_of(project));
    err << lit.report;
    const Jobs jobs = jobs_of(project, options, lit);
    check_jobs(jobs, project);
    if (lit.provenance.contains("sky"))
        out << lit.provenance["sky"] << '\n';
    std::error_code told_by_the_writer; // which names the folder that is missing
    std::filesystem::create_directories(project.output.folder, told_by_the_writer);
    const Simulation simulation(std::move(lit.scene), options.effort.preparation);
    catch_interrupts();
    Status status = Status::done;
    for (std::size_t i = 0; i < jobs.maps.size() && status == Status::done; ++i)
        status = make_map(simulation, jobs.maps[i], out, err);
    for (std::size_t i = 0; i < jobs.pictures.size() && status == Status::done; ++i)
        status = make_picture(simulation, jobs.pictures[i], out, err);
    return status;
}

} // namespace

/// lightwell run PROJECT: all maps and pictures of a project, a line each with the accuracy and the time.
/// Status 1 when interrupted.
void add_run(CLI::App& app, Status& status)
{
    auto options = std::make_shared<RunOptions>();
    CLI::App& command = *app.add_subcommand("run", "all views and grids of a project file");
    command.add_option("project", options->project, "project file, PROJECT.toml")->required();
    command.add_option("-o,--output", options->folder, "folder for the results, instead of the project's")
        ->type_name("FOLDER");
    command.add_option("--only", options->only, "name of a view or grid; may be given several times")
        ->type_name("NAME");
    add_effort_words(command, options->effort, picture_accuracy);
    add_unbiased_flag(command, options->effort);
    add_time_words(command, options->effort, nullptr);
    add_ambient_file(command, options->effort);
    add_secondary_words(command, options->effort);
    command.footer(examples);
    command.callback([options, &status, &command] {
        check_effort(options->effort);
        options->seed_given = command.count("--seed") > 0;
        status = run_project(*options, std::cout, std::cerr);
    });
}

} // namespace lightwell
