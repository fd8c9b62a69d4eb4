#pragma once

#include "engine/accel/ray_queries.h"
#include "engine/base/frame.h"
#include "materials/bsdf.h"
#include "materials/placed.h"

namespace lightwell {

/// A point of a surface at which light is gathered, seen from one side.
struct Vertex {
    Hit hit;
    Direction side;      ///< geometric normal on the viewer's side
    Frame frame;         ///< z = shading normal on the viewer's side
    Direction to_viewer; ///< in that frame
    Bsdf bsdf;

    /// @param direction  of the ray that met the surface
    /// @param material   in place (materials/placed.h); must outlive the vertex
    Vertex(const Hit& met, const Direction& direction, const Material& material)
        : hit(met), side(dot(met.normal, direction) <= 0 ? met.normal : -met.normal),
          frame(frame_of(material, smooth_side(met, direction))), to_viewer(towards_viewer(frame, direction)),
          bsdf(material, dot(met.normal, direction) <= 0, frame)
    {
    }
    /// A smooth normal must not let light through a surface: the true side decides.
    bool same_side(const Direction& world, const Direction& local) const noexcept
    {
        return (dot(side, world) > 0) == (local.z > 0);
    }
    bool transmits() const noexcept { return !bsdf.lobes().diffuse_transmittance.is_black() || bsdf.lobes().glossy; }

private:
    static Direction smooth_side(const Hit& met, const Direction& direction) noexcept
    {
        const bool from_front = dot(met.normal, direction) <= 0;
        const Direction smooth = from_front ? met.shading_normal : -met.shading_normal;
        // A smooth normal that turns away from the viewer has nothing to say about this point.
        return dot(smooth, direction) < 0 ? smooth : from_front ? met.normal : -met.normal;
    }
    static Direction towards_viewer(const Frame& frame, const Direction& direction) noexcept
    {
        Direction local = frame.to_local(-direction);
        // Along a grazing ray the cosine may round to nothing.
        if (!(local.z > 0))
            local.z = std::numeric_limits<double>::min();
        return local;
    }
};

} // namespace lightwell
