#pragma once

#include "engine/base/report.h"
#include "engine/scene/scene.h"
#include "importers/radiance/words.h"

namespace lightwell::scene_text {

/// The direction of a vector; one that has unit length up to rounding keeps its digits, so that text that was
/// written and read again does not drift.
Direction unit_vector(const Vec3& v) noexcept;

/// Adds a polygon, round shape or distant source from its numbers. What has no area is left out with a note.
/// @param words  where the primitive was read, for the places of messages
/// @throws InputError for a wrong number of numbers or one out of range
void add_surface(Part& part, const Primitive& primitive, ModifierId modifier, const Words& words, Report& report);

/// The surface as a primitive, four lines or more; not for meshes and instances.
/// @param modifier  a word, already encoded
void append_surface(std::string& text, const Part& part, const Surface& surface, const std::string& modifier);

} // namespace lightwell::scene_text
