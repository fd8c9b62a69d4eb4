#include "importers/gltf/gltf_views.h"

#include "engine/base/errors.h"

#include <cmath>

namespace lightwell {

/// Source  glTF 2.0 specification, 3.10: a camera looks along -z of its node, y is up
void add_view(const GltfCamera& camera, const std::string& name, const Affine& to_world, const std::string& place,
              Imported& imported)
{
    View view;
    view.name = !name.empty() ? name : !camera.name.empty() ? camera.name : std::string("camera");
    view.position = to_world.translation;
    view.direction = normalized(-to_world.z);
    view.up = normalized(to_world.y);
    if (camera.perspective) {
        double aspect = camera.aspect;
        if (!(aspect > 0)) {
            imported.report.add(Finding::assumed, place, "camera without aspect ratio: 3:2");
            aspect = 1.5;
        }
        view.vertical = camera.vertical_rad / radians_per_degree;
        view.horizontal = 2 * std::atan(std::tan(camera.vertical_rad / 2) * aspect) / radians_per_degree;
    } else {
        view.kind = View::Kind::parallel;
        view.horizontal = 2 * std::fabs(camera.half_width) * length(to_world.x);
        view.vertical = 2 * std::fabs(camera.half_height) * length(to_world.y);
    }
    try {
        Camera check(view);
        imported.scene.views.push_back(std::move(view));
    } catch (const InputError& error) {
        imported.report.add(Finding::ignored, place, std::string("camera left out: ") + error.what());
    }
}

} // namespace lightwell
