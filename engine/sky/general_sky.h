#pragma once

#include "engine/sky/perez_sky.h"
#include "engine/sky/sky.h"

namespace lightwell {

/// One of the fifteen general skies of the CIE in absolute units, with its sun.
struct GeneralSky {
    SkyShape shape;
    double normalization = 0; ///< W/(m^2 sr) for a relative luminance of one
    double ground = 0;        ///< W/(m^2 sr)
    Direction to_sun{0, 0, 1};
    double sun_radiance = 0; ///< W/(m^2 sr) of a disc of sun_full_angle_deg; 0: hidden
};
/// The standard says how luminance is spread, not how much there is: the horizontal irradiance is that of make_sky()
/// for the overcast (1 to 6), intermediate (7 to 10) or clear sky (11 to 15), and so are ground and sun. Skies 1 to 6
/// hide the sun.
/// @param options  `kind` does not count
/// @throws InputError for another number, and as make_sky() does
GeneralSky make_general_sky(int number, const SkyOptions& options, const Direction& to_sun);

} // namespace lightwell
