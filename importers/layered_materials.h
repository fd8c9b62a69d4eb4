#pragma once

#include "materials/material.h"

#include <string>

namespace lightwell {

/// A surface that covers only part of its area (`d` of MTL, alpha of glTF, a picture with holes): light goes straight
/// through the rest. In the photopic mean exact: diffuse and highlight are those of the surface times the opacity, and
/// 1 - opacity passes; a coloured surface shares its hue with the light that passes, since Trans has one colour.
/// @param opacity  share that is covered, in [0, 1]
Trans partly_open(const Plastic& covered, double opacity) noexcept;

/// A clear coat of index 1.5 over a plastic: it adds its 4 % to the highlight and takes them from the rest; the
/// roughness is the mean of both highlights, weighed with their share.
/// @param coverage   of the coat, [0, 1]
/// @param roughness  rms slope of the coat, [0, 1]
Plastic with_coat(const Plastic& below, double coverage, double roughness) noexcept;

/// A layer of fibres as what it adds to the diffuse reflectance; the rest is dimmed so that no energy is made.
/// @param sheen       reflectance of the fibres, engine primaries, each channel in [0, 1]
/// @param perceptual  roughness of the layer as files give it, [0, 1]
/// Error   the mean reflectance over the hemisphere within 0.003, numerically integrated; no rim of light is left
/// Source  Estevez and Kulla 2017, distribution; Ashikhmin and Premoze 2007, shadowing, as KHR_materials_sheen has them
Plastic with_sheen(const Plastic& below, const Spectrum& sheen, double perceptual) noexcept;

} // namespace lightwell
