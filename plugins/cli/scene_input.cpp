#include "plugins/cli/scene_input.h"

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/text.h"
#include "importers/formats/formats.h"
#include "importers/layers.h"
#include "importers/radiance/radiance.h"
#include "plugins/cli/host_calls.h"
#include "plugins/cli/merge_scenes.h"

#include <algorithm>

namespace lightwell {
namespace {

template <class Named>
std::string names_of(const std::vector<Named>& list)
{
    std::string names;
    for (const Named& entry : list)
        names += (names.empty() ? "\"" : ", \"") + entry.name + "\"";
    return names;
}

/// Says "the material that a scene description among the inputs defines".
const std::string scene_prefix = "scene:";

/// The plain materials of the scene descriptions, for rules of the layer map.
void offer_materials(Imported& drawings, const std::vector<Scene>& descriptions)
{
    for (const Scene& scene : descriptions)
        for (std::size_t id = 0; id < scene.modifiers.size(); ++id) {
            const ResolvedMaterial found = resolve(scene, static_cast<ModifierId>(id));
            if (found.material != nullptr && found.brightness == nullptr && !found.varies)
                drawings.file_materials.emplace_back(scene_prefix + scene.modifiers[id].name, *found.material);
        }
}

/// The CAD files among the inputs, under one layer map.
void add_drawings(const SceneInputs& inputs, const std::vector<Scene>& descriptions, LitScene& lit)
{
    Imported all;
    bool any = false;
    for (const std::filesystem::path& file : inputs.files) {
        if (is_scene_text(file))
            continue;
        Imported imported = import_file(file, inputs.import);
        if (any)
            append_import(all, imported);
        else
            all = std::move(imported);
        any = true;
    }
    if (!any && !inputs.map.empty())
        throw InputError(inputs.map.string(), "a layer map without a CAD file",
                         "layers of a scene description have their materials already: leave the map out");
    if (!any)
        return;
    offer_materials(all, descriptions);
    apply_layer_map(all, inputs.map.empty() ? LayerMap{} : read_layer_map(inputs.map));
    lit.report.add(all.report);
    lit.provenance["unit"] = all.unit;
    lit.scene = std::move(all.scene);
}

} // namespace

void require_light(const Scene& scene, const std::string& files)
{
    const bool emits = std::any_of(scene.modifiers.begin(), scene.modifiers.end(), [](const Modifier& modifier) {
        const auto* material = std::get_if<Material>(&modifier.what);
        return material != nullptr && is_emitter(*material) && !emitted_radiance(*material).is_black();
    });
    if (!emits)
        throw InputError(files, "nothing in the scene emits light",
                         "add a sky with its place and time, or map a layer to an emitting material");
}

bool is_scene_text(const std::filesystem::path& file)
{
    const std::string extension = lowercase_ascii(file.extension().string());
    return extension == ".rad" || extension == ".mat";
}

LitScene light_scene(const SceneInputs& inputs)
{
    LitScene lit;
    std::vector<Scene> descriptions;
    std::string files;
    for (const std::filesystem::path& file : inputs.files) {
        if (is_scene_text(file))
            descriptions.push_back(read_radiance(file, lit.report));
        files += (files.empty() ? "" : ", ") + file.string();
    }
    add_drawings(inputs, descriptions, lit);
    for (const Scene& scene : descriptions)
        append_scene(lit.scene, scene);
    lit.provenance["scene"] = files;
    if (!inputs.map.empty())
        lit.provenance["map"] = inputs.map.string();
    if (inputs.sky) {
        add_described_sky(lit.scene, *inputs.sky);
        lit.provenance["sky"] = inputs.sky->description;
    }
    require_light(lit.scene, files);
    return lit;
}

LitScene load_scene(const SceneWords& words)
{
    SceneInputs inputs{{words.file}, words.map, import_options(words.import), std::nullopt};
    if (!words.sky.type.empty())
        inputs.sky = sky_of(words.sky); // before the file is read: a wrong word should not take a minute to show
    return light_scene(inputs);
}

View choose_view(const std::string& text, const Scene& scene)
{
    for (const View& view : scene.views)
        if (view.name == text)
            return view;
    const std::string_view plain = trimmed(text);
    if (plain.starts_with("-") || plain.starts_with("VIEW=") || plain.starts_with("rvu"))
        return parse_view(text, "--view");
    std::error_code ignored;
    if (std::filesystem::is_regular_file(text, ignored)) {
        View view = parse_view(std::string(MappedFile(text).bytes()), text);
        view.name = std::filesystem::path(text).stem().string();
        return view;
    }
    throw InputError("--view", "\"" + text + "\" is neither a view of the scene, a file nor view words",
                     scene.views.empty() ? "the scene has no views; write \"-vp x y z -vd x y z -vh 60 -vv 40\""
                                         : "the scene has " + names_of(scene.views));
}

SensorGrid choose_grid(const std::string& text, const Scene& scene)
{
    for (const SensorGrid& grid : scene.grids)
        if (grid.name == text)
            return grid;
    if (text.find(':') == std::string::npos && !scene.grids.empty())
        throw InputError("--grid", "\"" + text + "\" is no grid of the scene", "it has " + names_of(scene.grids));
    return make_grid(parse_grid(text), scene);
}

} // namespace lightwell
