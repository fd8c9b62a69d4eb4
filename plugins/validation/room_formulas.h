#pragma once

#include <vector>

namespace lightwell {

// Light that has been reflected, and light of the sky, from closed forms and small integral equations of our own.

/// Indirect illuminance in a closed diffuse sphere, everywhere the same: flux rho / (4 pi R^2 (1 - rho)).
/// Source  Ulbricht 1900
double sphere_indirect(double radius, double reflectance, double flux_lm);

/// Two infinite parallel planes, the first of its own exitance.
struct PlaneIlluminances {
    double on_first, on_second;
};
/// Source  geometric series: E2 = M / (1 - rho1 rho2), E1 = rho2 E2
PlaneIlluminances parallel_planes(double exitance, double reflectance1, double reflectance2);

/// Two infinitely long strips at right angles that meet in an edge, the floor 0 < x < 1 and the wall 0 < z < height,
/// each under the same direct illuminance.
/// Error: 1e-9 relative at distances of 0.01 and more from the edge
/// Source  E1(x) = E + rho2 integral of E2(z) x z / (2 (x^2 + z^2)^1.5) dz (crossed strings), and E2 likewise, by
///         Nystrom's method on panels that halve towards the edge
class Corner {
public:
    Corner(double floor_reflectance, double wall_reflectance, double wall_height, double direct);
    double on_floor(double x) const;
    double on_wall(double z) const;

private:
    struct Strip {
        double reflectance;
        std::vector<double> place, weight, value;
    };
    static Strip make_strip(double width, double reflectance, double direct);
    static double gathered(const Strip& from, double at);
    double direct_;
    Strip floor_, wall_;
};

enum class SkyGradation { uniform, overcast };
/// Illuminance on a plane tilted from the horizontal under half a sphere of sky without ground, in units of the zenith
/// luminance: pi (1 + cos b) / 2, and for the overcast sky (1 + 2 sin h) / 3.
/// Source  Moon, Spencer 1942
double tilted_plane(SkyGradation sky, double tilt_rad);
/// The same at the middle of the base of a cone of sky around the zenith: a point below a round opening.
double sky_cone(SkyGradation sky, double half_angle_rad);

} // namespace lightwell
