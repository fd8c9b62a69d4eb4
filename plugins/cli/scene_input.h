#pragma once

#include "engine/scene/scene.h"
#include "plugins/cli/options.h"
#include "plugins/cli/sky_words.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lightwell {

/// Where a scene to be lit comes from: a scene description (.rad) or a CAD file with a layer map and a sky.
struct SceneWords {
    std::string file, map;
    ImportWords import;
    SkyWords sky;
};

/// The same for any number of files, as a project has them.
struct SceneInputs {
    std::vector<std::filesystem::path> files;
    std::filesystem::path map;
    ImportOptions import;
    std::optional<DescribedSky> sky;
};

struct LitScene {
    Scene scene;
    Report report;
    std::map<std::string, std::string> provenance; ///< scene, map, unit, sky: for the header of results
};
/// Reads, maps and completes the scene; prints nothing.
/// @throws InputError also when nothing in the scene emits light
LitScene light_scene(const SceneInputs& inputs);
LitScene load_scene(const SceneWords& words);

/// True for `.rad` and `.mat`: read as scene description, everything else by the importers.
bool is_scene_text(const std::filesystem::path& file);

/// A view by its name in the scene, a file of view words, or the words themselves.
/// @throws InputError that lists the scene's views
View choose_view(const std::string& text, const Scene& scene);
/// A grid by its name in the scene, or in words (`layer:NAME@HEIGHT/SPACING`, ...).
SensorGrid choose_grid(const std::string& text, const Scene& scene);

} // namespace lightwell
