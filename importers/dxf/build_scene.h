#pragma once

#include "engine/base/quantities.h"
#include "importers/dxf/drawing.h"
#include "importers/importer.h"

namespace lightwell::dxf {

/// Fills imported.scene, keys, ledger and report from a drawing: blocks become prototypes, inserts instances.
/// @param chord_tolerance_m  for arcs that become facets, > 0, in the model (copies of blocks scaled)
/// @throws InputError: blocks that contain themselves, too many copies, vertex indices out of range
void build_scene(const Drawing& drawing, MetresPerUnit unit, bool y_up, double chord_tolerance_m, Imported& imported);

} // namespace lightwell::dxf
