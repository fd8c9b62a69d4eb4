#pragma once

#include "engine/pictures/picture.h"
#include "engine/scene/view.h"

#include <string>
#include <vector>

namespace lightwell {

/// What each pixel leaves for sharing, beside the channels of the result: "rest.C" = radiance without the diffusely
/// scattered indirect light, "indirect.C" = indirect irradiance, "reflectance.C" = diffuse reflectance, with C of
/// R, G, B; "error.rest.*" and "error.indirect.*" with R, G, B, Y, standard errors; "closeness" 1/m.
const std::vector<std::string>& sharing_channels();

/// Replaces each pixel's indirect irradiance by a mean over the pixels around it that lie on the same surface, no
/// farther than a share of the harmonic mean distance to other surfaces: every pixel is a record of an irradiance
/// cache. Writes R, G, B, error.R/G/B/Y and removes the sharing channels.
/// Error: biased where indirect irradiance bends within the shared distance; the return value is its measure
/// @return root mean square over tiles of the relative change of the tile's mean luminance, noise subtracted
/// Source  Ward, Rubinstein, Clear 1988 (split-sphere error: distance / harmonic mean distance, turn of the normal)
double share_irradiance(Picture& picture, const Camera& camera, int threads);

} // namespace lightwell
