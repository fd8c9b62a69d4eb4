#pragma once

#include "importers/dxf/drawing.h"

namespace lightwell::dxf {

/// Reads a drawing and the drawings that it refers to (XREF), as far as they lie where it says, counted from its own
/// folder, or directly beside it, as DXF. Their layers and blocks are named `REFERENCE|NAME`, as CAD programs do; what
/// they have on layer 0 stays there. Each is scaled by the units that both files state.
/// @throws InputError for the drawing itself; a reference that cannot be read is noted
Drawing read_drawing_with_references(const std::filesystem::path& file, Report& report);

} // namespace lightwell::dxf
