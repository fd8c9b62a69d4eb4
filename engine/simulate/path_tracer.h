#pragma once

#include "engine/direct/mirrored_light.h"
#include "engine/simulate/aim.h"
#include "engine/simulate/ambient_light.h"
#include "engine/simulate/path_listener.h"

namespace lightwell {

/// What one path through a picture element brings back.
struct PathSample {
    Spectrum radiance;   ///< towards the eye
    Spectrum irradiance; ///< on the first surface met, on the viewer's side
    bool met_surface = false;
    double distance_m = infinity; ///< to that surface
    Direction normal{0, 0, 0};    ///< on the viewer's side
};

/// The normal on the side that a ray comes from.
inline Direction facing(const Direction& normal, const Direction& ray) noexcept
{
    return dot(normal, ray) <= 0 ? normal : -normal;
}

/// What a ray meets first.
struct Sight {
    bool met_surface = false;
    ModifierId modifier = void_modifier;
    Direction normal{0, 0, 0};
    double distance_m = infinity;
    bool varies = false; ///< has a pattern, texture or mixture: neighbours say nothing about it
};

/// Solution of the rendering equation along paths: shadow rays to the sources at every vertex, scattered rays for all
/// the rest, any number of bounces, ended by roulette. With ambient light at hand, a vertex takes its diffusely
/// scattered light from there, and only mirrored, refracted and glossy rays go on.
/// Error: unbiased without ambient light
/// Source  Ward 1994, Eq. (1); Kajiya 1986
class PathTracer : public HemisphereRays, public RadianceQuery {
public:
    PathTracer(const Scene& scene, const RayQueries& rays, const SourceList& sources,
               const VirtualSources& virtual_sources, const AmbientLight& ambient = {},
               const DirectSettings& settings = {});

    /// @param replicate  of the ambient light
    PathSample sample(const Ray& ray, int replicate, PathRandom& random) const;
    Sight sight(const Ray& ray) const noexcept;
    /// One estimate of the irradiance at a receiver, W/m^2.
    /// @param listener  may be null
    Spectrum irradiance(const SurfacePlace& receiver, int replicate, PathRandom& random,
                        PathListener* listener = nullptr) const;

    Arrival arrive(const SurfacePlace& receiver, const Direction& direction, PathRandom& random,
                   std::vector<Dependence>& dependences) const override;
    Spectrum scattered_radiance(const Point& to, const Direction& direction, PathRandom& random) const override;
    bool beside(const SurfacePlace& receiver, const Vec3& offset, double lift_m, SurfacePlace& found) const override;
    Met meet(const SurfacePlace& receiver, const Direction& direction) const override;
    DirectIrradiance direct(const SurfacePlace& receiver, PathRandom& random) const override;
    /// The same with all the shadow rays that a result deserves.
    DirectIrradiance sensor_direct(const SurfacePlace& receiver, PathRandom& random) const;

    /// The places along a path that receive ambient light, on the side that a ray came from and, where light passes
    /// diffusely, on the other: those the eye sees by mirrored and straight rays, then those seen from there.
    /// @param scatterings  diffuse ones; 0: only what the eye sees
    void receivers_along(const Ray& ray, int scatterings, PathRandom& random, std::vector<SurfacePlace>& found) const;

private:
    struct Walk;
    struct AmbientHere;
    bool find_ambient(const Walk& walk, const Vertex& vertex, AmbientHere& here) const;
    void add_ambient(Walk& walk, const AmbientHere& here) const;
    void gather_plainly(Walk& walk, const Vertex& vertex, const GatherWish& wish, PathRandom& random) const;
    bool answered(const Walk& walk, bool is_sun, int source) const;
    void gather_beside_ambient(Walk& walk, const Vertex& vertex, const AmbientHere& here, PathRandom& random) const;
    void add_direct(Walk& walk, const Gathered& direct, double share, ModifierId at) const;
    bool follow(Walk& walk, const Vertex& vertex, const BsdfSample& scattered, LobeSet set) const;
    void split(Walk& walk, const Vertex& vertex, double mirrored_choice, PathRandom& random) const;
    bool scatter(Walk& walk, const Vertex& vertex, LobeSet set, PathRandom& random) const;
    bool survives(Walk& walk, PathRandom& random) const;
    void meet_distant(Walk& walk) const;
    const Material* seen_material(const Walk& walk, Hit& hit, SeenMaterial& seen) const;
    bool meet_surface(Walk& walk, PathRandom& random) const;
    // passages.cpp: what lies between surfaces, and other ways to go on than by lobes
    bool cross_volume(Walk& walk, Hit& hit) const;
    bool scatter_in_haze(Walk& walk, double length_m, PathRandom& random) const;
    void gather_in_haze(Walk& walk, const Spectrum& weight, double eccentricity, const Point& at,
                        PathRandom& random) const;
    void absorb_inside(Walk& walk, const Hit& hit, const Material& material) const;
    bool turn_in_prism(Walk& walk, const Hit& hit, const Prism& prism, PathRandom& random) const;
    bool scatter_within_limit(Walk& walk, const Vertex& vertex, const Material& material, PathRandom& random) const;
    bool scatter_as(Walk& walk, const Vertex& vertex, const Material& diffuse, PathRandom& random) const;
    bool add_constant(Walk& walk, const Lobes& lobes) const;
    void meet_emitter(Walk& walk, const Hit& hit, const Material& material) const;
    void run(Walk& walk, PathRandom& random) const;
    Walk arriving_walk(const Vertex& vertex, const Direction& direction, double weight) const;
    Spectrum light_of(const DirectLight& sources, const Vertex& vertex, const SourceKinds& kinds, PathRandom& random,
                      double& lamp_share) const;
    DirectIrradiance direct_by(const DirectLight& sources, const SurfacePlace& receiver, PathRandom& random) const;
    Vertex white_vertex(const SurfacePlace& receiver) const;

    const Scene& scene_;
    const RayQueries& rays_;
    const SourceList& sources_;
    const VirtualSources& virtual_sources_;
    AmbientLight ambient_;
    DirectLight direct_;
    MirroredLight mirrored_;
    DirectLight sensor_direct_;              ///< at sensors whose lamps are tested apart from other light
    DirectLight eye_direct_;                 ///< at what the eye sees
    DirectLight site_direct_;                ///< at the sites of the deep field
    DirectLight quick_direct_;               ///< behind a scattering
    std::vector<const Material*> materials_; ///< by modifier
    std::vector<ModifierId> alternates_;     ///< by modifier: what eyes see of an Illum; void: nothing
    VariedMaterials varied_;
    Material white_;
};

} // namespace lightwell
