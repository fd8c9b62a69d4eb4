#pragma once

#include "importers/dxf/drawing.h"
#include "importers/importer.h"

namespace lightwell::dxf {

/// Adds the views that the drawing keeps (tables VIEW and VPORT) to the scene, which is complete otherwise: a parallel
/// view is moved back until it has all of it in front.
/// Source  Autodesk DXF reference, VIEW and VPORT; the lens length is that of a picture with a diagonal of 42 mm
void add_views(const Drawing& drawing, const Affine& to_metres, Imported& imported);

} // namespace lightwell::dxf
