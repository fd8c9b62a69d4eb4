#include "engine/accel/volumes.h"
#include "engine/simulate/path_tracer.h"

/// \file What a path tracer knows at a place without following a path: what is near, and light straight from the
/// sources.
namespace lightwell {
namespace {

/// Shadow rays by way of mirrors.
constexpr int mirrored_rays = 4;

} // namespace

Sight PathTracer::sight(const Ray& ray) const noexcept
{
    Sight seen;
    Hit hit;
    seen.varies = varied_.any(); // behind everything may be a sky with a pattern
    if (rays_.closest(ray, hit))
        seen = {true, hit.modifier, hit.normal, hit.t, varied_.varies(hit.modifier)};
    return seen;
}

Vertex PathTracer::white_vertex(const SurfacePlace& receiver) const
{
    Hit here;
    here.position = receiver.position;
    here.error_m = receiver.error_m;
    here.normal = here.shading_normal = receiver.normal;
    if (rays_.volumes().any())
        here.in = rays_.volumes_at(here.leave(receiver.normal));
    return Vertex(here, -receiver.normal, white_);
}

bool PathTracer::beside(const SurfacePlace& receiver, const Vec3& offset, double lift_m, SurfacePlace& found) const
{
    const Point lifted = receiver.position + receiver.normal * lift_m;
    Hit hit;
    if (rays_.closest({lifted, offset, 1}, hit) || !rays_.closest({lifted + offset, -receiver.normal, 2 * lift_m}, hit))
        return false;
    const bool front = dot(hit.normal, receiver.normal) > 0;
    found = {hit.position, front ? hit.normal : -hit.normal, hit.error_m};
    return true;
}

Met PathTracer::meet(const SurfacePlace& receiver, const Direction& direction) const
{
    const Vertex vertex = white_vertex(receiver);
    Hit hit;
    if (!rays_.closest({vertex.hit.leave(direction), direction, infinity}, hit))
        return {};
    return {hit.t, facing(hit.normal, direction)};
}

Spectrum PathTracer::light_of(const DirectLight& sources, const Vertex& vertex, const SourceKinds& kinds,
                              PathRandom& random, double& lamp_share) const
{
    SourceShares shares;
    MirrorShares mirror_shares;
    const Gathered found = sources.gather_tested(vertex, kinds, {}, random, shares);
    const Gathered mirrored =
        mirrored_.gather(vertex, {mirrored_rays, kinds, LobeSet::specular}, random, mirror_shares);
    lamp_share += found.lamp_share;
    return found.irradiance + mirrored.irradiance;
}

DirectIrradiance PathTracer::direct_by(const DirectLight& sources, const SurfacePlace& receiver,
                                       PathRandom& random) const
{
    const Vertex vertex = white_vertex(receiver);
    DirectIrradiance direct;
    if (!sources_.lamps().empty())
        direct.lamps = light_of(sources, vertex, {true, false, false}, random, direct.lamp_share);
    if (!sources_.suns().empty())
        direct.suns = light_of(sources, vertex, {false, true, false}, random, direct.lamp_share);
    return direct;
}

DirectIrradiance PathTracer::direct(const SurfacePlace& receiver, PathRandom& random) const
{
    return direct_by(site_direct_, receiver, random);
}

DirectIrradiance PathTracer::sensor_direct(const SurfacePlace& receiver, PathRandom& random) const
{
    return direct_by(sensor_direct_, receiver, random);
}

} // namespace lightwell
