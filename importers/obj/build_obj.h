#pragma once

#include "engine/base/transform.h"
#include "importers/importer.h"
#include "importers/obj/obj_file.h"

#include <map>

namespace lightwell {

/// Faces become polygons, faces with smooth normals and warped faces become meshes, one for each set of names.
/// @param to_metres  file coordinates to metres, z up
/// @param colours    Kd of the file's materials by name, linear Rec.709
/// @param imported   receives surfaces, keys, ledger and notes
void build_obj(const ObjFile& file, const Affine& to_metres, const std::map<std::string, Spectrum>& colours,
               Imported& imported);

} // namespace lightwell
