#pragma once

#include "engine/base/spectrum.h"
#include "engine/sampling/path_random.h"

#include <cstdint>
#include <vector>

namespace lightwell {

/// A place that receives light on one side of a surface.
struct SurfacePlace {
    Point position;
    Direction normal;   ///< on the side that receives
    double error_m = 0; ///< bound on how far the position may lie off the surface
};

/// Light in proportion to a value that is not known yet: irradiance of weight * value.
struct Dependence {
    std::uint32_t unknown;
    Spectrum weight;
};

/// What a ray meets first.
struct Met {
    double distance_m = infinity; ///< infinity: nothing
    Direction normal{0, 0, 0};    ///< on the side that the ray came from
};

/// What one ray of a hemisphere brings to a receiver.
struct Arrival {
    Met met;
    bool met_lamp = false; ///< with nothing in between: its light is direct and not counted here
    Spectrum radiance;     ///< along the ray, W/(m^2 sr)
    /// One estimate of the receiver's ambient irradiance: the ray's light and a shadow ray to the sky, each with its
    /// weight, W/m^2. Without what the dependences add.
    Spectrum irradiance;
};

/// Light straight from the sources.
struct DirectIrradiance {
    Spectrum lamps, suns;  ///< irradiance, W/m^2
    double lamp_share = 0; ///< of the hemisphere, cosine-weighted, that shows lamps
};

/// Answers rays that leave a receiver, cosine-distributed, for those who sum them up. Ambient light is all that comes
/// by way of other surfaces and from the wide sky; lamps and suns in plain view are direct light.
class HemisphereRays {
public:
    virtual ~HemisphereRays() = default;
    /// @param direction    drawn with density cosine / pi
    /// @param dependences  what is added to the irradiance once the unknowns are known; appended
    virtual Arrival arrive(const SurfacePlace& receiver, const Direction& direction, PathRandom& random,
                           std::vector<Dependence>& dependences) const = 0;
    /// A place of the same surface, or one that goes on from it, a little way off.
    /// @param offset  in the receiver's plane
    /// @param lift_m  how far above the plane the way there must be free, and the place may lie below or above
    virtual bool beside(const SurfacePlace& receiver, const Vec3& offset, double lift_m, SurfacePlace& found) const = 0;
    virtual Met meet(const SurfacePlace& receiver, const Direction& direction) const = 0;
    virtual DirectIrradiance direct(const SurfacePlace& receiver, PathRandom& random) const = 0;
};

} // namespace lightwell
