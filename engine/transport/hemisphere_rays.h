#pragma once

#include "engine/base/spectrum.h"
#include "engine/sampling/path_random.h"

#include <cstdint>
#include <vector>

namespace lightwell {

/// A place that receives light on one side of a surface.
struct Receiver {
    Point position;
    Direction normal;   ///< on the side that receives
    double error_m = 0; ///< bound on how far the position may lie off the surface
};

/// Light in proportion to a value that is not known yet: irradiance of weight * value.
struct Dependence {
    std::uint32_t unknown;
    Spectrum weight;
};

/// What one ray of a hemisphere brings to a receiver.
struct Arrival {
    double distance_m = infinity; ///< to what the ray met first
    Spectrum radiance;            ///< along the ray, W/(m^2 sr)
    /// One estimate of the receiver's ambient irradiance: the ray's light and a shadow ray to the sky, each with its
    /// weight, W/m^2. Without what the dependences add.
    Spectrum irradiance;
};

/// Answers rays that leave a receiver, cosine-distributed, for those who sum them up. Ambient light is all that comes
/// by way of other surfaces and from the wide sky; lamps and suns in plain view are direct light.
class HemisphereRays {
public:
    virtual ~HemisphereRays() = default;
    /// @param direction    drawn with density cosine / pi
    /// @param dependences  what is added to the irradiance once the unknowns are known; appended
    virtual Arrival arrive(const Receiver& receiver, const Direction& direction, PathRandom& random,
                           std::vector<Dependence>& dependences) const = 0;
    /// A place of the same surface, or one that goes on from it, a little way off.
    /// @param offset  in the receiver's plane
    /// @param lift_m  how far above the plane the way there must be free, and the place may lie below or above
    virtual bool beside(const Receiver& receiver, const Vec3& offset, double lift_m, Receiver& found) const = 0;
    /// Distance to what a ray meets; infinity for nothing.
    virtual double distance_m(const Receiver& receiver, const Direction& direction) const = 0;
    /// Irradiance from lamps and suns.
    virtual Spectrum direct(const Receiver& receiver, PathRandom& random) const = 0;
};

} // namespace lightwell
