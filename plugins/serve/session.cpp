#include "plugins/serve/session.h"

#include "engine/scene/scene_hash.h"
#include "plugins/cli/forecast.h"
#include "plugins/cli/plan_text.h"
#include "plugins/cli/scene_input.h"
#include "plugins/serve/scene_summary.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace lightwell::serve {
namespace {

/// What pictures and grids are made to when the host does not say.
constexpr double usual_accuracy = 0.05;

bool same_names(const Part& a, const Part& b)
{
    return std::equal(a.surfaces.begin(), a.surfaces.end(), b.surfaces.begin(), b.surfaces.end(),
                      [](const Surface& x, const Surface& y) { return x.name == y.name; });
}

template <class Named>
const Named* find_named(const std::vector<Named>& list, const std::string& name)
{
    const auto found = std::find_if(list.begin(), list.end(), [&](const Named& entry) { return entry.name == name; });
    return found == list.end() ? nullptr : &*found;
}

} // namespace

GridSettings grid_settings_of(const Request& request)
{
    GridSettings settings;
    settings.accuracy = request.accuracy > 0 ? request.accuracy : usual_accuracy;
    settings.samples = request.samples;
    settings.seed = request.seed;
    settings.threads = request.threads;
    settings.ambient_file = {request.ambient_file, settings.accuracy};
    return settings;
}

void Session::run(const Request& request, Told& told)
{
    switch (request.task) {
    case Request::Task::load:
        return load(request, told);
    case Request::Task::edit:
        return edit(request, told);
    case Request::Task::plan:
        return plan(request, told);
    case Request::Task::render:
        return render(request, told);
    case Request::Task::illuminance:
        return illuminance(request, told);
    case Request::Task::surfaces:
        return surfaces(request, told);
    case Request::Task::cancel:
    case Request::Task::quit:
        break;
    }
}

void Session::load(const Request& request, Told& told)
{
    loaded_.reset(); // two scenes at once may be too large
    file_ = request.scene;
    map_ = request.map;
    read_scene(told);
    tell_scene(told, nullptr);
}

void Session::edit(const Request&, Told& told)
{
    if (file_.empty())
        throw InputError("edit", "no scene is loaded", "load one first");
    const Kept kept = read_scene(told);
    tell_scene(told, &kept);
}

Scene Session::read_files(Loaded& fresh)
{
    if (is_scene_text(file_) && map_.empty()) {
        fresh.provenance["scene"] = file_.string();
        return read_radiance(file_, fresh.report, meshes_, fresh.origins);
    }
    SceneInputs inputs;
    inputs.files = {file_};
    inputs.map = map_;
    LitScene lit = light_scene(inputs);
    fresh.report = std::move(lit.report);
    fresh.provenance = std::move(lit.provenance);
    return std::move(lit.scene);
}

/// Whether light, names and layers are as before, so that all that was made for them still serves.
bool Session::same_light(const Scene& scene, const Loaded& fresh) const
{
    if (!loaded_ || !loaded_->simulation)
        return false;
    const Scene& before = loaded_->simulation->scene();
    const SceneFingerprint a = scene_fingerprint(before), b = scene_fingerprint(scene);
    bool same = a.geometry == b.geometry && a.assignment == b.assignment && a.modifiers == b.modifiers &&
                loaded_->origins.objects == fresh.origins.objects && same_names(before.root, scene.root);
    for (std::size_t i = 0; same && i < scene.prototypes.size(); ++i)
        same = same_names(before.prototypes[i], scene.prototypes[i]);
    return same;
}

Session::Kept Session::read_scene(Told& told)
{
    Loaded fresh;
    told.events().progress(told.id(), 0, "reading " + file_.filename().string(), std::nullopt);
    Scene scene = read_files(fresh);
    told.check();
    validate(scene);
    told.check();
    fresh.views = scene.views;
    fresh.grids = scene.grids;
    Kept kept{meshes_.counts().kept, meshes_.counts().read, same_light(scene, fresh)};
    if (kept.light) {
        fresh.simulation = std::move(loaded_->simulation);
    } else {
        told.events().progress(told.id(), 0.5, "making the scene ready for light", std::nullopt);
        if (loaded_)
            loaded_->simulation.reset();
        fresh.simulation.emplace(std::move(scene), Preparation{});
    }
    fresh.layers = layers_of(fresh.simulation->scene(), fresh.origins);
    loaded_ = std::move(fresh);
    return kept;
}

