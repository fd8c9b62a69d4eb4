#pragma once

#include "importers/importer.h"

namespace lightwell {

/// Turns triangles back into what was drawn: those of one flat face become one polygon with its holes, unless
/// options.keep_triangles; with options.crease_angle_deg curved meshes without normals get them.
///
/// Triangles are joined that belong to the same key, lie in one plane and share whole edges walked in opposite
/// directions. Where the ledger counts entities by the names of their surfaces, only triangles of one name are joined,
/// so that its balance and the names stay. Meshes with normals or texture places keep their corners.
/// @throws InputError  a crease angle that is not in (0, 180] degrees
void recover_surfaces(Imported& imported, const ImportOptions& options);

} // namespace lightwell
