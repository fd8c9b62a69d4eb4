#pragma once

#include "engine/simulate/simulate.h"

namespace lightwell {

/// A ray or a sensor to be answered on its own.
struct RayRequest {
    Point origin;
    Direction direction{0, 0, 1}; ///< unit; of a sensor the side it faces
    double reach_m = infinity;
    bool sensor = false; ///< irradiance at the origin in place of radiance along the ray
};
struct RaySettings {
    int samples = 0;        ///< paths per ray; 0: as many as bring each ray to the accuracy, within bounds
    double accuracy = 0.02; ///< wanted standard error / luminance of each ray
    std::uint64_t seed = 1;
    int threads = 0;
    bool unbiased = false;
    Techniques techniques = {};
    AmbientFile ambient_file = {};
    /// For sensors: radiance that stands for all light that does not come straight from lamps and suns.
    std::optional<Spectrum> constant_ambient = std::nullopt;
};
/// What one ray brings back.
struct RayAnswer {
    Spectrum value;            ///< W/(m^2 sr), of a sensor W/m^2
    Spectrum irradiance;       ///< on the first surface, on the side that the ray comes from, W/m^2
    double standard_error = 0; ///< of the luminance or illuminance, cd/m^2 or lx
    bool met_surface = false;
    double distance_m = infinity;
    Point position;
    Direction normal{0, 0, 0}; ///< of the first surface, on the viewer's side
    ModifierId modifier = void_modifier;
    std::string surface; ///< its name
};
struct SimulationParts;

/// Follows single rays through a scene. What they meet decides where ambient light is looked for, so that a ray's
/// answer depends, within the error, on the rays asked for together with it. Error   as stated by
/// RayAnswer::standard_error; interpolated ambient light adds a bias unless `unbiased`
class RayTracer {
public:
    /// @throws InputError from validate(scene)
    explicit RayTracer(Scene scene, const Preparation& preparation = {});
    ~RayTracer();
    RayTracer(const RayTracer&) = delete;
    RayTracer& operator=(const RayTracer&) = delete;

    const Scene& scene() const noexcept;
    /// @throws InputError for a ray that is not finite or whose direction is no unit vector
    std::vector<RayAnswer> trace(const std::vector<RayRequest>& rays, const RaySettings& settings,
                                 const Progress& progress = {}) const;

private:
    std::unique_ptr<SimulationParts> parts_;
};

} // namespace lightwell
