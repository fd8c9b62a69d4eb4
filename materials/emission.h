#pragma once

#include "materials/material.h"

namespace lightwell {

/// Radiance that a surface of this material sends to a viewer, W/(m^2 sr); black from behind, outside a spotlight's
/// cone, and for what does not emit. An Illum sends its light whoever looks: what eyes see instead is decided where
/// rays are told apart.
/// @param cos_to_viewer    signed, against the front normal
/// @param world_to_viewer  unit, in the frame of a spotlight's aim
/// Source  Radiance reference manual, `light`, `illum`, `glow`, `spotlight`
Spectrum emitted_towards(const Material& material, double cos_to_viewer, Direction world_to_viewer) noexcept;

/// Share of emitted_towards() that counts over a distance: the light of a spotlight spreads from its focal point behind
/// the lamp, so that irradiance falls as 1 / (distance + focal length)^2. 1 for all other materials.
/// Source  Radiance reference manual, `spotlight`: the length of the aim is the focal length
double beam_share(const Material& material, double distance_m) noexcept;

/// A glow with a negative radius: eyes and mirrors see it, and it lights nothing.
bool is_only_seen(const Material& material) noexcept;

/// Whether light of this lamp passes an Illum from behind to its front. What an Illum sends has the light of the sky,
/// and of glows that are never tested by shadow rays, in it; that of suns and other lamps it leaves out. Source
/// Radiance reference manual, `illum`; light sources shine through it
bool passes_illum_fronts(const Material& lamp) noexcept;

} // namespace lightwell
