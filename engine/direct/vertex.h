#pragma once

#include "engine/accel/ray_queries.h"
#include "engine/base/frame.h"
#include "materials/bsdf.h"

namespace lightwell {

/// A point of a surface at which light is gathered, seen from one side.
struct Vertex {
    Hit hit;
    Direction side;      ///< geometric normal on the viewer's side
    Frame frame;         ///< z = shading normal on the viewer's side
    Direction to_viewer; ///< in that frame
    Bsdf bsdf;

    /// @param direction  of the ray that met the surface
    Vertex(const Hit& met, const Direction& direction, const Material& material)
        : hit(met), side(dot(met.normal, direction) <= 0 ? met.normal : -met.normal),
          bsdf(material, dot(met.normal, direction) <= 0)
    {
        Direction smooth = dot(met.normal, direction) <= 0 ? met.shading_normal : -met.shading_normal;
        // A smooth normal that turns away from the viewer has nothing to say about this point.
        if (!(dot(smooth, direction) < 0))
            smooth = side;
        frame = frame_about(smooth);
        to_viewer = frame.to_local(-direction);
        // Along a grazing ray the cosine may round to nothing.
        if (!(to_viewer.z > 0))
            to_viewer.z = std::numeric_limits<double>::min();
    }
    /// A smooth normal must not let light through a surface: the true side decides.
    bool same_side(const Direction& world, const Direction& local) const noexcept
    {
        return (dot(side, world) > 0) == (local.z > 0);
    }
    bool transmits() const noexcept { return !bsdf.lobes().diffuse_transmittance.is_black() || bsdf.lobes().glossy; }
};

} // namespace lightwell
