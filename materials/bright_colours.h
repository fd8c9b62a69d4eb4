#pragma once

#include "materials/material.h"

namespace lightwell {

/// As validate_material(), but the material's own colour may be above 1: its pattern is meant to darken it, and
/// tinted() holds the product.
/// @throws InputError as validate_material()
void validate_patterned_material(const Material& material, const std::string& place);

/// Holds the channels of the material's own colour at 1. Saturated paints may be above it in one channel of these
/// primaries though they give back less light than they get.
/// @return the largest channel as it was; 0: nothing is held, since all are at most 1, or since the luminous
///         reflectance is above 1, which no paint has
double hold_saturated_colour(Material& material) noexcept;

} // namespace lightwell
