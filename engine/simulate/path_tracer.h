#pragma once

#include "engine/direct/direct_light.h"

namespace lightwell {

/// What one path through a picture element brings back.
struct PathSample {
    Spectrum radiance;            ///< towards the eye
    Spectrum irradiance;          ///< on the first surface met, on the viewer's side
    Spectrum indirect_irradiance; ///< the part of it that came by scattered rays
    Spectrum diffuse_reflectance; ///< of that surface; black where it does not scatter diffusely
    double closeness_per_m = 0;   ///< an estimate of the cosine-weighted mean of 1 / distance around that surface
    bool met_surface = false;
    double distance_m = infinity; ///< to that surface
    Direction normal{0, 0, 0};    ///< on the viewer's side
};

/// Monte Carlo solution of the rendering equation: shadow rays to the sources at every vertex, scattered rays for all
/// the rest, any number of bounces, ended by roulette.
/// Error: unbiased
/// Source  Ward 1994, Eq. (1); Kajiya 1986
class PathTracer {
public:
    PathTracer(const Scene& scene, const RayQueries& rays, const SourceList& sources);

    PathSample sample(const Ray& ray, PathRandom& random) const;
    /// One estimate of the irradiance at a place on the side of the normal, W/m^2.
    /// @param here  position and its error; the rest is not used
    Spectrum irradiance(Hit here, const Direction& normal, PathRandom& random) const;

private:
    struct Walk;
    bool scatter(Walk& walk, const Vertex& vertex, PathRandom& random) const;
    void meet_distant(Walk& walk) const;
    bool meet_surface(Walk& walk, PathRandom& random) const;
    void meet_emitter(Walk& walk, const Hit& hit, const Material& material) const;
    void run(Walk& walk, PathRandom& random) const;
    void gather_at(Walk& walk, const Vertex& vertex, PathRandom& random) const;

    const Scene& scene_;
    const RayQueries& rays_;
    const SourceList& sources_;
    DirectLight direct_;
    std::vector<const Material*> materials_;  ///< by modifier
    std::vector<const Material*> alternates_; ///< by modifier: what eyes see of an Illum; null: nothing
    Material white_;
};

} // namespace lightwell
