#include "tests/unit/radiance/scene_folder.h"

#include "engine/base/text.h"
#include "importers/radiance/material_text.h"
#include "importers/radiance/place_surface.h"

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace lightwell {

SceneFolder::SceneFolder()
{
    static std::atomic<int> count{0};
    folder_ = std::filesystem::temp_directory_path() /
              ("lightwell-radiance-" + std::to_string(getpid()) + "-" + std::to_string(++count));
    std::filesystem::create_directories(folder_);
}

SceneFolder::~SceneFolder()
{
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

std::filesystem::path SceneFolder::write(const std::string& name, const std::string& text) const
{
    std::filesystem::create_directories(path(name).parent_path());
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
}

std::string SceneFolder::text(const std::string& name) const
{
    std::ostringstream text;
    text << std::ifstream(path(name), std::ios::binary).rdbuf();
    return text.str();
}

Scene SceneFolder::read(const std::string& text, Report& report) const
{
    Scene scene = read_radiance(write("scene.rad", text), report);
    validate(scene);
    return scene;
}

Scene SceneFolder::read(const std::string& text) const
{
    Report report;
    return read(text, report);
}

std::string SceneFolder::error(const std::string& text) const
{
    try {
        read(text);
    } catch (const InputError& error) {
        const std::string message = error.what(), folder = folder_.string() + "/";
        return message.starts_with(folder) ? message.substr(folder.size()) : message;
    }
    return "";
}

std::string describe(const Scene& scene, ModifierId modifier)
{
    const ResolvedMaterial resolved = resolve(scene, modifier);
    std::string text;
    if (resolved.brightness != nullptr)
        scene_text::append_sky_brightness(text, "void", "sky", *resolved.brightness);
    if (resolved.material != nullptr)
        scene_text::append_material(text, "void", "material", *resolved.material);
    return text;
}

std::vector<WorldSurface> world_surfaces(const Scene& scene)
{
    std::vector<WorldSurface> list;
    visit_expanded(scene, [&](const Part& from, const Surface& surface, const Affine& to_world, ModifierId modifier) {
        Part image;
        Report report;
        scene_text::add_image(image, from, surface, to_world, modifier, surface.name, 1e-3, report);
        for (const Surface& piece : image.surfaces) {
            WorldSurface found;
            found.name = piece.name;
            found.type = std::to_string(static_cast<int>(piece.shape));
            found.modifier =
                modifier == void_modifier ? "void" : scene.modifiers[static_cast<std::size_t>(modifier)].name;
            found.material = describe(scene, modifier);
            const auto add = [&](const Vec3& v) { found.numbers.insert(found.numbers.end(), {v.x, v.y, v.z}); };
            for (const Point& p : image.points)
                if (piece.shape == Shape::polygon)
                    add(p);
            for (const Sphere& s : image.spheres) {
                add(s.centre);
                found.numbers.push_back(s.radius);
            }
            for (const Cone& c : image.cones) {
                add(c.ends[0]);
                add(c.ends[1]);
                found.numbers.insert(found.numbers.end(), {c.radii[0], c.radii[1]});
            }
            for (const Ring& r : image.rings) {
                add(r.centre);
                add(r.normal);
                found.numbers.insert(found.numbers.end(), {r.inner_radius, r.outer_radius});
            }
            for (const DistantSource& s : image.sources) {
                add(s.to_source);
                found.numbers.push_back(s.full_angle_deg);
            }
            for (const auto& mesh : image.meshes)
                for (const std::uint32_t corner : mesh->triangles) {
                    add(mesh->points[corner]);
                    if (!mesh->normals.empty())
                        add(mesh->normals[corner]);
                    if (!mesh->texture.empty())
                        found.numbers.insert(found.numbers.end(),
                                             {mesh->texture[2 * corner], mesh->texture[2 * corner + 1]});
                }
            list.push_back(std::move(found));
        }
    });
    return list;
}

std::filesystem::path shared_data()
{
    const char* const elsewhere = std::getenv("LIGHTWELL_SHARED");
    const std::filesystem::path folder = elsewhere != nullptr ? elsewhere : LIGHTWELL_ROOT "/../shared";
    return std::filesystem::is_directory(folder) ? folder : std::filesystem::path{};
}

} // namespace lightwell
