#pragma once

#include "engine/ambient/ambient_cache.h"

namespace lightwell {

/// Where a tracer finds ambient light instead of scattering diffusely: records where the eye looks, the deep field
/// behind any scattering. Without either the tracer is a plain path tracer.
struct AmbientLight {
    const AmbientCache* cache = nullptr;
    const DeepField* deep = nullptr;
};

} // namespace lightwell
