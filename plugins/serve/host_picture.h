#pragma once

#include "engine/accel/ray_queries.h"
#include "engine/simulate/simulate.h"

#include <functional>
#include <string>
#include <vector>

namespace lightwell::serve {

/// Which layer each pixel shows: index into `layers`, or -1 where nothing is met.
/// @param rays   of the scene
/// @param check  called often; throws to stop
std::vector<float> layer_indices(const Scene& scene, const RayQueries& rays, const View& view,
                                 const PictureSettings& settings, const std::vector<std::string>& layers,
                                 const std::function<void()>& check);

/// The picture with the channels that Blender looks for: LAYER.Combined.R/G/B/A in W/(m^2 sr), linear Rec.709;
/// LAYER.Illuminance.X in lx, LAYER.Luminance.X and its standard error LAYER.Error.X in cd/m^2, LAYER.Depth.Z in m
/// (1e10: nothing met), LAYER.Normal.X/Y/Z, LAYER.ObjectLayer.X.
/// @param indices  of layer_indices()
Picture host_picture(const Picture& picture, const std::string& layer, const std::vector<float>& indices);

} // namespace lightwell::serve
