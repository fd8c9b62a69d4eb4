#pragma once

#include "engine/sky/sky.h"

#include <optional>

namespace lightwell {

/// Measured values in the place of the model's. A sky has one of the first two, a sun one of the others.
struct MeasuredLight {
    std::optional<double> zenith = std::nullopt;           ///< W/(m^2 sr)
    std::optional<double> diffuse_W_per_m2 = std::nullopt; ///< horizontal, from the sky
    std::optional<double> half_degree_sun = std::nullopt;  ///< radiance of a disc 0.5 degrees wide, W/(m^2 sr)
    std::optional<double> direct_W_per_m2 = std::nullopt;  ///< horizontal, from the sun
};
struct MeasuredSky {
    SkyModel sky;
    double mean = 0;            ///< of the sky's radiance, cosine-weighted: horizontal irradiance / pi
    double half_degree_sun = 0; ///< radiance of a disc 0.5 degrees wide, as gensky draws it
};
/// make_sky() with measured values; turbidities below 1 are followed too, as gensky does.
/// @throws InputError for turbidity below 0, a ground reflectance outside [0, 1], a direction that is not unit
MeasuredSky make_measured_sky(const SkyOptions& options, const MeasuredLight& measured, const Direction& to_sun);

} // namespace lightwell
