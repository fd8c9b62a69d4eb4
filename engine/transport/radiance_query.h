#pragma once

#include "engine/sampling/path_random.h"

namespace lightwell {

/// Answers rays for those who collect distributions of light.
class RadianceQuery {
public:
    virtual ~RadianceQuery() = default;
    /// One estimate of the radiance that comes to a point against a direction, without what lamps, suns and sky send
    /// there straight or through panes: shadow rays bring that, W/(m^2 sr).
    virtual Spectrum scattered_radiance(const Point& to, const Direction& direction, PathRandom& random) const = 0;
};

} // namespace lightwell
