#pragma once

#include "engine/ambient/ambient_cache.h"
#include "engine/sources/secondary_sources.h"

#include <optional>

namespace lightwell {

/// As many diffuse interreflections as other programs are told to follow, and what stands in for all further ones: for
/// comparison with their pictures. Mirrored and refracted rays are followed all the same. What else Radiance does is
/// done too: behind a diffuse or glossy scattering, lamps and suns that rays meet in polished things or through bodies
/// do not count; glows are tested by shadow rays within their radius, and met by scattered rays beyond; materials with
/// functions are diffuse but for the light of lamps and suns.
struct AmbientLimit {
    int bounces = 0;   ///< diffuse scatterings that are followed, >= 0
    Spectrum radiance; ///< W/(m^2 sr), arriving from everywhere where no more are
    /// Rough highlights of at most this specularity are diffuse but for the light of lamps and suns.
    double unsampled_specularity = 0;
};

/// Where a tracer finds ambient light instead of scattering diffusely: records where the eye looks, the deep field
/// behind any scattering. Without either the tracer is a plain path tracer.
struct AmbientLight {
    const AmbientCache* cache = nullptr;
    const DeepField* deep = nullptr;
    const SecondarySources* secondary = nullptr; ///< where rays that arrive are worth aiming
    std::optional<AmbientLimit> limit = {};      ///< then without cache and deep field
};

} // namespace lightwell
