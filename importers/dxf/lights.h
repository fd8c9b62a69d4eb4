#pragma once

#include "engine/base/quantities.h"
#include "importers/dxf/shapes.h"
#include "importers/dxf/styles.h"

namespace lightwell::dxf {

/// A LIGHT of the model, or of a block before it is inserted.
struct DrawnLight {
    const Entity* entity = nullptr;
    Affine to_frame;   ///< from the coordinates it is drawn in
    SurfaceClass what; ///< whose layer it is on
};

/// Why a LIGHT gives no light; nullptr: it does.
Reason dark_reason(const Entity& light);

/// Adds a lamp to the model: a ball of one centimetre for point and spot lights, a distant source as wide as the sun
/// for distant ones, with a material of its own in Imported::file_materials.
///
/// The drawing gives no unit for intensities. An intensity of 1 stands for 1500 cd, and for 1500 lx of a distant light
/// on a surface that faces it; light always falls off with the square of the distance. A spot light is even within a
/// cone whose cosine lies in the middle between those of hotspot and falloff.
/// @param to_metres  from the model's coordinates
void add_light(const Drawing& drawing, const DrawnLight& light, const Affine& to_metres, ModifierTable& modifiers,
               Imported& imported);

} // namespace lightwell::dxf
