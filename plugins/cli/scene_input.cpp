#include "plugins/cli/scene_input.h"

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/text.h"
#include "engine/scene/add_sky.h"
#include "importers/formats/formats.h"
#include "importers/layers.h"
#include "importers/radiance/radiance.h"

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

void require_light(const Scene& scene, const std::string& file)
{
    const bool emits = std::any_of(scene.modifiers.begin(), scene.modifiers.end(), [](const Modifier& modifier) {
        const auto* material = std::get_if<Material>(&modifier.what);
        return material != nullptr && is_emitter(*material) && !emitted_radiance(*material).is_black();
    });
    if (!emits)
        throw InputError(file, "nothing in the scene emits light",
                         "add --sky clear --place LAT,LON --time ISO, or map a layer to an emitting material");
}

Scene read_cad(const SceneWords& words, LitScene& lit)
{
    Imported imported = import_file(words.file, import_options(words.import));
    apply_layer_map(imported, words.map.empty() ? LayerMap{} : read_layer_map(words.map));
    lit.report.add(imported.report);
    lit.provenance["unit"] = imported.unit;
    return std::move(imported.scene);
}

} // namespace

bool is_scene_text(const std::string& file)
{
    const std::string extension = lowercase_ascii(std::filesystem::path(file).extension().string());
    return extension == ".rad" || extension == ".mat";
}

LitScene load_scene(const SceneWords& words)
{
    LitScene lit;
    if (is_scene_text(words.file)) {
        if (!words.map.empty())
            throw InputError("--map", "\"" + words.file + "\" is a scene description, whose layers have materials",
                             "leave --map out, or give the CAD file");
        lit.scene = read_radiance(words.file, lit.report);
    } else {
        lit.scene = read_cad(words, lit);
    }
    lit.provenance["scene"] = words.file;
    if (!words.map.empty())
        lit.provenance["map"] = words.map;
    if (!words.sky.type.empty()) {
        const DescribedSky sky = sky_of(words.sky);
        add_sky(lit.scene, sky.model);
        lit.provenance["sky"] = sky.description;
    }
    require_light(lit.scene, words.file);
    return lit;
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
