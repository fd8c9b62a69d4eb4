#pragma once

#include "engine/base/frame.h"
#include "materials/material.h"

namespace lightwell {

/// Whether functions of the material have to be asked at each place before it scatters.
bool depends_on_place(const Material& material) noexcept;
/// Works out those functions.
/// @param place  must outlive the material's use, as far as it refers to a part's frame
void put_in_place(Material& material, const PatternPlace& place) noexcept;
/// Frame of a surface: z as given, x along the grain, of measured sheets y upwards.
/// @param z  normal on the viewer's side
Frame frame_of(const Material& material, const Direction& z) noexcept;
/// Whether eyes and shadow rays see other geometry in its place: a measured sheet with a thickness. Before the material
/// is put in place: whether it may be one.
bool stands_for_geometry(const Material& material) noexcept;
/// The functions of a material that has some, else null.
const std::shared_ptr<const PlaceProgram>* functions_of(const Material& material) noexcept;
std::shared_ptr<const PlaceProgram>* functions_of(Material& material) noexcept;

} // namespace lightwell
