#include "plugins/serve/host_picture.h"

#include "engine/base/threads.h"

#include <cmath>
#include <unordered_map>

namespace lightwell::serve {
namespace {

/// What Blender's own engines write where nothing is met.
constexpr float far_away_m = 1e10f;

constexpr const char* units =
    "Combined: W/(m^2 sr), 179 lm/W, linear Rec.709; Illuminance: lx on the first surface, viewer's side; Luminance, "
    "Error (one standard error): cd/m^2; Depth: m along the ray; Normal: unit, world; ObjectLayer: number of the layer";
constexpr const char* rec709_text = "0.64 0.33 0.3 0.6 0.15 0.06 0.3127 0.329";

std::vector<float> layer_of_modifier(const Scene& scene, const std::vector<std::string>& layers)
{
    std::unordered_map<std::string, float> index;
    for (std::size_t i = 0; i < layers.size(); ++i)
        index.emplace(layers[i], static_cast<float>(i));
    std::vector<float> found;
    for (const Modifier& modifier : scene.modifiers) {
        const auto entry = index.find(modifier.name);
        found.push_back(entry == index.end() ? -1 : entry->second);
    }
    return found;
}

} // namespace

std::vector<float> layer_indices(const Scene& scene, const RayQueries& rays, const View& view,
                                 const PictureSettings& settings, const std::vector<std::string>& layers,
                                 const std::function<void()>& check)
{
    const std::vector<float> layer_of = layer_of_modifier(scene, layers);
    const Camera camera(view);
    const Tile wanted = wanted_pixels(settings);
    std::vector<float> indices(static_cast<std::size_t>(wanted.width) * static_cast<std::size_t>(wanted.height), -1);
    parallel_for(static_cast<std::size_t>(wanted.height), settings.threads, [&](std::size_t row) {
        check();
        for (int column = 0; column < wanted.width; ++column) {
            ViewRay start;
            const double x = (wanted.x + column + 0.5) / settings.width;
            const double y = 1 - (wanted.y + static_cast<double>(row) + 0.5) / settings.height;
            Hit hit;
            if (!camera.ray(x, y, start) || !rays.closest({start.origin, start.direction, start.reach_m}, hit))
                continue;
            if (hit.modifier != void_modifier)
                indices[row * static_cast<std::size_t>(wanted.width) + static_cast<std::size_t>(column)] =
                    layer_of[static_cast<std::size_t>(hit.modifier)];
        }
    });
    return indices;
}

Picture host_picture(const Picture& picture, const std::string& layer, const std::vector<float>& indices)
{
    Picture host{picture.width, picture.height, {}, picture.header, picture.place};
    host.header["units"] = units;
    host.header["chromaticities"] = rec709_text;
    const auto& from = picture.channels;
    const std::vector<float>&own_red = from.at("R"), &own_green = from.at("G"), &own_blue = from.at("B"),
          &distance = from.at("Z");
    const auto channel = [&](const char* name) -> std::vector<float>& { return host.add_channel(layer + "." + name); };
    auto &red = channel("Combined.R"), &green = channel("Combined.G"), &blue = channel("Combined.B");
    auto &luminance = channel("Luminance.X"), &depth = channel("Depth.Z");
    for (std::size_t i = 0; i < red.size(); ++i) {
        const Spectrum own{own_red[i], own_green[i], own_blue[i]}, colour = to_rec709(own);
        red[i] = static_cast<float>(colour.r);
        green[i] = static_cast<float>(colour.g);
        blue[i] = static_cast<float>(colour.b);
        luminance[i] = static_cast<float>(luminance_of(own).value);
        const float metres = distance[i];
        depth[i] = std::isfinite(metres) ? metres : far_away_m;
    }
    channel("Combined.A").assign(red.size(), 1);
    channel("Illuminance.X") = from.at("illuminance.Y");
    channel("Error.X") = from.at("error.Y");
    channel("Normal.X") = from.at("N.X");
    channel("Normal.Y") = from.at("N.Y");
    channel("Normal.Z") = from.at("N.Z");
    channel("ObjectLayer.X") = indices;
    return host;
}

} // namespace lightwell::serve
