#pragma once

#include "engine/base/quantities.h"
#include "engine/base/transform.h"

#include <string>

namespace lightwell {

/// @param name  "mm", "millimetre", "cm", "m", "km", "in", "inch", "ft", "foot", "yd", ... or a number of metres
/// @throws InputError that lists the names
MetresPerUnit parse_unit(const std::string& name);
/// AutoCAD's $INSUNITS code (0 to 24); 0 for "unitless" and unknown codes.
/// Source  Autodesk DXF reference, header variables
MetresPerUnit unit_of_insunits(int code);
/// "mm", "m", "in", ... or the number of metres.
std::string unit_name(MetresPerUnit unit);
/// File coordinates to metres, z up; a y-up file is turned by +90 degrees about x (x stays, y becomes z).
Affine to_metres_z_up(MetresPerUnit unit, bool y_up);

} // namespace lightwell
