#pragma once

#include "engine/base/quantities.h"
#include "importers/dxf/drawing.h"
#include "importers/importer.h"

namespace lightwell::dxf {

/// Fills imported.scene, keys, ledger and report from a drawing: blocks become prototypes, inserts instances.
/// @param options  its chord tolerance, > 0, holds in the model (copies of blocks scaled), and so do the heights that
///                 layers are raised by; the unit stands beside it
/// @throws InputError: blocks that contain themselves, too many copies, vertex indices out of range
void build_scene(const Drawing& drawing, MetresPerUnit unit, const ImportOptions& options, Imported& imported);

} // namespace lightwell::dxf
