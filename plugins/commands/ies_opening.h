#pragma once

#include "materials/photometry_ies.h"

#include <optional>
#include <string>

namespace lightwell::commands {

/// What ies2rad makes of a luminous opening: one of three shapes, and what it says of those that it replaces.
struct IesOpening {
    enum class Shape { rectangle, disk, sphere } shape = Shape::rectangle;
    std::string name;                               ///< as the file means it: "vertical cylinder"
    std::string replaced;                           ///< "an ellipsoid"; empty when the shape is kept
    std::string replacement;                        ///< "box"
    double width_m = 0, length_m = 0, height_m = 0; ///< none below the least that is made
};

/// Source  tables of luminous openings of LM-63-1986 to 1995 and of LM-63-2002, as they are told apart by the first
///         line; sizes below 0 are diameters
/// @return nothing for sizes that mean no shape
std::optional<IesOpening> ies_opening(const IesFile& file);

} // namespace lightwell::commands
