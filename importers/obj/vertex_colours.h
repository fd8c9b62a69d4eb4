#pragma once

#include "importers/importer.h"
#include "importers/obj/obj_file.h"

namespace lightwell {

/// Colours of vertices (`v x y z r g b`) as materials: faces whose material is not described take a plastic of the mean
/// colour of their corners, weighed with area, one for each material name or, without a name, for each set of names.
/// The numbers are read as sRGB, as the programs that write them do; above 1 they count to 255.
/// @param file      receives names of the new materials where faces had none
/// @param imported  receives the materials and notes
void take_vertex_colours(ObjFile& file, Imported& imported);

} // namespace lightwell
