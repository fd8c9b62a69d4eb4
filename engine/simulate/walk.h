#pragma once

#include "engine/accel/volumes.h"
#include "engine/simulate/path_tracer.h"

/// \file The state of a path; only the sources of PathTracer include it.
namespace lightwell {

/// A path on its way.
struct PathTracer::Walk {
    Ray ray;
    Spectrum throughput = Spectrum::grey(1);
    Spectrum radiance;
    Spectrum arriving_throughput; ///< the same for the irradiance on the first surface
    Spectrum irradiance;
    bool at_first = true;          ///< no scattering has happened yet
    std::optional<Hit> first;      ///< what the ray from the eye met
    bool first_is_diffuse = false; ///< so that its scattered light tells its irradiance
    /// What has happened to the light of lamps and suns that a ray meets.
    enum class Sources { in_full, weighted, answered } sources = Sources::in_full;
    double scattered_density = 0; ///< of the last scattering
    SourceShares shares;          ///< of the shadow rays there
    SourceShares here;            ///< of the shadow rays at this vertex; they become `shares` when the path bends
    MirrorShares mirror_shares, mirror_here; ///< the same of those to virtual sources
    MirrorChain chain;                       ///< mirrors since the last bend by a diffuse or glossy lobe
    double way_m = 0;                        ///< from there
    int scatterings = 0;
    double aim_weight = 1; ///< of an arrival's light from where it is scattered first
    bool aimed = false;    ///< an arrival sent where light comes from: what emits in plain view is not its business
    bool straight_from_receiver = false; ///< of an arrival, before anything bends it
    bool met_lamp = false;               ///< of an arrival: with nothing in between
    bool bent = false;                   ///< by a diffuse or glossy lobe: from there on the deep field serves
    int replicate = 0;
    int splits_left = 0;     ///< at how many panes both the mirrored and the passing light are still followed
    int diffuse_bounces = 0; ///< where diffuse interreflection is limited
    double jump_m = 0;       ///< by which light that passes the next vertex starts behind it
    PathListener* listener = nullptr;
    std::vector<Dependence>* dependences = nullptr; ///< of an arrival: what comes from the deep field is not known yet

    void add(Spectrum light, double weight = 1)
    {
        radiance += throughput * light;
        irradiance += arriving_throughput * light * weight;
        if (listener != nullptr)
            listener->added(arriving_throughput * light * weight, void_modifier);
    }
    /// From here on an arrival brings light that another way of sending rays finds too.
    void settle_aim()
    {
        arriving_throughput = arriving_throughput * aim_weight;
        aim_weight = 1;
        aimed = false;
    }
    /// Weight of a source met by a scattered ray against shadow rays of this density.
    double weight(double shadow_density) const
    {
        return shadow_density > 0 ? 1 - shadow_ray_weight(shadow_density, scattered_density) : 1;
    }
};

/// Shadow rays to lamps and to the sky at the first vertex, where their noise is seen directly, and at later ones.
inline constexpr int first_rays = 4, later_rays = 1;

inline bool is_diffuse(const Lobes& lobes)
{
    return !lobes.diffuse_reflectance.is_black() || !lobes.diffuse_transmittance.is_black();
}

} // namespace lightwell
