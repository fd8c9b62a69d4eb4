#pragma once

#include "engine/base/report.h"
#include "plugins/serve/faces.h"

#include <string>
#include <vector>

namespace lightwell::serve {

/// Names of the modifiers that faces have, in the order of the scene: the layers.
std::vector<std::string> layers_of(const Scene& scene, const SceneOrigins& origins);

/// Members of the result `scene`: faces, layers and objects with areas, bounds and corners, the names of views and
/// grids, notes.
std::string scene_members(const Scene& scene, const SceneOrigins& origins, const std::vector<std::string>& layers,
                          const std::vector<View>& views, const std::vector<SensorGrid>& grids, const Report& report);
/// `"notes":[...]`.
std::string notes_member(const Report& report);
/// A text as JSON, quotes included; what is not UTF-8 is read as the code page of CAD files.
std::string quoted(const std::string& text);

} // namespace lightwell::serve
