#pragma once

#include "engine/scene/scene.h"
#include "materials/photometry.h"

namespace lightwell {

/// The body whose visible area intensity is divided by, to become radiance.
struct EmittingBody {
    enum class Kind { flat, ball, box, cylinder } kind = Kind::flat;
    double area_m2 = 0;               ///< of a flat one; of the disc that a ball shows
    double x_m = 0, y_m = 0, z_m = 0; ///< of a box; of a cylinder x is the diameter and z the length
    int axis = 2;                     ///< of a cylinder: 0, 1, 2 for x, y, z
};

/// The radiance of a luminous opening by direction, as the pattern `brightdata` has it, W/(m^2 sr).
/// Frame  the luminaire's
/// Source Radiance reference manual, `brightdata`; source.cal
std::shared_ptr<const PlaceFunction> light_distribution(const Photometry& photometry, const EmittingBody& body,
                                                        double share, const std::string& name);

} // namespace lightwell
