#pragma once

namespace lightwell {

// Smooth boundaries and panes from Snell and Fresnel in the sine and tangent form (the engine uses the amplitudes).

/// Reflectance of a boundary for the two polarizations.
struct Reflectances {
    double senkrecht, parallel;
    double mean() const noexcept { return 0.5 * (senkrecht + parallel); }
};
/// @param index  of the far medium against the near one
/// Source  Born, Wolf, Principles of Optics, 1.5.2; 1 at total reflection
Reflectances boundary(double angle_rad, double index);

/// Transmittance of a pane with all reflections between its surfaces, mean of the polarizations.
/// @param transmissivity  what is left after one passage at normal incidence
/// Source  T = (1 - r)^2 t / (1 - r^2 t^2), t = transmissivity^(1 / cos refracted)
double pane_transmittance(double transmissivity, double index, double angle_rad);
/// Transmissivity that gives a transmittance at normal incidence: the positive root of the same equation.
double pane_transmissivity(double normal_transmittance, double index);
/// Transmittance under diffuse light: integral of T over the squared sine.
double diffuse_transmittance(double transmissivity, double index);

/// A ray through a clear sphere, by impact parameter in radii.  Source  Descartes 1637; Fresnel
struct BallPassage {
    double deviation_rad;           ///< of the ray that passes straight through
    double deviation_reflected_rad; ///< after one reflection inside
    double externally_reflected, transmitted, reflected_once;
};
BallPassage through_ball(double impact, double index);

/// A ray through a prism, without reflections inside.  Source  Born, Wolf, 4.7.2
struct PrismPassage {
    bool total = false; ///< reflected totally at the second face
    double deviation_rad = 0, exit_rad = 0, transmittance = 0;
};
PrismPassage through_prism(double apex_rad, double index, double incidence_rad);

} // namespace lightwell
