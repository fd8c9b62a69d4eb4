#pragma once

#include "importers/importer.h"

#include <string>
#include <vector>

namespace lightwell {

/// Corners of one face, front counter-clockwise.
using Face = std::vector<Point>;

/// A surface as faces: a polygon as it is, a mesh triangle by triangle, round shapes as facets whose edges lie on the
/// shape, within the tolerance.
/// @param[out] approximated  set when the faces are facets of a round shape
std::vector<Face> faces_of(const Part& part, const Surface& surface, double chord_tolerance_m, bool& approximated);

/// The images of faces; under a mirrored map corners run the other way round, so that the front stays the front.
void map_faces(std::vector<Face>& faces, const Affine& map);

/// Layer, block, colour and names of what a modifier stands for, before and after a layer map.
const SurfaceKey& key_of(const Imported& model, ModifierId modifier);
/// The name of its material in the scene or the file; empty: none.
std::string material_name_of(const Imported& model, ModifierId modifier);
/// Its material, assigned or described by the file; nullptr: none.
const Material* material_of(const Imported& model, ModifierId modifier);
/// Reflectance, transmissivity or colour to show for it, linear Rec.709 in [0, 1]; the key's colour without a material.
Spectrum shown_colour(const Imported& model, ModifierId modifier);

} // namespace lightwell
