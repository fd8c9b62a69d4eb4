#pragma once

#include "engine/base/report.h"
#include "engine/scene/scene.h"

namespace lightwell::scene_text {

/// Adds the image of a surface under a map. Exact for polygons and meshes under any map, and for round shapes where
/// the image is a round shape of the same kind; else the image is made of facets and noted. The front stays the
/// front under mirrored maps too.
/// @param chord_tolerance_m  greatest distance of facets from the true surface
void add_image(Part& to, const Part& from, const Surface& surface, const Affine& map, ModifierId modifier,
               const std::string& name, double chord_tolerance_m, Report& report);

/// Adds facets for the image of a round shape, noted.
void add_facets(Part& to, const Part& from, const Surface& surface, const Affine& map, ModifierId modifier,
                const std::string& name, double tolerance, Report& report);

/// Whether the map's linear part is the identity (nothing but a translation).
bool is_translation(const Affine& map) noexcept;

} // namespace lightwell::scene_text