void Session::tell_scene(Told& told, const Kept* kept)
{
    const Scene& scene = loaded_->simulation->scene();
    // Views and grids are those of the last reading.
    std::string members =
        scene_members(scene, loaded_->origins, loaded_->layers, loaded_->views, loaded_->grids, loaded_->report);
    if (kept != nullptr)
        members += ",\"kept\":" + nlohmann::ordered_json{{"mesh_files", kept->mesh_files},
                                                         {"read_files", kept->read_files},
                                                         {"light", kept->light}}
                                      .dump();
    told.events().result(told.id(), "scene", members);
}

const Simulation& Session::simulation() const
{
    if (!loaded_ || !loaded_->simulation)
        throw InputError("request", "no scene is loaded", "load one first");
    return *loaded_->simulation;
}

const Simulation& Session::lit_simulation() const
{
    const Simulation& ready = simulation();
    require_light(ready.scene(), file_.string());
    return ready;
}

View Session::view_of(const std::string& text) const
{
    const View* known = find_named(loaded_->views, text);
    return known != nullptr ? *known : choose_view(text, simulation().scene());
}

SensorGrid Session::grid_of(const std::string& text) const
{
    const SensorGrid* known = find_named(loaded_->grids, text);
    return known != nullptr ? *known : choose_grid(text, simulation().scene());
}

void Session::plan(const Request& request, Told& told)
{
    const Simulation& ready = lit_simulation();
    Forecast expected;
    expected.wanted_accuracy = request.accuracy > 0 ? request.accuracy : usual_accuracy;
    if (request.grid.empty()) {
        PictureSettings settings = picture_job(request).settings;
        expected.of = "view " + request.view;
        expected.prediction = predict(ready, view_of(request.view), settings, usual_pilot_rays, told.part());
    } else {
        const SensorGrid grid = grid_of(request.grid);
        expected.of = "grid " + grid.name;
        expected.prediction = predict(ready, grid, grid_settings_of(request), usual_pilot_rays, told.part());
    }
    const auto json = nlohmann::ordered_json::parse(plan_json(ready.plan(), expected, std::nullopt));
    told.events().result(told.id(), "plan", "\"plan\":" + json.dump());
}

PictureJob Session::picture_job(const Request& request) const
{
    PictureJob job;
    job.view = view_of(request.view);
    job.settings.width = request.width;
    job.settings.height = request.height;
    job.settings.region = request.region;
    job.settings.samples = request.samples;
    job.settings.accuracy = request.accuracy > 0 ? request.accuracy : usual_accuracy;
    job.settings.seed = request.seed;
    job.settings.threads = request.threads;
    job.settings.ambient_file = {request.ambient_file, job.settings.accuracy};
    job.time_s = request.seconds;
    job.file = request.file;
    job.provenance = loaded_->provenance;
    wanted_pixels(job.settings); // refuses a region that is not in the picture
    return job;
}

void Session::illuminance(const Request& request, Told& told)
{
    const Simulation& ready = lit_simulation();
    MapJob job;
    job.grid = grid_of(request.grid);
    job.settings = grid_settings_of(request);
    job.time_s = request.seconds;
    job.files = {request.file};
    job.provenance = loaded_->provenance;
    job.report = loaded_->report;
    check_map_files(job);
    const GridResult result = measure_map(ready, job, told.part());
    const MapSummary s = summarize(result);
    const nlohmann::ordered_json json = {
        {"mean", s.mean},           {"mean_error", s.mean_error},     {"min", s.minimum},
        {"max", s.maximum},         {"uniformity", s.uniformity},     {"error", result.median_relative_error},
        {"bias", result.bias.mean}, {"points", result.values.size()}, {"samples", result.samples},
        {"seconds", result.seconds}};
    told.events().result(told.id(), "grid",
                         "\"file\":" + quoted(request.file) + "," + json.dump().substr(1, json.dump().size() - 2) +
                             "," + notes_member(result.report));
}

} // namespace lightwell::serve
