#pragma once

#include "engine/base/spectrum.h"
#include "engine/scene/surface.h"

namespace lightwell {

/// Told what happens along the paths of a receiver, and what each place of them adds to its irradiance.
class PathListener {
public:
    virtual ~PathListener() = default;
    /// A new path starts at the receiver.
    virtual void begin() = 0;
    /// The path was scattered, mirrored or refracted at a surface of this modifier.
    virtual void bent(ModifierId modifier) = 0;
    /// W/m^2. What comes straight from a source to a surface is scattered there by `at`; void: it came by the path
    /// itself, or straight to the receiver.
    virtual void added(const Spectrum& irradiance, ModifierId at) = 0;
};

} // namespace lightwell
