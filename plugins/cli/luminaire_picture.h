#pragma once

#include "engine/base/transform.h"
#include "engine/pictures/png.h"
#include "materials/photometry.h"

namespace lightwell {

/// A measured luminaire to look at: intensities in the planes 0-180 and 90-270 as a polar plot, and beside it the
/// luminous opening from the side and from above as it stands in the scene, with its aim and plane 0.
/// @param frame  from the luminaire's frame into the scene
DisplayPicture luminaire_picture(const Photometry& photometry, const Affine& frame);

/// A rotation whose -z is the aim and whose x axis (plane 0) is the scene's x axis as far as that allows, then turned
/// about the upward axis of the luminaire.
Affine luminaire_frame(const Vec3& aim, double turn_deg);

} // namespace lightwell
