#include "engine/base/text.h"
#include "engine/control/work_count.h"
#include "plugins/cli/options.h"
#include "plugins/cli/provenance.h"
#include "plugins/serve/face_results.h"
#include "plugins/serve/scene_summary.h"
#include "plugins/serve/session.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace lightwell::serve {
namespace {

/// Sensors of one request, both sides: more is a slip of the spacing, not a wish.
constexpr std::size_t most_sensors = 4'000'000;

std::string listed(const std::vector<std::string>& names)
{
    std::string text;
    for (const std::string& name : names)
        text += (text.empty() ? "\"" : ", \"") + name + "\"";
    return text;
}

/// @throws InputError when nothing matches, or there would be too many sensors
std::vector<ChartedFace> chart_faces(const Scene& scene, const SceneOrigins& origins, const Request& request,
                                     const Told& told)
{
    std::vector<ChartedFace> faces;
    std::size_t sensors = 0, last_root_surface = scene.root.surfaces.size();
    bool wanted = false;
    visit_faces(scene, origins, [&](std::size_t root_surface, const PlacedFace& face) {
        const std::string& object = object_of(scene, origins, root_surface);
        told.check();
        if (root_surface != last_root_surface) {
            last_root_surface = root_surface;
            wanted = std::any_of(request.parts.begin(), request.parts.end(),
                                 [&](const std::string& glob) { return glob == object || matches(glob, object); });
        }
        if (!wanted)
            return;
        SurfaceChart chart = surface_chart(*face.part, *face.surface, face.to_world, request.spacing_m, face.triangles);
        if (chart.sensors.empty())
            return; // no area, no light
        sensors += 2 * chart.sensors.size();
        if (sensors > most_sensors)
            throw InputError("surfaces",
                             "a spacing of " + shortest(request.spacing_m) + " m asks for more than " +
                                 std::to_string(most_sensors) + " sensors",
                             "use a wider spacing, or fewer objects at a time");
        chart.id = face.id;
        chart.layer = scene.modifiers[static_cast<std::size_t>(face.modifier)].name;
        faces.push_back({std::move(chart), object, face.number});
    });
    if (faces.empty())
        throw InputError("surfaces", "no object with an area is named " + listed(request.parts),
                         "the result of `load` lists the objects; leave \"parts\" out for all");
    return faces;
}

} // namespace

void Session::surfaces(const Request& request, Told& told)
{
    const Simulation& ready = lit_simulation();
    FaceResults results{chart_faces(ready.scene(), loaded_->origins, request, told), request.spacing_m,
                        program_version()};
    GridSettings settings = grid_settings_of(request);
    const SensorGrid sensors = results.sensors();
    if (request.seconds > 0) {
        const WorkCount work =
            work_within(request.seconds * processors(request.threads), ready, sensors, settings, told.part(0, 0.1));
        settings.accuracy = work.accuracy;
        settings.samples = work.samples;
    }
    const GridResult result = ready.illuminance(sensors, settings, told.part(request.seconds > 0 ? 0.1 : 0, 1));
    results.write(request.file, result);
    const std::string json =
        nlohmann::ordered_json{{"faces", results.faces.size()}, {"points", sensors.sensors.size()},
                               {"samples", result.samples},     {"error", result.median_relative_error},
                               {"bias", result.bias.mean},      {"seconds", result.seconds}}
            .dump();
    told.events().result(told.id(), "surfaces",
                         "\"file\":" + quoted(request.file) + "," + json.substr(1, json.size() - 2) + "," +
                             notes_member(result.report));
}

} // namespace lightwell::serve
