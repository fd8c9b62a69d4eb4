#pragma once

#include "engine/scene/scene.h"
#include "materials/photometry.h"

namespace lightwell {

/// How a measured luminaire stands in a scene.
struct LuminaireLook {
    std::string name = "luminaire"; ///< of the part and, with endings, of its modifiers
    /// Eyes see the luminous opening. Else it is an `illum` that they look through, to the body as it is drawn.
    bool seen = true;
    double share = 1; ///< factor on the light: what lamps give when they are tilted
    /// Half the extent of a body about the origin that must not stand in the way: flat openings are moved in front of
    /// it, others are made to hold it. 0: no body.
    Vec3 body{};
    Spectrum colour = Spectrum::grey(1); ///< of the light; of luminance 1 the intensities are those of the file
};

/// A measured luminaire as a part of its own, to be placed by instances: the luminous opening as surfaces whose
/// radiance is the intensity over the area that a viewer sees.
///
/// Openings that send no light upwards or none downwards are flat: the box or cylinder of the file is then its lower or
/// upper end. A point is a ball of 2 cm. Ellipses are polygons of the same area, ellipsoids and cylinders that are not
/// round are boxes, with a note.
/// Frame  Photometry's: z up, the light goes towards -z, plane 0 looks along +x
/// Error  of the flux: what the table loses between its angles (tests/unit/luminaire: 0.5 %)
/// @param scene  gets the modifiers NAME.distribution and NAME.light
Part luminaire_part(Scene& scene, const Photometry& photometry, const LuminaireLook& look, Report& report);

} // namespace lightwell
