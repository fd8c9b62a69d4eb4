#pragma once

#include "engine/ambient/ambient_cache.h"
#include "engine/sources/secondary_sources.h"

namespace lightwell {

/// Where a tracer finds ambient light instead of scattering diffusely: records where the eye looks, the deep field
/// behind any scattering. Without either the tracer is a plain path tracer.
struct AmbientLight {
    const AmbientCache* cache = nullptr;
    const DeepField* deep = nullptr;
    const SecondarySources* secondary = nullptr; ///< where rays that arrive are worth aiming
};

} // namespace lightwell
