#include "plugins/serve/scene_summary.h"

#include "engine/base/text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace lightwell::serve {
namespace {

using Json = nlohmann::ordered_json;

/// Faces that belong together.
struct Group {
    std::size_t faces = 0, meshes = 0, round = 0;
    double area_m2 = 0;
    Box box;
    std::map<std::uint32_t, std::size_t> corners; ///< faces by number of corners

    void add(const PlacedFace& face)
    {
        ++faces;
        area_m2 += face.area_m2();
        box.extend(face.bounds());
        if (face.corners > 0)
            ++corners[face.corners];
        else
            ++(face.surface->shape == Shape::mesh ? meshes : round);
    }
    Json json(const std::string& name) const
    {
        Json json = {{"name", to_utf8(name)}, {"faces", faces}, {"area_m2", area_m2}};
        if (!box.empty()) {
            json["low"] = {box.low.x, box.low.y, box.low.z};
            json["high"] = {box.high.x, box.high.y, box.high.z};
        }
        for (const auto& [count, number] : corners)
            json["corners"][std::to_string(count)] = number;
        if (round > 0)
            json["round"] = round;
        if (meshes > 0)
            json["meshes"] = meshes;
        return json;
    }
};

std::string member(const char* name, const Json& value)
{
    return Json(name).dump() + ":" + value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

const std::string& name_of(const Scene& scene, ModifierId modifier)
{
    return scene.modifiers[static_cast<std::size_t>(modifier)].name;
}

template <class Named>
Json names_of(const std::vector<Named>& list)
{
    Json names = Json::array();
    for (const Named& entry : list)
        names.push_back(to_utf8(entry.name));
    return names;
}

} // namespace

std::vector<std::string> layers_of(const Scene& scene, const SceneOrigins& origins)
{
    std::vector<bool> used(scene.modifiers.size(), false);
    visit_faces(scene, origins,
                [&](std::size_t, const PlacedFace& face) { used[static_cast<std::size_t>(face.modifier)] = true; });
    std::vector<std::string> layers;
    for (std::size_t i = 0; i < used.size(); ++i)
        if (used[i] && std::find(layers.begin(), layers.end(), scene.modifiers[i].name) == layers.end())
            layers.push_back(scene.modifiers[i].name);
    return layers;
}

std::string scene_members(const Scene& scene, const SceneOrigins& origins, const std::vector<std::string>& layers,
                          const std::vector<View>& views, const std::vector<SensorGrid>& grids, const Report& report)
{
    Group all;
    std::map<std::string, Group> by_layer, by_object;
    std::vector<std::string> objects; // in order of appearance
    visit_faces(scene, origins, [&](std::size_t root_surface, const PlacedFace& face) {
        all.add(face);
        by_layer[name_of(scene, face.modifier)].add(face);
        const std::string& object = object_of(scene, origins, root_surface);
        const auto [entry, fresh] = by_object.try_emplace(object);
        if (fresh)
            objects.push_back(object);
        entry->second.add(face);
    });
    Json listed_layers = Json::array(), listed_objects = Json::array();
    for (const std::string& layer : layers)
        listed_layers.push_back(by_layer[layer].json(layer));
    for (const std::string& object : objects)
        listed_objects.push_back(by_object[object].json(object));
    return member("surfaces", all.faces) + "," + member("area_m2", all.area_m2) + "," +
           member("prototypes", scene.prototypes.size()) + "," + member("layers", listed_layers) + "," +
           member("parts", listed_objects) + "," + member("views", names_of(views)) + "," +
           member("grids", names_of(grids)) + "," + notes_member(report);
}

std::string notes_member(const Report& report)
{
    Json notes = Json::array();
    for (const Note& note : report.notes())
        notes.push_back({{"finding", to_string(note.finding)},
                         {"place", to_utf8(note.place)},
                         {"text", to_utf8(note.text)},
                         {"count", note.count}});
    return member("notes", notes);
}

std::string quoted(const std::string& text)
{
    return Json(to_utf8(text)).dump(-1, ' ', false, Json::error_handler_t::replace);
}

} // namespace lightwell::serve
