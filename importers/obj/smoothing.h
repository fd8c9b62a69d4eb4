#pragma once

#include "importers/obj/obj_file.h"

namespace lightwell {

/// Gives the corners of smoothing groups (`s 1`) that have no normals the normals that the groups mean: at each point
/// the mean over the faces of the group around it, weighed with their angle there, as far as they do not turn away from
/// the face itself by more than 66 degrees. So a round column of six sides or more is round, and a box that an exporter
/// put into one group keeps its edges.
void smooth_groups(ObjFile& file);

} // namespace lightwell
