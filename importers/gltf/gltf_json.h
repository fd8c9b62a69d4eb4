#pragma once

#include "engine/base/report.h"

#include <string>
#include <string_view>
#include <vector>

namespace lightwell {

/// What is taken out of the JSON before it goes to the parser, since the parser would trust it or stumble over it.
struct GltfJson {
    struct Buffer {
        std::string uri;
        std::size_t length = 0;
    };
    std::string text;  ///< without buffers, animations and what `parts` has
    std::string parts; ///< materials, images, textures, samplers, skins and root extensions, for gltf_parts.h
    std::vector<Buffer> buffers;
    std::size_t animations = 0;
    std::string generator;
};

/// Checks version and types, and prepares the JSON for the parser. Indices of primitives move to their extras, where
/// the parser does not look at them.
/// @throws InputError with line and reason
GltfJson prepare_json(std::string_view json, const std::string& name, Report& report);

} // namespace lightwell
