#pragma once

#include "engine/scene/scene.h"

namespace lightwell {

/// Coefficients of a CIE general sky; type 16 is the traditional overcast sky, which has none.
struct SkyCoefficients {
    double a, b, c, d, e;
};
inline constexpr int general_skies = 15, traditional_overcast = 16;
/// @param type  1 to 15
/// Source  ISO 15469:2004, table 1
SkyCoefficients sky_coefficients(int type);

/// Luminance of the upper hemisphere in units of the zenith's; 0 below the horizon.
/// Source  ISO 15469:2004: f(chi) phi(Z) / (f(Zs) phi(0)); Moon, Spencer 1942: (1 + 2 sin h) / 3
class CieSkyFormula {
public:
    CieSkyFormula(int type, const Direction& to_sun);
    double operator()(const Direction& direction) const;
    /// Illuminance on a plane under the whole sky, in units of the zenith luminance.
    /// Error: 1e-6 relative (against twice as many nodes, tests/unit/validation)
    double on_plane(const Direction& normal) const;

private:
    double indicatrix(double angle) const;
    SkyCoefficients k_{};
    bool traditional_;
    Direction to_sun_;
    double scale_ = 1;
};

/// The same sky in a scene: a distant glow of half a sphere under a brightness function, without blend over the
/// horizon.
/// @param zenith  radiance, W/(m^2 sr)
void add_cie_sky(Scene& scene, int type, const Direction& to_sun, double zenith);

} // namespace lightwell
