#pragma once

#include "engine/base/vector.h"

namespace lightwell {

struct NoiseValue {
    double value = 0; ///< about -1 to 1; 0 at whole coordinates
    Vec3 gradient;
};

/// Smooth noise in space and its slope: `noise3`, `noise3x`, `noise3y`, `noise3z`.
/// Error   exact; Radiance takes the slope over a step of 0.0005, which differs by up to 0.002
/// Source  Perlin, Improving noise, 2002: gradients towards the edges of a cube, chosen by a permutation, blended by
///         a polynomial of degree five
NoiseValue gradient_noise_at(const Point& at) noexcept;

/// Rough noise in space: a cube halved again and again down to a two-thousandth, each new corner the mean of its
/// neighbours and a chance part in proportion to the size: `fnoise3`. Source  recorded values of the function
/// (tests/unit/functions)
double fractal_noise_at(const Point& at) noexcept;

} // namespace lightwell
